// The phases of the helicopter's flight that need no law of altitude, and what its law follows in a landing. Thrust is
// in parts of that of hover, altitude in m above the place of take-off, climb positive up.
#pragma once

#include "tasks/javiator/altitude_control.h"

namespace jarol::tasks {

/// What a phase reads and writes.
struct AltitudeStep {
  const AltitudeControl::Param& p;
  const FlightEstimate& e;
  const FlightDirective& d;
  double dt;
  AltitudeControl::State& state;
  LiftDemand& lift;
};

/// Halted or on the ground: rotors that still turn run down.
void run_down(const AltitudeStep& step);

/// From rest to idle, `idle` in `spin_up`.
void spin_up(const AltitudeStep& step);

/// Thrust grows at `lift_rate` until the ground is left, and is learnt on the way; it shrinks where it is to stay.
void leave_ground(const AltitudeStep& step);

/// The IMU is lost, and neither sonars nor lasers show how it leans:
///   thrust = mean_trim - margin + blind_trim - blind_cut + gain excess,   excess = -speed - climb,
///   blind_trim_dot = ki excess
/// by the climb that a sonar measures; where none does, only a blind_trim below 0 is kept. blind_cut grows on the
/// ground, and with time where nobody measures the altitude.
void sink_blind(const AltitudeStep& step);

/// In flight, but to stand on the ground where it is commanded to fly that low.
bool settles(const AltitudeStep& step);

/// The altitude and the climb that a landing follows, in m and s:
///   z.demand = w (-speed - z.speed), bounded,   z.speed_dot = z.demand,   z.place_dot = z.speed
///   w = descent_gain: speed = descent above `high`, if the pressure confirms that, else touch_speed + late,
///                     late = overdue (landing - landing_time) from 0 to touch_speed
///   quick:            w = its gain, speed = part sqrt(touch_speed^2 + 2 brake (altitude - low)), up to part descent,
///                     at least touch_speed; part = 2 - hypot(v_x, v_y) / drift from 0 to 1
void descend(const AltitudeStep& step, const QuickLanding* quick);

}  // namespace jarol::tasks
