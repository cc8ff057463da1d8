// From the helicopter's raw sensors to how it moves, and which of them can be believed.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/foot_stand.h"
#include "tasks/javiator/observers.h"
#include "tasks/javiator/room.h"
#include "tasks/javiator/sensor_trust.h"
#include "tasks/javiator/sonar_tilt.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// What drifts is found by what is felt: beside the sonar's climb and the IMU's angles others are kept that hardly
/// trust them, but the accelerometer and the rates.
struct DriftLimits {
  double climb_bandwidth = 0.8;
  double climb = 0.025;
  double climb_time = 0.5;
  double climb_memory = 10;
  double angle_bandwidth = 0.25;
  double angle = 0.015;
  double pull = 0.02;
  double pull_time = 1.5;
  double new_part = 0.05;
  double doubt = 0.25;
  RestLearning rest{};

  static constexpr auto fields() {
    using D = DriftLimits;
    return describe(
        field<&D::climb_bandwidth>("rad/s", "at which the sonar corrects the climb that is felt"),
        field<&D::climb>("m/s", "between it and the sonar's at which the sonar drifts, not the pressure"),
        field<&D::climb_time>("s", "over which that is averaged"),
        field<&D::climb_memory>("s", "in which it is forgotten"),
        field<&D::angle_bandwidth>("rad/s", "at which angles correct those that the rates turn"),
        field<&D::angle>("rad", "between them at which the angles are not credible, if the place is as well"),
        field<&D::pull>("rad", "of an angle that sideways acceleration without a cause shows"),
        field<&D::pull_time>("s", "over which that is averaged"),
        field<&D::new_part>("", "of a new difference between sensors in its average").in(0, 1),
        field<&D::doubt>("m", "of that of sonar and pressure from which on the altitude is not confirmed"),
        field<&D::rest>("", "what is learnt of sensors where it stands"));
  }
};

/// How the altitude follows the pressure, by what the two differ by at a reading.
struct ByPressure {
  double place = 0.05;
  double speed = 0.02;

  static constexpr auto fields() {
    using B = ByPressure;
    return describe(field<&B::place>("", "part of it that altitude takes"),
                    field<&B::speed>("1/s", "times it is what the climb takes"));
  }
};

/// What it knows of its place where its lasers show nothing of one axis, as at headings about the diagonals of a room.
struct UnseenPlace {
  double patience = 1.5;
  double max_time = 3;
  double speed = 0.5;

  static constexpr auto fields() {
    using U = UnseenPlace;
    return describe(field<&U::patience>("s", "for which what it feels is as good"),
                    field<&U::max_time>("s", "after which it takes walls for others, and is lost"),
                    field<&U::speed>("m/s", "at which what it feels may go astray meanwhile"));
  }
};

/// Motion that nobody feels while the IMU is not heard, or lost.
struct UnfeltMotion {
  double gap = 0.1;
  double rate = 2;
  double bandwidth = 20;
  SonarPlane plane{};
  double patience = 0.15;
  UnfeltClimb climb{.push = 1.2, .noise = 0.0038};
  FootStand stand{};

  static constexpr auto fields() {
    using U = UnfeltMotion;
    return describe(
        field<&U::gap>("s",
                       "without the IMU, more than a few lost packets, from which on it may have turned unforeseen"),
        field<&U::rate>("rad/s", "of that turn"),
        field<&U::bandwidth>("rad/s", "of the observer of altitude where lasers show how it leans, in gusts"),
        field<&U::plane>("", "that four sonars see: where they show how it leans, its altitude is that of the plane"),
        field<&U::patience>("s", "without one, before it is that of the range reported for all of them"),
        field<&U::climb>("", "where sonars do"), field<&U::stand>("", "and where it touches the ground then"));
  }
};

/// What the filter goes on from.
struct Before {
  std::int64_t activation = -1;
  std::uint32_t answers = 0, ranges = 0;
  bool stood = false;

  static constexpr auto fields() {
    using B = Before;
    return describe(field<&B::activation>("", "that ran last"), field<&B::answers>("", "of the Robostix, up to then"),
                    field<&B::ranges>("", "of all four sonars, up to then"), field<&B::stood>());
  }
};

/// Where nothing was heard for long the altitude begins anew, once two ranges of the sonar agree.
struct NewAltitude {
  bool begins = false;
  double first = 0;

  static constexpr auto fields() {
    return describe(field<&NewAltitude::begins>(), field<&NewAltitude::first>("m", "of the two"));
  }
};

/// How old readings are when they are used. An answer has what the IMU sampled at the answer before, and ranges since:
/// over a radio that loses or holds up signals the time between them is not known well.
struct ReadingAge {
  double imu = 0.02;
  double range = 0.009;
  double fade = 0.05;
  double spread = 0;
  double noise = 0.03;
  double battery_time = 1;

  static constexpr auto fields() {
    using A = ReadingAge;
    return describe(
        field<&A::imu>("s", "of the attitude when it is used; it is turned on by the rates"),
        field<&A::range>("s", "the same, when a range is measured: later than the IMU's sample, by so much on average"),
        field<&A::fade>("s", "in which rates and forces of the last reading fade to a third until the next one"),
        field<&A::spread>("s",
                          "of the time from the IMU's sample to a range; 0: ranges count alike however fast it turns")
            .in(0, 1),
        field<&A::noise>("m", "of a place, against which what that makes of it is weighed").in(0.001, 10),
        field<&A::battery_time>("s", "over which the battery's voltage is averaged").in(0.1, 1000));
  }
};

/// In SI units and rad, with R_nb the rotation by roll, pitch, yaw (ZYX) of body axes (forward, right, down) into NED
/// at the place of take-off, f_b the specific force of the accelerometer and omega_b = (p, q, r) of its gyros:
///   angles:     their rates are those of omega_b (rotations.h, euler_rates), and by each credible reading of the IMU
///               angle += angle_gain (measured - angle)
///   motion:     a_n = R_nb f_b + (0, 0, g), which an AxisObserver integrates for north, east and upwards (-a_z)
///   altitude:   z of R_nb (sonar_x, sonar_y, sonar_z + range), from where it stood, corrects the third of them, at
///               bandwidth min(1, noise.usual / RMS of its residuals) while the IMU is heard; where it stands
///               a range counts that is within sonar_jump of the one before, and a laser's place within range_jump
///   place:      find_place (room.h) of each laser's range with the rotation at that time, the first two
///   drift:      a second observer upwards, and a SlowAngle of roll and pitch, hardly corrected (filter_checks.h)
///   blind:      where sonars show how it leans range is the mean of the four that see a plane (sonar_tilt.h), and the
///               one reported only after unfelt.patience without; altitude is tracked (observers.h, UnfeltClimb), and a
///               foot may stand (foot_stand.h)
///   pressure:   h = (mean on the ground - pressure) / pascal_per_metre; without a sonar, e being h - z at a reading,
///               z += by_pressure.place e,   climb += by_pressure.speed e
/// Between readings of the IMU rates and forces fade by e^(-since / fade), rates to 0 and f_b to R_nb^T (0, 0, -g). The
/// estimate is turned on by the age of what is measured: angle + age rate. While the IMU is lost the angles, and place
/// and speed, are BlindObserver's. The JAviator's own filter is in original_filter.h.
struct JaviatorFilter {
  static constexpr std::string_view summary = "estimates attitude, position and velocity from the helicopter's sensors";
  struct Param {
    double sonar_x = 0, sonar_y = 0, sonar_z = 0.055;
    double laser_x_x = -0.070, laser_x_y = 0.075, laser_x_z = 0.080;
    double laser_y_x = 0.050, laser_y_y = -0.077, laser_y_z = 0.080;
    Room room{};
    double bandwidth = 6;
    ReadingNoise noise{};
    ReadingAge age{};
    double angle_gain = 0.5;
    double patience = 0.3;
    double imu_patience = 0.04;
    UnseenPlace unseen{};
    double range_jump = 0.3;
    double sonar_jump = 0.08;
    double sonar_jump_rate = 0.1;
    double angle_jump = 0.1;
    UnfeltMotion unfelt{};
    double pressure_jump = 15;
    double pressure_noise = 6;
    double pascal_per_metre = 12;
    double disagreement = 0.6;
    DriftLimits drift{};
    ByPressure by_pressure{};
    std::uint32_t imu_repeats = 3;
    std::uint32_t laser_repeats = 5;
    std::uint32_t sonar_repeats = 6;
    std::uint32_t repeats = 40;
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::sonar_x>("m", "of the sonar, or the middle of four, forward of the centre of gravity"),
          field<&P::sonar_y>("m", "right"), field<&P::sonar_z>("m", "down"),
          field<&P::laser_x_x>("m", "of the laser that looks forward, forward"), field<&P::laser_x_y>("m", "right"),
          field<&P::laser_x_z>("m", "down"), field<&P::laser_y_x>("m", "of the laser that looks right, forward"),
          field<&P::laser_y_y>("m", "right"), field<&P::laser_y_z>("m", "down"),
          field<&P::room>("", "whose walls the lasers see"),
          field<&P::bandwidth>("rad/s", "of the observers of place and speed"),
          field<&P::noise>("", "of the sonar, where the IMU is heard: the more, the more slowly it is followed"),
          field<&P::age>("", "of readings"),
          field<&P::angle_gain>("", "part of a measured angle in the new one, the rest is the rate's"),
          field<&P::patience>("s", "without a credible measurement before a sensor counts as lost"),
          field<&P::imu_patience>("s", "the same, for the IMU"),
          field<&P::unseen>("", "where no laser sees along an axis"),
          field<&P::range_jump>("m",
                                "from the estimate at which a range is not credible, or a plane that four sonars see"),
          field<&P::sonar_jump>("m", "the same, of the sonar right after a credible range"),
          field<&P::sonar_jump_rate>("m/s", "at which that grows until the next one, up to that of any range"),
          field<&P::angle_jump>("rad", "the same, for roll and pitch"),
          field<&P::unfelt>("", "motion while the IMU is not heard; angle_jump grows by its turn"),
          field<&P::pressure_jump>("Pa", "from one reading to the next, which is not credible").in(0, 1000),
          field<&P::pressure_noise>(
              "", "times the RMS step on the ground that one in flight may have, up to 4 pressure_jump")
              .in(0, 100),
          field<&P::pascal_per_metre>("Pa/m", "by which the pressure falls, upwards").in(1, 100),
          field<&P::disagreement>("m", "between sonar and pressure from which on one of them is not credible"),
          field<&P::drift>("", "of sensors, how it is found"), field<&P::by_pressure>("", "altitude without a sonar"),
          field<&P::imu_repeats>("", "of all its angles and rates at which the IMU counts as stuck; 0: never"),
          field<&P::laser_repeats>("", "the same, for a laser; none that repeats is used"),
          field<&P::sonar_repeats>("", "of its range from which on a sonar is not used; 0: always used"),
          field<&P::repeats>("", "the same, for each other sensor"));
    }
  };
  struct In {
    JaviatorSensors sensors{};
    FlightDirective directive{};
    BlindMotion blind{};
    SonarRanges sonars{};
    static constexpr auto fields() {
      return describe(field<&In::sensors>(), field<&In::directive>("", "of the period before"),
                      field<&In::blind>("", "what it does when the IMU is lost"),
                      field<&In::sonars>("", "of each, where they are reported"));
    }
  };
  struct State {
    AxisObserver x{}, y{}, z{}, z_slow{};
    SlowAngle slow_roll{}, slow_pitch{};
    LastTurn last_turn{};
    SensorTrust imu{}, angles{}, laser_x{}, laser_y{}, sonar{}, pressure{};
    double zero_x = 0, zero_y = 0, zero_z = 0, zero_yaw = 0;
    GroundPressure ground{};
    double roll = 0, pitch = 0, yaw = 0;
    double disagreement = 0, climb_off = 0, climb_was_off = 0, roll_off = 0, pitch_off = 0, unanswered = 0;
    double slant_roll = 0, slant_pitch = 0;
    bool has_flown = false;
    NewAltitude anew{};
    Before before{};
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::x>(), field<&S::y>(), field<&S::z>("", "upwards"),
                      field<&S::z_slow>("", "upwards, the sonar hardly trusted"),
                      field<&S::slow_roll>("", "the angles hardly trusted"), field<&S::slow_pitch>(),
                      field<&S::last_turn>(), field<&S::imu>(), field<&S::angles>(), field<&S::laser_x>(),
                      field<&S::laser_y>(), field<&S::sonar>(), field<&S::pressure>(),
                      field<&S::zero_x>("m", "measured where it stands"), field<&S::zero_y>("m"),
                      field<&S::zero_z>("m"), field<&S::zero_yaw>("rad"), field<&S::ground>(), field<&S::roll>("rad"),
                      field<&S::pitch>("rad"), field<&S::yaw>("rad", "all turns counted"),
                      field<&S::disagreement>("m", "of pressure and altitude, averaged"),
                      field<&S::climb_off>("m/s", "of the sonar's climb and the slow one, averaged"),
                      field<&S::climb_was_off>("m/s", "of late, at most"),
                      field<&S::roll_off>("rad", "by which it is wrong as places report, averaged"),
                      field<&S::pitch_off>("rad"), field<&S::unanswered>("s", "since the Robostix answered"),
                      field<&S::slant_roll>("rad", "of the weight felt while it stands, less the roll, averaged"),
                      field<&S::slant_pitch>("rad"), field<&S::has_flown>(), field<&S::anew>(), field<&S::before>());
    }
  };
  struct Out {
    FlightEstimate estimate{};
    static constexpr auto fields() { return describe(field<&Out::estimate>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
