// Plans as a console of DUNE's sends them.
#pragma once

#include <string>

#include "distributers/messages/imc.h"
#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"

namespace jarol::tests {

namespace imc = messages::imc;

/// Where the shipped graphs of the submarine have their origin.
inline constexpr double origin_latitude = 41.1850 * degree, origin_longitude = -8.7062 * degree;

/// At that place, in m north and east of the origin.
template <class M>
M at(double x, double y) {
  const EarthRadii radii = earth_radii(origin_latitude);
  M m;
  m.lat = origin_latitude + x / radii.north;
  m.lon = origin_longitude + y / radii.east;
  return m;
}

/// There, in m and m/s.
template <class M>
M maneuver(double x, double y, double depth = 3, double speed = 1.2) {
  M m = at<M>(x, y);
  m.speed = static_cast<float>(speed);
  if constexpr (requires { m.z; }) {
    m.z = static_cast<float>(depth);
    m.z_units = imc::ZUnits::DEPTH;
  }
  if constexpr (requires { m.timeout; }) m.timeout = 10000;
  return m;
}

/// One maneuver after the other, with transitions as Neptus writes them.
struct PlanOf {
  imc::PlanSpecification plan;

  explicit PlanOf(const char* name) { plan.plan_id = name; }
  template <class M>
  PlanOf& then(const char* name, const M& m) {
    imc::PlanManeuver named;
    named.maneuver_id = name;
    named.data = packed(m);
    plan.maneuvers.push_back(packed(named));
    if (plan.start_man_id.empty()) {
      plan.start_man_id = name;
    } else {
      imc::PlanTransition transition;
      transition.source_man = last;
      transition.dest_man = name;
      transition.conditions = "ManeuverIsDone";
      plan.transitions.push_back(packed(transition));
    }
    last = name;
    return *this;
  }
  imc::PlanControl start() const {
    imc::PlanControl control;
    control.op = imc::PlanControl::Op::START;
    control.request_id = 21;
    control.plan_id = plan.plan_id;
    control.arg = packed(plan);
    return control;
  }

  std::string last;
};

}  // namespace jarol::tests
