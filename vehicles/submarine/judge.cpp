#include "vehicles/submarine/judge.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"

namespace jarol::vehicles {
namespace {

// How far the lower end of the hull is below its middle: two spheres in its ends.
double calc_reach(const HullParameters& hull, double pitch) {
  return (hull.length - hull.diameter) / 2 * std::abs(std::sin(pitch)) + hull.diameter / 2;
}

}  // namespace

SubmarineJudge::SubmarineJudge(const SubmarineParameters& parameters, const VehicleState& start)
    : parameters_(parameters) {
  report_truth(start);
}

void SubmarineJudge::report_truth(const VehicleState& s) {
  truth_ = {.depth = s.z,
            .heading = s.psi,
            .speed = s.u,
            .roll = s.phi,
            .pitch = s.theta,
            .x = s.x,
            .y = s.y,
            .altitude = parameters_.sea.floor - s.z - calc_reach(parameters_.hull, s.theta),
            .sinking = sinking(s.phi, s.theta, s.u, s.v, s.w),
            .turn_rate = s.r};
}

void SubmarineJudge::look(std::chrono::nanoseconds instant, const VehicleState& state) {
  report_truth(state);
  if (mishap_) return;
  const DiveLimitParameters& limits = parameters_.limits;
  const double tilt = std::acos(limited(down_in_body(state.phi, state.theta)[2], 1.0));
  const auto degrees = [](double radians) { return radians * 180.0 / std::numbers::pi; };
  // there is no sea floor where it moves as DUNE's simulator has it
  if (truth_.altitude <= 0 && !parameters_.vsim_compatible) {
    mishap_ = {instant, fmt::format("sunk: it touched the sea floor, {} m deep", parameters_.sea.floor)};
  } else if (truth_.depth > limits.depth) {
    mishap_ = {instant, fmt::format("sunk: {:.1f} m deep, beyond {} m", truth_.depth, limits.depth)};
  } else if (tilt > limits.tilt) {
    mishap_ = {instant,
               fmt::format("capsized: tilted by {:.0f} deg, beyond {:.0f} deg", degrees(tilt), degrees(limits.tilt))};
  }
}

std::string SubmarineJudge::unrest() const {
  constexpr double surfaced = 1;  // m, in waves too
  return truth_.depth > surfaced ? fmt::format("it is {:.2f} m deep", truth_.depth) : "";
}

}  // namespace jarol::vehicles
