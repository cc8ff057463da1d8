// How the helicopter leans, without its IMU: sonars show it, and it is pushed where it leans, which the lasers see.
#pragma once

#include <array>
#include <string_view>

#include "graph/math/geometry.h"
#include "graph/task.h"
#include "tasks/javiator/sonar_tilt.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// How it may move along one horizontal axis, north or east, s = [place speed lean rate wind]: a Kalman filter of fifth
/// order, in SI units and rad, one period dt on with h = dt^2 / 2:
///   s' = F s + [a h, a dt, t h, t dt, 0],   P' = F P F^T + Q dt
///       | 1  dt           lift h           0               0            |
///       | 0  1 - c dt     lift dt          lift h          c dt         |   c = spin drag, m = spin damping,
///   F = | 0  0            1 - k h          dt - m h        n h          |   n = spin hub
///       | 0  -n dt        -k dt            1 - m dt        n dt         |
///       | 0  0            0                0               1 - dt / gust_time |
///   Q = diag(0, force_noise^2, 0, torque_noise^2, 2 gusts^2 / gust_time); where a foot may stand, that of the ground
/// (a, m/s^2: drag in the mean wind, as last felt, times spin; t, rad/s^2: what the demand turns it by, and what turned
/// it besides, as last felt, times spin; lift: specific force, m/s^2; k, 1/s^2: by which the ground effect rights it;
/// spin: speed of the rotors, the root of the thrust felt by its mean when the IMU was lost). A place z that a laser
/// measures by a ray that leans with the vehicle, `taken` being the lean that z was taken with, off = lean - taken:
///   H = [1 0 -slope' 0 0],   slope' = slope + range off,   z' = z + (slope + range off / 2) off + bend / 2
///   bend = range P_33 (the second-order term),   S = H P H^T + range_noise^2 + (yaw_noise skew)^2 + bend^2 / 2
///   K = P H^T / S,   s += K (z' - place),   P -= K H P,   weight *= e^(-(z' - place)^2 / 2S) / sqrt(S)
/// A lean z that sonars measure, of `age` ago:
///   H = [0 0 1 -age 0],   S = H P H^T + noise^2,   K, s, P and weight as above, by z - (lean - age rate)
struct LeanGuess {
  double weight = 0;
  double place = 0, speed = 0, lean = 0, rate = 0, wind = 0;
  std::array<double, 25> covariance{};

  static constexpr auto fields() {
    using G = LeanGuess;
    return describe(field<&G::weight>("", "probability that it is the right one"), field<&G::place>("m"),
                    field<&G::speed>("m/s"), field<&G::lean>("rad", "towards the axis"), field<&G::rate>("rad/s"),
                    field<&G::wind>("m/s", "along the axis, more than its mean"),
                    field<&G::covariance>("", "of these five in SI units, row by row"));
  }
};

struct LeanAxis {
  std::array<LeanGuess, 5> guesses{};
  LeanGuess mean{};
  double drag = 0, torque = 0, since = 0;

  static constexpr auto fields() {
    using A = LeanAxis;
    return describe(field<&A::guesses>(), field<&A::mean>("", "of all guesses"),
                    field<&A::drag>("m/s^2", "and wind, as last felt"),
                    field<&A::torque>("rad/s^2", "of wind and all else, as last felt"),
                    field<&A::since>("s", "a laser saw its place"));
  }
};

/// What is known when the IMU falls silent: standard deviations of what it knew, and the winds that are guessed.
struct BlindStart {
  double place = 0.003;
  double speed = 0.03;
  double lean = 0.01;
  double rate = 0.05;
  double wind_apart = 1.2;
  double wind_width = 0.8;

  static constexpr auto fields() {
    using B = BlindStart;
    return describe(
        field<&B::place>("m", "standard deviation").in(0, 10), field<&B::speed>("m/s", "standard deviation").in(0, 10),
        field<&B::lean>("rad", "standard deviation").in(0, 1), field<&B::rate>("rad/s", "standard deviation").in(0, 10),
        field<&B::wind_apart>("", "from one guess of the wind to the next, in gusts").in(0, 10),
        field<&B::wind_width>("", "standard deviation of each guess, in gusts").in(0, 10));
  }
};

/// What ranges of sonars differ by from the IMU while it reports: level ground and its trim are two things.
struct SonarLevel {
  SonarRanges last{};
  std::uint32_t repeats = 0;
  bool learnt = false;
  double roll = 0, pitch = 0, since = 1e9;

  static constexpr auto fields() {
    using S = SonarLevel;
    return describe(field<&S::last>("", "that they reported"), field<&S::repeats>("", "of the same ranges"),
                    field<&S::learnt>("", "what follows"),
                    field<&S::roll>("rad", "that they show more than the IMU, averaged"), field<&S::pitch>("rad"),
                    field<&S::since>("s", "they showed how it leans"));
  }
};

/// While the IMU reports, the observer begins anew each period with what is known then. Without it, it turns by what
/// the rotors are sent and is corrected by the lasers: it is pushed where it leans, so lean, rate and wind follow from
/// places alone. A ray that looks down is longer for a lean towards its wall, as if it had moved away: such a lean
/// shows late, one away from the wall at once. As it is longer for either, several guesses are kept, each a Kalman
/// filter (Gelb, "Applied Optimal Estimation", 1974, section 4.2, with the second-order term of section 6.1 for the
/// ray), whose mean is taken: a Gaussian sum (Alspach and Sorenson 1972). Where each sonar reports its range, they show
/// the lean itself (sonar_tilt.h), less what they showed while the IMU did. Yaw nobody sees: it is that of the model.
struct BlindObserver {
  static constexpr std::string_view summary = "knows roll and pitch by sonars and lasers when the IMU is lost";
  struct Param {
    double effect = 153;
    double damping = 3.9;
    double lag = 0.03;
    double yaw_effect = 12.3;
    double spin_time = 0.53;
    double mean_time = 0.3;
    double range_noise = 0.003;
    double drag = 0.208;
    double inflow = 0.83;
    double hub = 1.04;
    double arm = 0.3;
    double rotor_radius = 0.25;
    double rotor_height = 0.25;
    double gusts = 1;
    double gust_time = 1;
    double force_noise = 0.05;
    double torque_noise = 0.1;
    double ground_force_noise = 0.5;
    double ground_torque_noise = 2.5;
    double yaw_noise = 0.02;
    double turn_limit = 0.1;
    double patience = 0.3;
    double min_thrust = 0.1;
    BlindStart start{};
    TiltBySonars sonars{};
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::effect>("rad/s^2", "angular acceleration of roll and pitch per demand"),
          field<&P::damping>("1/s", "at which the rotors brake roll and pitch"),
          field<&P::lag>("s", "until a demand is felt"),
          field<&P::yaw_effect>("rad/s^2", "angular acceleration of yaw per demand"),
          field<&P::spin_time>("s", "for which the hull turns more as rotors speed up than by their drag"),
          field<&P::mean_time>("s", "over which drag and torque at rest are averaged"),
          field<&P::range_noise>("m", "standard deviation of a place that a laser measures").in(1e-6, 1),
          field<&P::drag>("1/s", "at which the air takes it along"),
          field<&P::inflow>("1/s", "at which rotors brake a climb"),
          field<&P::hub>("rad/(m s)", "at which air that flows past turns it"), field<&P::arm>("m", "of a rotor"),
          field<&P::rotor_radius>("m").in(0.01, 10),
          field<&P::rotor_height>("m", "above the ground, where it stands").in(0.01, 10),
          field<&P::gusts>("m/s", "of the air"), field<&P::gust_time>("s", "of gusts").in(0.02, 1000),
          field<&P::force_noise>("m/s^2/sqrt(Hz)", "density of all else"),
          field<&P::torque_noise>("rad/s^2/sqrt(Hz)", "density of all else"),
          field<&P::ground_force_noise>("m/s^2/sqrt(Hz)", "density of force_noise where a foot may stand"),
          field<&P::ground_torque_noise>("rad/s^2/sqrt(Hz)", "of torque_noise there"),
          field<&P::yaw_noise>("rad", "standard deviation of the yaw, which nobody measures"),
          field<&P::turn_limit>("rad/s", "of yaw when the IMU is lost, beyond which walls are lost, too"),
          field<&P::patience>("s", "without a laser that sees along an axis before its lean is unknown"),
          field<&P::min_thrust>(
              "", "least mean thrust demanded, in parts of that of hover, by which the speed of the rotors is reckoned")
              .in(0.01, 1),
          field<&P::start>("", "what is known when the IMU is lost"), field<&P::sonars>("", "that show how it leans"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    TurnDemand turn{};
    LiftDemand lift{};
    SonarRanges sonars{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::turn>(), field<&In::lift>(),
                      field<&In::sonars>("", "of each, where they are reported"));
    }
  };
  struct State {
    LeanAxis x{}, y{};
    SonarLevel level{};
    TurnDemand felt{}, last{};
    double mean_yaw = 0, p = 0, q = 0, heading = 0, yaw = 0, yaw_rate = 0;
    bool turns = false, is_blind = false;
    double mean_thrust = 1, last_thrust = 1, felt_thrust = 1, lift = gravity;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::x>(), field<&S::y>(), field<&S::level>(), field<&S::felt>("", "demand, by now"),
                      field<&S::last>("", "demand, of the period before"), field<&S::mean_yaw>("", "demand"),
                      field<&S::p>("rad/s", "as last felt"), field<&S::q>("rad/s"),
                      field<&S::heading>("rad", "from north"), field<&S::yaw>("rad"), field<&S::yaw_rate>("rad/s"),
                      field<&S::turns>("", "round, too fast to know where the lasers look"), field<&S::is_blind>(),
                      field<&S::mean_thrust>("", "demand"), field<&S::last_thrust>("", "of the period before"),
                      field<&S::felt_thrust>("", "by now"), field<&S::lift>("m/s^2", "felt, averaged"));
    }
  };
  struct Out {
    BlindMotion motion{};
    static constexpr auto fields() { return describe(field<&Out::motion>("", "at the next period")); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
