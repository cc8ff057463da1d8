#include "vehicles/helicopter/dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "distributers/interfaces/no_state.h"

namespace jarol::vehicles {
namespace {

constexpr double speed_of_sound = 340;  // m/s

bool is_finite(const HelicopterMotion& m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += m.p_n[i] + m.v_b[i] + m.omega_b[i] + m.R_nb[i][0] + m.R_nb[i][1];
  return std::isfinite(sum);
}

}  // namespace

HelicopterDynamics::HelicopterDynamics(const HelicopterBody& body, const HelicopterMotion& start,
                                       const std::array<double, 4>& settings)
    : body_(body), motion_(start) {
  input_.from = input_.to = settings;
  input_.payload = body.payload;
  for (std::size_t i = 0; i < contact_count; ++i) {
    const FootMotion foot = foot_motion(motion_, body_.feet.r_b[i]);
    input_.anchors[i] = {foot.p_n[0], foot.p_n[1]};
  }
}

// could any part of it touch the ground within a step?
bool HelicopterDynamics::near_ground() const {
  const auto sum_of = [](const fossen::Vector3& x) { return std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]); };
  // m/s that no part of it moves faster than
  const double fastest = sum_of(motion_.v_b) + sum_of(motion_.omega_b) * body_.feet.reach;
  if (!may_touch(body_, motion_, 0.021 + 2e-9 * step_nanoseconds * fastest)) return false;
  for (const fossen::Vector3& r_b : body_.feet.r_b) {
    if (foot_depth(motion_, r_b) < -0.021 - 2e-9 * step_nanoseconds * fastest) continue;
    const FootMotion foot = foot_motion(motion_, r_b);
    if (foot.p_n[2] > -0.02 - 2e-9 * step_nanoseconds * std::abs(foot.v_n[2])) return true;
  }
  return false;
}

std::array<double, 4> HelicopterDynamics::thrusts() const { return body_.thrust_law.parts(input_.from); }

void HelicopterDynamics::step(const HelicopterCommand& command) {
  if (!failure_.empty()) throw NoState(failure_);
  input_.to = command.settings;
  input_.wind_n = command.wind_n;
  input_.payload = command.payload;
  near_ground_ = near_ground();
  const long parts = near_ground_ ? 5 : 1;
  for (long i = 0; i < parts; ++i) advance_to(now_ + step_nanoseconds / parts);
}

// an integrator may notice a number that is not finite itself, or not at all; it must not be asked again after that
void HelicopterDynamics::advance_to(long nanoseconds) {
  const double t = seconds_of(nanoseconds);
  try {
    motion_ = advance(input_, input_.begin, t);
    if (!is_finite(motion_)) {
      failure_ = "a number in it is not finite";
    } else if (const double speed = std::sqrt(fossen::dot(motion_.v_b, motion_.v_b)); speed > speed_of_sound) {
      // one that has turned over may spin faster than steps of a fixed length can follow
      failure_ = fmt::format("it moves at {:.0f} m/s, which this model of it is not made for", speed);
    }
  } catch (const std::exception& e) { failure_ = e.what(); }
  if (!failure_.empty()) {
    failure_ = "helicopter: no state at t = " + std::to_string(t) + " s: " + failure_;
    throw NoState(failure_);
  }
  now_ = nanoseconds;
  const double remaining = calc_remaining(body_, t - input_.begin);
  for (std::size_t i = 0; i < 4; ++i) input_.from[i] = input_.to[i] + (input_.from[i] - input_.to[i]) * remaining;
  input_.begin = t;
  // what is far from the ground grips nowhere, and begins to be looked after in time before it could touch
  if (!near_ground_) return;
  for (std::size_t i = 0; i < contact_count; ++i)
    input_.anchors[i] = drag_along(body_.feet, foot_motion(motion_, body_.feet.r_b[i]), input_.anchors[i]);
}

fossen::Vector3 HelicopterDynamics::specific_force() const {
  const fossen::Vector6 loads = calc_loads(body_, motion_, input_, input_.begin);
  return {loads[0] / body_.mass, loads[1] / body_.mass, loads[2] / body_.mass};
}

void HelicopterDynamics::serialize(Archive& archive) {
  archive(input_, motion_, now_, failure_);
  archive.require(now_ >= 0, "has a vehicle before the start");
  serialize_state(archive, seconds_of(now_));
}

}  // namespace jarol::vehicles
