// Fixed-gain observers of the helicopter's filter: one axis of place, and an angle that is slow to be corrected.
#pragma once

#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// One axis of a fixed-gain observer of place x (m), speed v (m/s) and the accelerometer's bias b (m/s^2). Over dt:
///   x += v dt + (a - b) dt^2 / 2,   v += (a - b) dt
/// and by a measured place z, T after the one before, with beta = e^(-bandwidth T) and e = z - x:
///   x += (1 - beta^3) e,   v += 3/2 (1 - beta)^2 (1 + beta) e / T,   b -= (1 - beta)^3 e / T^2
/// The error then follows (s + bandwidth)^3: the critically damped filter of third order (Brookner, "Tracking and
/// Kalman Filtering Made Easy", 1998, section 1.3).
struct AxisObserver {
  double place = 0, speed = 0, bias = 0;
  double since = 0, seen = 1e9;
  double residual_squared = 0;

  static constexpr auto fields() {
    using A = AxisObserver;
    return describe(field<&A::place>("m"), field<&A::speed>("m/s"), field<&A::bias>("m/s^2", "of the accelerometer"),
                    field<&A::since>("s", "the last measurement"),
                    field<&A::seen>("m", "where it stands, measured last; 1e9: nothing yet"),
                    field<&A::residual_squared>("m^2", "of what is measured, averaged"));
  }
};

/// How noisy what is measured is: the root mean square of what it differs by from what was foreseen.
struct ReadingNoise {
  double usual = 0.012;
  double part = 0.05;

  static constexpr auto fields() {
    return describe(field<&ReadingNoise::usual>("m", "up to which it is followed with the full bandwidth").in(1e-4, 10),
                    field<&ReadingNoise::part>("", "of a new reading in that mean").in(0, 1));
  }
};

/// How the same axis is tracked where a part of its acceleration is not felt, by z, T after the one before: with e =
/// z - x, alpha and beta of an alpha-beta filter of that tracking index, and gamma = beta^2 / alpha for the bias,
///   lambda = push T^2 / noise,   r = (4 + lambda - sqrt(lambda (8 + lambda))) / 4
///   alpha = 1 - r^2,   beta = 2 (2 - alpha) - 4 sqrt(1 - alpha) = 2 (1 - r)^2
///   x += alpha e,   v += beta e / T,   b -= beta^2 / (2 alpha) e / T^2
/// Kalata, "The Tracking Index: A Generalized Parameter for alpha-beta and alpha-beta-gamma Target Trackers", 1984.
struct UnfeltClimb {
  double push = 1;
  double noise = 0.0038;

  static constexpr auto fields() {
    return describe(
        field<&UnfeltClimb::push>("m/s^2", "of what is not felt: the greater, the faster it tracks").in(0.001, 1000),
        field<&UnfeltClimb::noise>("m", "of a range: the greater, the slower").in(1e-6, 1));
  }
};

/// An angle (rad) that its rate turns, whose bias b (rad/s) is learnt; what is measured corrects it only slowly. Over
/// dt:
///   angle += (rate - b) dt
/// and by a measured angle z each dt, with beta = e^(-bandwidth dt) and e = z - angle:
///   angle += (1 - beta^2) e,   b -= (1 - beta)^2 e / dt
/// (s + bandwidth)^2: the critically damped filter of second order (Brookner, section 1.2).
struct SlowAngle {
  double angle = 0, bias = 0;

  static constexpr auto fields() {
    return describe(field<&SlowAngle::angle>("rad"), field<&SlowAngle::bias>("rad/s", "of its rate"));
  }
};

/// How it turned at the last reading of the IMU.
struct LastTurn {
  double since = 0, roll = 0, pitch = 0, roll_rate = 0, pitch_rate = 0;

  static constexpr auto fields() {
    using L = LastTurn;
    return describe(field<&L::since>("s", "that reading"), field<&L::roll>("rad"), field<&L::pitch>("rad"),
                    field<&L::roll_rate>("rad/s", "of the Euler angle"), field<&L::pitch_rate>("rad/s"));
  }
};

/// The pressure where it stands.
struct GroundPressure {
  double mean = 0, step_squared = 0;
  std::uint32_t readings = 0;

  static constexpr auto fields() {
    using G = GroundPressure;
    return describe(field<&G::mean>("Pa"), field<&G::step_squared>("Pa^2", "from one reading to the next, averaged"),
                    field<&G::readings>("", "in these averages, up to drift.rest.steps"));
  }
};

/// What it learns where it stands: of each new reading a part, in an average.
struct RestLearning {
  double bias_part = 0.02;
  double place_part = 0.1;
  double pressure_part = 0.1;
  std::uint32_t steps = 200;
  double max_step = 20;

  static constexpr auto fields() {
    using R = RestLearning;
    return describe(
        field<&R::bias_part>("", "of a reading in the bias of the accelerometer, or of a rate").in(0, 1),
        field<&R::place_part>("", "of one in the place where it stands").in(0, 1),
        field<&R::pressure_part>("", "of one in the mean of the pressure").in(0, 1),
        field<&R::steps>("", "of the pressure from reading to reading, averaged for its noise, at most").in(2, 10000),
        field<&R::max_step>("Pa", "greatest such difference that counts: a gust is no noise").in(0, 10000));
  }
};

/// Acceleration (m/s^2) is integrated over dt (s).
void predict(AxisObserver& axis, double acceleration, double dt);

/// What is measured (m) corrects place, speed and bias, with three poles at the bandwidth (rad/s).
void correct(AxisObserver& axis, double measured, double bandwidth);

/// What is measured (m) is averaged in the square of what it differs by.
void learn_noise(AxisObserver& axis, double measured, const ReadingNoise& by);

/// The part of its bandwidth with which readings that noisy are followed: usual / rms, at most 1.
double quiet_part(const AxisObserver& axis, const ReadingNoise& by);

/// What is measured (m) corrects place, speed and bias by the gains of UnfeltClimb.
void track(AxisObserver& axis, double measured, const UnfeltClimb& by);

/// Standing still it does not move, and what it feels is the accelerometer's bias.
void rest(AxisObserver& axis, double acceleration, const RestLearning& by);

/// What is measured (m) where it stands is averaged, as zero before the first flight and as the place after it, if it
/// is within `jump` (m) of what was measured before: one that is wrong alone would be felt throughout the flight. The
/// first counts at once, until two that agree deny it.
void settle(AxisObserver& axis, double& zero, double measured, double jump, bool has_flown, const RestLearning& by);

/// Where it takes off is zero.
void take_off(AxisObserver& axis, double& zero);

/// The rate (rad/s) of an Euler angle, less its bias, is integrated over dt (s).
void predict(SlowAngle& slow, double rate, double dt);

/// What is measured (rad) each dt (s) corrects angle and bias, with two poles at the bandwidth (rad/s).
void correct(SlowAngle& slow, double measured, double bandwidth, double dt);

/// Standing still the angle is what is measured, and its rate is its bias.
void rest(SlowAngle& slow, double measured, double rate, const RestLearning& by);

/// The pressure (Pa) is averaged, and how noisy it is, `last` being the reading before.
void learn(GroundPressure& ground, double pressure, double last, const RestLearning& by);

}  // namespace jarol::tasks
