// The helicopter's law of altitude; altitude_phases.h has what it does on the ground, blind, and in a landing.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/approach.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// A landing without an IMU, which is over before gusts turn it: nobody feels them, and lasers show a lean towards
/// their walls late, sonars 22 times a second.
struct QuickLanding {
  double kp = 20;
  double kd = 7;
  double gain = 10;
  double descent = 1.6;
  double acceleration = 5;
  double brake = 2.5;
  double low = 0.1;
  double touch_speed = 0.15;
  double drift = 0.7;
  double fade = 1;
  double contact = 0.045;
  double cut = 1.4;
  double back = 1000;
  double up = 4;

  static constexpr auto fields() {
    using Q = QuickLanding;
    return describe(
        field<&Q::kp>("1/s^2", "acceleration per error of altitude"),
        field<&Q::kd>("1/s", "acceleration per error of climb"),
        field<&Q::gain>("1/s", "acceleration per error of speed"), field<&Q::descent>("m/s", "at most"),
        field<&Q::acceleration>("m/s^2", "into it, at most"), field<&Q::brake>("m/s^2", "out of it").in(0, 100),
        field<&Q::low>("m", "altitude at which it has slowed to touch_speed"),
        field<&Q::touch_speed>("m/s", "of its last part"),
        field<&Q::drift>("m/s", "to the side, beyond which it descends more slowly, at twice of it by touch_speed")
            .in(0.01, 100),
        field<&Q::fade>("s",
                        "in which a third is left of the thrust against the gust that it last felt, beside its mean"),
        field<&Q::contact>("m",
                           "altitude from which on thrust is taken back: a foot may stand; where sonars show how it "
                           "leans, they show when"),
        field<&Q::cut>("1/s", "at which it is: it settles on its other feet"),
        field<&Q::back>("1/s", "at which it is given back where none stands; 1000: at once").in(0, 1000),
        field<&Q::up>("m/s^2", "that it demands there, at most: one wrong range must not throw it up again")
            .in(-100, 100));
  }
};

/// It comes down without an IMU, and neither sonars nor lasers show how it leans (sink_blind in altitude_phases.h).
struct BlindSinking {
  double gain = 0.15;
  double ki = 0.1;
  double speed = 0.25;
  double margin = 0.03;
  double max_trim = 0.2;
  double max_less = 0.2;
  double max_more = 0.06;
  double max_less_unmeasured = 0.06;
  double ground_cut = 2.0;
  double unmeasured_cut = 0.005;
  double cut_when_landed = 0.05;
  double landed_cut = 0.1;
  double max_cut = 2.0;

  static constexpr auto fields() {
    using B = BlindSinking;
    return describe(
        field<&B::gain>("s/m", "thrust per error of descent"),
        field<&B::ki>("1/m", "thrust per integral of that error"), field<&B::speed>("m/s", "of descent"),
        field<&B::margin>("", "of thrust, by which it sinks and does not rise"),
        field<&B::max_trim>("", "greatest thrust by that integral").in(0, 10),
        field<&B::max_less>("", "thrust that a climb takes away at most, where a sonar measures it").in(0, 10),
        field<&B::max_more>("", "thrust that a descent adds at most").in(0, 10),
        field<&B::max_less_unmeasured>("", "max_less where nothing measures the climb").in(0, 10),
        field<&B::ground_cut>("1/s", "at which thrust is taken back where the sonar shows the ground"),
        field<&B::unmeasured_cut>("1/s", "at which it is where nothing measures the altitude"),
        field<&B::cut_when_landed>("", "thrust taken back so until it has come down, and may lie on the ground"),
        field<&B::landed_cut>("1/s", "at which it is from then on"),
        field<&B::max_cut>("", "thrust taken back, at most"));
  }
};

/// How it knows that it stands on the ground, and how it leaves it.
struct OnGround {
  double altitude = 0.02;
  double still = 0.05;
  double carried_lift = 0.25;
  double level = 0.05;
  double near = 0.01;
  double near_by_pressure = 0.03;
  double rising = 0.1;
  double max_thrust = 1.5;
  double run_down = 1.0;

  static constexpr auto fields() {
    using G = OnGround;
    return describe(field<&G::altitude>("m", "up to which it may stand"),
                    field<&G::still>("m/s", "climb of one that stands, at most"),
                    field<&G::carried_lift>("", "of g, felt beyond the thrust of the rotors: the ground's"),
                    field<&G::level>("rad", "lean beyond which it may stand on one foot"),
                    field<&G::near>("m", "altitude that it has then at most, more than that of its lean"),
                    field<&G::near_by_pressure>("m", "the same, where only the pressure shows its altitude"),
                    field<&G::rising>("m/s", "climb from which on it flies"),
                    field<&G::max_thrust>("", "with which it tries to leave the ground, at most").in(1, 10),
                    field<&G::run_down>("s", "from the thrust of hover to none where it stands").in(0.01, 100));
  }
};

/// What thrust and its corrections stay within.
struct AltitudeLimits {
  double min_trim = 0.4;
  double max_trim = 1.7;
  double min_thrust = 0.1;
  double max_thrust = 2.0;
  double sunk = 1;
  double min_upright = 0.5;

  static constexpr auto fields() {
    using L = AltitudeLimits;
    return describe(field<&L::min_trim>("", "least thrust at rest, in parts of that of hover").in(0, 1),
                    field<&L::max_trim>("", "greatest").in(1, 10),
                    field<&L::min_thrust>("", "least in flight").in(0, 1),
                    field<&L::max_thrust>("", "greatest").in(1, 10),
                    field<&L::sunk>("m/s^2", "greatest for a lasting error of altitude").in(0, 100),
                    field<&L::min_upright>("", "cosine of the greatest lean that thrust makes up for").in(0.01, 1));
  }
};

/// Altitude z (m) and climb (m/s) are positive up, from the place of take-off; thrust is in parts of that of hover. In
/// flight, with z.place, z.speed and z.demand of the approach to a commanded altitude (approach.h) or of a landing:
///   a      = z.demand + kp (z.place - altitude) + kd (z.speed - climb) + sunk          m/s^2
///            in a quick landing with its own kp and kd (quick, or by_sonars), and on contact at most its `up`
///   sunk_dot     = ki (z.place - altitude), |sunk| <= limits.sunk
///   thrust = trim + (1 + a / g) / max(cos(phi) cos(theta), min_upright) - 1 - foot_cut
///   foot_cut_dot = `cut` of the quick landing where a foot may stand, up to max_thrust; else -back, down to 0
///   trim_dot     = lift_bandwidth (1 + expected - lift / g)
///   expected_dot = (thrust - trim - expected) / lift_lag
/// phi and theta are roll and pitch, lift the specific force that the accelerometer feels upwards along the body's axis
/// (m/s^2), and trim what hover takes: an observer of the disturbance of thrust. On one foot, while it comes down, trim
/// falls at unload times the time on that foot. A landing whose altitude sonar and pressure do not both
/// show stands, and levels, as soon as the ground carries: thrust < light, lift / g - trim - expected > carried_lift.
/// In a quick landing nobody feels lift, and the gust that was felt last passes: trim_dot = (mean - trim) / fade, of
/// its mean over mean_time up to then. These equations are this project's; those of the JAviator's own controller
/// (github.com/cksystemsgroup/JAviator) are in original_control.h.
struct AltitudeControl {
  static constexpr std::string_view summary = "takes off softly, holds a commanded altitude, and lands softly";
  struct Param {
    double kp = 12;
    double kd = 7;
    double ki = 1;
    double lift_bandwidth = 10;
    double lift_lag = 0.06;
    ApproachLimits approach{.bandwidth = 2.2, .speed = 1, .acceleration = 2, .jerk = 15, .lag = 0.08};
    double idle = 0.5;
    double light = 0.6;
    double leaving = 0.8;
    double lift_rate = 1.5;
    double descent = 0.5;
    double touch_speed = 0.2;
    double landing_time = 8;
    double overdue = 0.05;
    double spin_up = 1.5;
    double foot = 0.2;
    double unload = 0.8;
    double low = 0.15;
    double high = 0.5;
    double descent_gain = 3;
    double max_descent_change = 2;
    double max_below = 0.15;
    double first_aloft = 0.4;
    double mean_time = 4.0;
    AltitudeLimits limits{};
    OnGround ground{};
    BlindSinking blind{};
    QuickLanding quick{};
    QuickLanding by_sonars{.kp = 18.9,
                           .kd = 14.1,
                           .low = 0.153,
                           .touch_speed = 0.175,
                           .drift = 0.35,
                           .fade = 0.9,
                           .cut = 1.4,
                           .back = 0.11,
                           .up = -0.25};
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::kp>("1/s^2", "acceleration per error of altitude"),
          field<&P::kd>("1/s", "acceleration per error of climb"),
          field<&P::ki>("1/s^3", "acceleration per integral of the error of altitude"),
          field<&P::lift_bandwidth>("rad/s", "at which thrust is learnt from the lift that is felt"),
          field<&P::lift_lag>("s", "until thrust demanded is felt"), field<&P::approach>("", "to a new altitude"),
          field<&P::idle>("", "thrust while standing ready, in parts of that of hover").in(0, 1),
          field<&P::light>("", "thrust below which the ground must carry"),
          field<&P::leaving>("", "thrust up to which it stands while that grows"),
          field<&P::lift_rate>("1/s", "at which thrust grows until it lifts off"),
          field<&P::descent>("m/s", "of a landing"), field<&P::touch_speed>("m/s", "of its last part"),
          field<&P::landing_time>("s",
                                  "after which a landing is overdue: it may descend more slowly than "
                                  "it believes"),
          field<&P::overdue>("m/s^2", "by which its last part gets faster then, up to twice its speed"),
          field<&P::spin_up>("s", "from rest to idle"), field<&P::foot>("m", "of a foot from the axis").in(0.01, 10),
          field<&P::unload>("1/s^2", "at which thrust is taken back the faster, the longer it stands on one foot"),
          field<&P::low>("m", "altitude below which it settles when it is flown to the ground by hand"),
          field<&P::high>("m", "altitude above which a landing descends fast"),
          field<&P::descent_gain>("1/s", "acceleration of a landing per error of its speed"),
          field<&P::max_descent_change>("m/s^2", "greatest of that").in(0, 100),
          field<&P::max_below>("m", "by which what a landing follows is below the vehicle, at most"),
          field<&P::first_aloft>("s", "for which the first thrust aloft counts in the mean of what carries it")
              .in(0.01, 100),
          field<&P::mean_time>("s", "over which that mean is").in(0.01, 100), field<&P::limits>(),
          field<&P::ground>("", "how it knows that it stands there, or leaves it"),
          field<&P::blind>("", "when the IMU is lost, and nothing shows how it leans"),
          field<&P::quick>("", "when the IMU is lost, but lasers show how it leans"),
          field<&P::by_sonars>("", "when the IMU is lost, but sonars do"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::directive>(),
                      field<&In::gains>("", "of other laws: not looked at"));
    }
  };
  struct State {
    Approach z{};
    double trim = 0, mean_trim = 0;
    double expected = 0;
    double sunk = 0, blind_trim = 0, blind_cut = 0, foot_cut = 0, aloft = 0;
    double landing = 0, on_foot = 0;
    bool lifted = false;
    static constexpr auto fields() {
      using S = State;
      return describe(
          field<&S::z>(), field<&S::trim>("", "thrust at rest, learnt"),
          field<&S::mean_trim>("", "over mean_time aloft, with what hover takes at first"),
          field<&S::expected>("", "thrust that should be felt now, less the trim"),
          field<&S::sunk>("m/s^2", "acceleration that makes up for a lasting error of altitude"),
          field<&S::blind_trim>("", "correction of the mean, learnt blind"),
          field<&S::blind_cut>("", "thrust that is taken back, blind"),
          field<&S::foot_cut>("", "thrust that is taken back where a foot may stand, without an IMU"),
          field<&S::aloft>("s", "over which that mean is, up to mean_time: first_aloft of hover's at first"),
          field<&S::landing>("s", "since it began to land"), field<&S::on_foot>("s", "of that on one foot"),
          field<&S::lifted>("", "it has left the ground"));
    }
  };
  struct Out {
    LiftDemand lift{};
    static constexpr auto fields() { return describe(field<&Out::lift>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
