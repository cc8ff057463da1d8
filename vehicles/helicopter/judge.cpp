#include "vehicles/helicopter/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"
#include "vehicles/helicopter/coefficients.h"
#include "vehicles/helicopter/robostix.h"

namespace jarol::vehicles {
namespace {

constexpr double airborne = 0.02;  // m, of the lowest foot above the ground

double yaw_of(const HelicopterMotion& motion) { return euler_angles_of(motion.R_nb).yaw; }

// Of its centre of gravity, downwards.
double sink_of(const HelicopterMotion& motion) { return to_ned(motion.R_nb, motion.v_b)[2]; }

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace

HelicopterJudge::HelicopterJudge(const HelicopterParameters& parameters, const HelicopterMotion& start)
    : body_(make_body(parameters)),
      limits_(parameters.limits),
      upright_(std::cos(parameters.limits.tilt) + 1e-9),
      start_(start),
      start_yaw_(yaw_of(start)),
      last_(start) {
  has_flown_ = height() > airborne;
}

void HelicopterJudge::serialize(Archive& archive) {
  if (!is_found_) find_truth();
  archive(start_, last_, truth_, mishap_, has_flown_, last_instant_, driven_);
  start_yaw_ = yaw_of(start_);
}

void HelicopterJudge::find_truth() const {
  const HelicopterMotion& m = last_;
  const auto& R = m.R_nb;
  const fossen::Vector3 v_n = to_ned(R, m.v_b);
  const EulerAngles attitude = euler_angles_of(R);
  truth_.roll = attitude.roll;
  truth_.pitch = attitude.pitch;
  truth_.yaw = wrapped(attitude.yaw - start_yaw_);
  truth_.x = m.p_n[0] - start_.p_n[0];
  truth_.y = m.p_n[1] - start_.p_n[1];
  truth_.altitude = start_.p_n[2] - m.p_n[2];
  truth_.climb = -v_n[2];
  truth_.speed = std::hypot(v_n[0], v_n[1]);
  truth_.tilt = std::acos(std::clamp(R[2][2], -1.0, 1.0));
  truth_.height = height();
  is_found_ = true;
}

double HelicopterJudge::height() const {
  double lowest = -1e9;
  for (std::size_t i = 0; i < foot_count; ++i) lowest = std::max(lowest, foot_depth(last_, body_.feet.r_b[i]));
  return -lowest;
}

void HelicopterJudge::look(std::chrono::nanoseconds instant, const HelicopterMotion& motion,
                           const std::array<double, 4>& settings) {
  for (std::size_t i = 0; i < contact_count && may_touch(body_, motion); ++i) meet_ground(instant, motion, i);
  last_ = motion;
  is_found_ = false;
  if (!mishap_) find_capsize(instant);
  has_flown_ = has_flown_ || height() > airborne;
  const double mean = (settings[0] + settings[1] + settings[2] + settings[3]) / 4;
  if (!has_flown_ && max_signal * mean >= limits_.take_off_signal)
    driven_ += std::chrono::duration<double>(instant - last_instant_).count();
  last_instant_ = instant;
}

void HelicopterJudge::meet_ground(std::chrono::nanoseconds instant, const HelicopterMotion& motion, std::size_t part) {
  const fossen::Vector3& r_b = body_.feet.r_b[part];
  if (foot_depth(last_, r_b) > 0 || foot_depth(motion, r_b) <= 0) return;
  const FootMotion before = foot_motion(last_, r_b), after = foot_motion(motion, r_b);
  // the ground has slowed it down since it touched
  const double speed = std::max(before.v_n[2], after.v_n[2]);
  const double sink = std::max(sink_of(last_), sink_of(motion));
  truth_.touch_down = std::max(truth_.touch_down, sink);
  truth_.impact = std::max(truth_.impact, speed);
  if (mishap_) return;
  if (part >= foot_count)
    mishap_ = {instant,
               part + 1 < contact_count ? "crashed: a rotor met the ground" : "crashed: its top met the ground"};
  else if (speed > limits_.touch_speed)
    mishap_ = {instant,
               fmt::format("crashed: a foot met the ground at {:.1f} m/s, above {} m/s", speed, limits_.touch_speed)};
}

void HelicopterJudge::find_capsize(std::chrono::nanoseconds instant) {
  // by its cosine where that suffices
  if (last_.R_nb[2][2] > upright_ || !(truth().tilt > limits_.tilt)) return;
  mishap_ = {instant, fmt::format("capsized: tilted by {:.0f} deg, beyond {:.0f} deg", degrees(truth_.tilt),
                                  degrees(limits_.tilt))};
}

std::optional<Mishap> HelicopterJudge::mishap() const {
  if (mishap_) return mishap_;
  if (has_flown_ || driven_ < limits_.take_off_time) return std::nullopt;
  return Mishap{last_instant_, fmt::format("never taken off: its rotors were at {} or more of 16000 for {:.1f} s",
                                           limits_.take_off_signal, driven_)};
}

std::string HelicopterJudge::unrest() const {
  constexpr double stands = 0.1;  // m, wherever it leans
  return truth().height > stands ? fmt::format("it is {:.2f} m above the ground", truth_.height) : "";
}

}  // namespace jarol::vehicles
