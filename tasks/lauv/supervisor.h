// Watches over the submarine: lets the operator's setpoint through while all is well, and brings it up when not.
#pragma once

#include <array>
#include <numbers>
#include <string_view>

#include "graph/task.h"
#include "tasks/lauv/depth_source.h"
#include "tasks/values/alarm.h"
#include "tasks/values/fins.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// What it reckons by itself, to compare instruments with.
struct Reckoning {
  double angle_time = 2;
  double floor_time = 30;
  double drag_growth = 1;
  Water water{};

  static constexpr auto fields() {
    using R = Reckoning;
    return describe(field<&R::angle_time>("s", "over which rates add up to angles").in(0.1, 1000),
                    field<&R::floor_time>("s", "in which the sea floor may rise or fall").in(0.1, 10000),
                    field<&R::drag_growth>("s/m", "by which surge_drag grows per speed, in parts of it").in(0, 100),
                    field<&R::water>("", "by which a pressure is a depth, as LauvNavigation has it"));
  }
};

/// How it levels off where its fins demand it.
struct LevellingOff {
  double min_speed = 0.5;
  double heave_time = 2;

  static constexpr auto fields() {
    using L = LevellingOff;
    return describe(field<&L::min_speed>("m/s", "slowest speed ahead at which its fins level it off").in(0.01, 10),
                    field<&L::heave_time>("s", "over which its motion across the hull is averaged: no waves, no noise")
                        .in(0.1, 1000));
  }
};

/// An instrument that reports no more is lost, and one that is fitted and never reports anything; one that is not
/// fitted is not waited for; attitude, speed log, and a depth gauge without a pressure beside it, without which nothing
/// can be steered, are lost then. One that lies is found by another that knows better: depth gauge and pressure,
/// compass and IMU, attitude and rates, attitude and specific force, speed log and propeller, altitude and depth over a
/// floor without steps: each from when both have reported something. Limits of depth and altitude hold for
/// where it would level off. Once alarmed it comes up: nose up at some speed until GPS finds the surface, or, where
/// attitude or speed are in doubt, the propeller does not turn as it is sent, or the nose does not come up and it
/// sinks, with propeller off, by buoyancy. It stays alarmed, whatever becomes of the cause, until the operator demands
/// a stop when there is none any more: then it is a vehicle at rest, to be commanded anew. Water in the hull takes the
/// place of any other cause. A vehicle of which nothing was heard since the start is not lost but waited for, with
/// propeller off. One whose servos report nothing dives all the same, and the condition says that no fin is checked.
///
/// What is compared, in SI units and rad, with what it reckons (_r); NED and body axes as in control.h, n the speed of
/// the propeller in rad/s, f_b and (p, q, r) what the IMU reports:
///   attitude: theta - theta_r, psi - psi_r;   theta_r_dot = theta_dot(p, q, r) + (theta - theta_r) / angle_time
///             (rotations.h, euler_rates), and so psi_r
///   forces:   |f_b + R_bn (0, 0, g)|;   heading: compass - psi;   depth: gauge - calc_depth(pressure)
///   speed:    u - u_r;   surge_mass u_r_dot = thrust - surge_drag u_r (1 + drag_growth |u_r|),
///             thrust = (thrust_coefficient n - advance_coefficient u_r) |n|,   |thrust| <= max_thrust
///   floor:    d - d_r, d = depth + altitude cos(phi) cos(theta);   d_r_dot = (d - d_r) / floor_time
/// Depth and altitude are those after levelling_length max(z_dot, 0) / max(u, min_speed) more of depth, where
/// z_dot = -u sin(theta) + min(heave, heave averaged over heave_time), heave = v cos(theta) sin(phi) + w cos(theta)
/// cos(phi).
struct LauvSupervisor {
  static constexpr std::string_view summary = "passes the operator's setpoint on, or brings the submarine up";
  struct Param {
    double sensor_timeout = 2.5;
    double vehicle_timeout = 1;
    double gps_timeout = 4;
    double fix_depth = 0.15;
    double operator_timeout = 5;
    double max_depth = 12;
    double min_altitude = 2;
    double levelling_length = 2.2;
    LevellingOff levelling{};
    double max_pitch = 50 * std::numbers::pi / 180;
    double min_voltage = 20;
    double depth_error = 0.3;
    double heading_error = 15 * std::numbers::pi / 180;
    double angle_error = 6 * std::numbers::pi / 180;
    double force_error = 2.5;
    double speed_error = 0.5;
    double floor_error = 1.5;
    double error_time = 1;
    double speed_error_time = 3;
    Reckoning reckoning{};
    double thrust_coefficient = 2.1e-4;
    double advance_coefficient = 0;
    double max_thrust = 14.4;
    double surge_drag = 2.4;
    double surge_mass = 19;
    double climb_speed = 1;
    double climb_time = 60;
    double climb_sink = 1.5;
    bool fins_end_dive = true;
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::sensor_timeout>("s", "an instrument that reports nothing for so long is lost"),
          field<&P::vehicle_timeout>("s", "where none has reported for so long, it is the vehicle that is lost"),
          field<&P::gps_timeout>("s", "the same for GPS at the surface"),
          field<&P::fix_depth>("m", "greatest depth at which GPS has to report").in(0, 10),
          field<&P::operator_timeout>("s", "greatest silence of the operator"),
          field<&P::max_depth>("m", "limit, for where it would level off"),
          field<&P::min_altitude>("m", "the same, over the sea floor"),
          field<&P::levelling_length>("m", "of the way that it takes to level off, whatever its speed").in(0, 100),
          field<&P::levelling>("", "how it levels off"),
          field<&P::max_pitch>("rad", "limit, to either side").in(0, std::numbers::pi / 2),
          field<&P::min_voltage>("V", "limit"),
          field<&P::depth_error>("m", "greatest difference of gauge and pressure"),
          field<&P::heading_error>("rad", "greatest difference of compass and IMU"),
          field<&P::angle_error>("rad", "greatest difference of attitude and what the rates add up to"),
          field<&P::force_error>("m/s^2", "greatest difference of specific force and gravity"),
          field<&P::speed_error>("m/s", "greatest difference of speed log and propeller"),
          field<&P::floor_error>("m", "greatest step of the sea floor"),
          field<&P::error_time>("s", "how long a difference has to last"),
          field<&P::speed_error_time>("s", "the same for speed"),
          field<&P::reckoning>("", "what instruments are compared with"),
          field<&P::thrust_coefficient>("N s^2/rad^2", "of the propeller"),
          field<&P::advance_coefficient>("N s^2/(m rad)", "less thrust per speed of the propeller and speed ahead"),
          field<&P::max_thrust>("N", "of the same"), field<&P::surge_drag>("N s/m", "per speed, at low speed"),
          field<&P::surge_mass>("kg", "with added mass").in(0.1, 10000), field<&P::climb_speed>("m/s", "on the way up"),
          field<&P::climb_time>("s", "after which it stops the propeller in any case"),
          field<&P::climb_sink>("m", "deeper than at the alarm by so much it stops the propeller, too"),
          field<&P::fins_end_dive>(
              "", "false: with fins that are stuck or silent it goes on without an alarm, and says which"));
    }
  };
  struct In {
    Setpoint setpoint{};
    Contact contact{};
    Instruments instruments{};
    FinCondition fins{};
    static constexpr auto fields() {
      return describe(field<&In::setpoint>(), field<&In::contact>(), field<&In::instruments>(), field<&In::fins>());
    }
  };
  struct State {
    bool heard = false;
    Alarm alarm = Alarm::none;
    double since_alarm = 0;
    std::int64_t voltages_before_failure = 0;
    std::int64_t fixes_at_alarm = 0;
    double depth_at_alarm = 0;
    std::uint32_t stops = 0;
    bool surfaced = false;
    std::array<std::int64_t, 17> counts{};
    std::array<double, 17> silences{};
    double since_fix = 0;
    double servos_silent_for = 0;
    std::int64_t fixes = 0;
    std::array<double, 7> wrong_for{};
    bool attitude_started = false, speed_started = false, floor_started = false, heave_started = false;
    double theta = 0, psi = 0, speed = 0, floor = 0, heave = 0;
    static constexpr auto fields() {
      using S = State;
      return describe(
          field<&S::heard>("", "any instrument, up to now"), field<&S::alarm>(), field<&S::since_alarm>("s"),
          field<&S::voltages_before_failure>("", "readings while fins and propeller were sound"),
          field<&S::fixes_at_alarm>(), field<&S::depth_at_alarm>("m", "by the gauge"),
          field<&S::stops>("", "of the operator, up to now"), field<&S::surfaced>(),
          field<&S::counts>("", "of each instrument"), field<&S::silences>("s", "of each instrument"),
          field<&S::since_fix>("s", "at the surface"),
          field<&S::servos_silent_for>("s", "none has reported, though the vehicle has"), field<&S::fixes>(),
          field<&S::wrong_for>("s", "each difference, for so long"), field<&S::attitude_started>(),
          field<&S::speed_started>(), field<&S::floor_started>(), field<&S::heave_started>(),
          field<&S::theta>("rad", "that the rates add up to"), field<&S::psi>("rad", "that the rates add up to"),
          field<&S::speed>("m/s", "that the propeller gives"), field<&S::floor>("m", "depth of the sea floor"),
          field<&S::heave>("m/s", "down, by its motion across the hull, without waves and noise"));
    }
  };
  struct Out {
    Setpoint setpoint{};
    Condition condition{};
    static constexpr auto fields() { return describe(field<&Out::setpoint>(), field<&Out::condition>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
