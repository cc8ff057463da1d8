// Plans and references beyond what the vehicle can do, refused in words.
#include "distributers/lauv/flight_limits.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "graph/math/geometry.h"
#include "graph/text/errors.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using distributers::make_maneuver;

// At the origin, 3 m deep, at 1 m/s.
template <class M>
M flown() {
  M m;
  m.lat = origin.latitude;
  m.lon = origin.longitude;
  m.speed = 1;
  if constexpr (requires { m.z; }) {
    m.z = 3;
    m.z_units = imc::ZUnits::DEPTH;
  }
  return m;
}

template <class M>
void refuses(const M& m, const char* why) {
  CHECK_THROWS_WITH_AS(make_maneuver(packed(m), origin), why, InputError);
}

template <class M>
void flies(const M& m) {
  CHECK_NOTHROW(make_maneuver(packed(m), origin));
}

imc::PlanControl start(const imc::Goto& m) {
  imc::PlanControl request;
  request.plan_id = "p";
  request.arg = packed(m);
  return request;
}
}  // namespace

TEST_SUITE("distributers/lauv/flight_limits") {
  TEST_CASE("deeper or nearer to the floor than half a metre within the supervisor's limits is refused") {
    auto m = flown<imc::Goto>();
    m.z = 11.5F;
    flies(m);
    m.z = 13;
    refuses(m, "z is 13 m; depths are at most 11.5 m");
    m.z = 1e30F;
    refuses(m, "z is 1e+30 m; depths are at most 11.5 m");
    m.z_units = imc::ZUnits::ALTITUDE;
    m.z = 2.5F;
    flies(m);
    m.z = 2;
    refuses(m, "z is 2 m; altitudes are at least 2.5 m");
    auto path = flown<imc::FollowPath>();
    path.points.push_back(packed(imc::PathPoint{30, 0, 8.5F}));
    flies(path);
    path.points.push_back(packed(imc::PathPoint{60, 0, 30}));
    refuses(path, "the level of point 2 is 33 m; depths are at most 11.5 m");
    auto yoyo = flown<imc::YoYo>();
    yoyo.z = 11;
    yoyo.amplitude = 3;
    yoyo.pitch = 0.2F;
    refuses(yoyo, "z plus amplitude is 14 m; depths are at most 11.5 m");
    yoyo.z = 5;
    yoyo.z_units = imc::ZUnits::ALTITUDE;
    refuses(yoyo, "z less amplitude is 2 m; altitudes are at least 2.5 m");
    auto elevator = flown<imc::Elevator>();
    elevator.start_z_units = elevator.end_z_units = imc::ZUnits::DEPTH;
    elevator.end_z = 40;
    refuses(elevator, "end_z is 40 m; depths are at most 11.5 m");
    elevator.end_z = 2;
    elevator.start_z = 12;
    refuses(elevator, "start_z is 12 m; depths are at most 11.5 m");
  }

  TEST_CASE("a speed at which it does not move, or that it does not reach, is refused") {
    auto m = flown<imc::Goto>();
    m.speed = 1e-45F;
    refuses(m, "speed is 1.4013e-45 m/s; speeds are 0.2 to 2 m/s");
    m.speed = 1e-3F;
    refuses(m, "speed is 0.001 m/s; speeds are 0.2 to 2 m/s");
    m.speed = 2.5F;
    refuses(m, "speed is 2.5 m/s; speeds are 0.2 to 2 m/s");
    for (const float speed : {0.2F, 2.0F}) {
      m.speed = speed;
      flies(m);
    }
    m.speed_units = imc::SpeedUnits::PERCENTAGE;
    m.speed = 0.001F;
    refuses(m, "speed is 0.001 %; these are 10 to 100 %");
    m.speed = 101;
    refuses(m, "speed is 101 %; these are 10 to 100 %");
    m.speed = 100;
    flies(m);
  }

  TEST_CASE("a circle that has no end, and angles and directions that are none, are refused") {
    auto loiter = flown<imc::Loiter>();
    loiter.radius = 1000;
    flies(loiter);
    loiter.radius = 1e5F;
    refuses(loiter, "radius is 100000 m; it is at most 1000 m");
    loiter.radius = 15;
    loiter.direction = 77;
    refuses(loiter, "direction is 77; it is VDEP, CLOCKW, CCLOCKW or IWINDCURR, 0 to 3");
    imc::FollowReference follow;
    follow.loiter_radius = -3e38F;
    refuses(follow, "loiter_radius is 3e+38 m; it is at most 1000 m");
    auto rows = flown<imc::Rows>();
    rows.length = 10;
    rows.bearing = 1e308;
    refuses(rows, "bearing is 1e+308 rad; it is -6.283 to 6.283 rad");
    rows.bearing = 0;
    rows.cross_angle = -7;
    refuses(rows, "cross_angle is -7 rad; it is -6.283 to 6.283 rad");
    auto m = flown<imc::Goto>();
    m.lat = 91 * degree;
    refuses(m, "lat is 1.58825 rad; it is -1.571 to 1.571 rad");
    m = flown<imc::Goto>();
    m.lon = 1e308;
    refuses(m, "lon is 1e+308 rad; it is -6.283 to 6.283 rad");
  }

  TEST_CASE("the limits are the operator's parameters, for maneuvers, plans and references") {
    auto m = flown<imc::Goto>();
    m.z = 13;
    for (const bool deep : {false, true}) {
      CAPTURE(deep);
      Conversation c({.limits = {.max_depth = deep ? 30.0 : 12.0}});
      c.say(start(m));
      c.pass(50ms);
      CHECK(c.to.last<imc::PlanControl>().info == (deep ? "" : "z is 13 m; depths are at most 11.5 m"));
      imc::PlanManeuver named;
      named.maneuver_id = "down";
      named.data = packed(m);
      imc::PlanSpecification plan;
      plan.plan_id = "p";
      plan.start_man_id = "down";
      plan.maneuvers.push_back(packed(named));
      imc::PlanControl request;
      request.plan_id = "p";
      request.arg = packed(plan);
      c.say(request);
      c.pass(50ms);
      CHECK(c.to.last<imc::PlanControl>().info ==
            (deep ? "" : "maneuver 'down': z is 13 m; depths are at most 11.5 m"));
      imc::VehicleCommand command;
      command.maneuver = packed(m);
      c.say(command);
      c.pass(50ms);
      CHECK(c.to.last<imc::VehicleCommand>().info == (deep ? "" : "z is 13 m; depths are at most 11.5 m"));
      imc::FollowReference follow;
      follow.control_src = 0xffff;
      follow.control_ent = 0xff;
      request.arg = packed(follow);
      c.say(request);
      imc::Reference reference;
      reference.flags = imc::Reference::Flags::Z;
      reference.z = packed(imc::DesiredZ{13, imc::ZUnits::DEPTH});
      c.say(reference);
      c.pass(50ms);
      tasks::Leg leg;
      c.adapter.take<&LauvOperator::In::leg>(leg);
      CHECK(leg.level == (deep ? 13 : 0));
      if (!deep)
        CHECK(c.to.last<imc::LogBookEntry>().text == "a reference is left out: z is 13 m; depths are at most 11.5 m");
    }
  }

  TEST_CASE("a reference whose radius is beyond the limit is left out") {
    distributers::ReferenceFollower follower({.control_source = 0xffff, .control_entity = 0xff}, {});
    imc::Reference reference;
    reference.flags = imc::Reference::Flags::RADIUS;
    reference.radius = -1e30F;
    CHECK_THROWS_WITH_AS(follower.take(reference, 1, 1, {}, origin, {}),
                         "the reference's radius is 1e+30 m; it is at most 1000 m", InputError);
  }
}
