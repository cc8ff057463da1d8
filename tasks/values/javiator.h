// Values that the helicopter's tasks exchange. Earth frame: north, east of the start, and altitude above where it
// stood; body frame forward-right-down; SI units, radians. Roll to the right, pitch nose up, yaw clockwise are
// positive.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"
#include "tasks/values/robostix.h"

namespace jarol::tasks {

/// What the operator wants. Switches, stores and the like count how often a key was pressed since the start.
struct PilotCommand {
  double roll = 0, pitch = 0, yaw = 0, altitude = 0, x = 0, y = 0;
  std::uint32_t state_switches = 0, mode_switches = 0, shut_downs = 0;
  std::uint32_t trim_stores = 0, trim_clears = 0;
  double kept_trim_roll = 0, kept_trim_pitch = 0;
  bool heard = true;

  static constexpr auto fields() {
    using C = PilotCommand;
    return describe(field<&C::roll>("rad", "by hand"), field<&C::pitch>("rad", "by hand"),
                    field<&C::yaw>("rad", "from the take-off heading"), field<&C::altitude>("m", "above the start"),
                    field<&C::x>("m", "north of the start, when position is held"),
                    field<&C::y>("m", "east of the start, when position is held"),
                    field<&C::state_switches>("", "unlock, take off, land and so on in turn"),
                    field<&C::mode_switches>("", "odd: position is held, even: by hand"),
                    field<&C::shut_downs>("", "each stops the motors at once"),
                    field<&C::trim_stores>("", "each makes roll and pitch of that moment the level"),
                    field<&C::trim_clears>("", "each makes the level what the sensors say"),
                    field<&C::kept_trim_roll>("rad", "level at the start, of the flight before"),
                    field<&C::kept_trim_pitch>("rad"), field<&C::heard>("", "the operator is still there"));
  }
};

enum class Motor : std::uint8_t { none, front, right, rear, left };

constexpr auto enumerators(Motor) {
  return std::array<Enumerator<Motor>, 5>{{{"none", Motor::none},
                                           {"front", Motor::front},
                                           {"right", Motor::right},
                                           {"rear", Motor::rear},
                                           {"left", Motor::left}}};
}

/// Whether a motor gives less thrust than is demanded.
struct MotorCondition {
  Motor weak = Motor::none;
  std::array<double, 4> effectiveness{1, 1, 1, 1};

  static constexpr auto fields() {
    return describe(
        field<&MotorCondition::weak>(),
        field<&MotorCondition::effectiveness>("", "part of its thrust that each motor gives, 0.1 at least").in(0.1, 1));
  }
};

enum class FlightState : std::uint8_t { halt, ground, starting, flying, landing };

constexpr auto enumerators(FlightState) {
  return std::array<Enumerator<FlightState>, 5>{{{"halt", FlightState::halt},
                                                 {"ground", FlightState::ground},
                                                 {"starting", FlightState::starting},
                                                 {"flying", FlightState::flying},
                                                 {"landing", FlightState::landing}}};
}

/// Why the vehicle lands or stops without a command to.
enum class LandingCause : std::uint8_t {
  none,
  roll,
  pitch,
  yaw,
  altitude,
  operator_lost,
  sonar_lost,
  position_lost,
  imu_lost,
  bmu_lost,
  battery_low,
  answers_late,
  motor_weak,
  no_lift
};

constexpr auto enumerators(LandingCause) {
  return std::array<Enumerator<LandingCause>, 14>{
      {{"none", LandingCause::none},
       {"roll", LandingCause::roll, "its roll is beyond the limit"},
       {"pitch", LandingCause::pitch, "its pitch is beyond the limit"},
       {"yaw", LandingCause::yaw, "its yaw is beyond the limit"},
       {"altitude", LandingCause::altitude, "its altitude is beyond the limit"},
       {"operator_lost", LandingCause::operator_lost, "the operator is silent"},
       {"sonar_lost", LandingCause::sonar_lost, "the sonar reports nothing credible"},
       {"position_lost", LandingCause::position_lost, "its lasers do not show where it is"},
       {"imu_lost", LandingCause::imu_lost, "the IMU reports nothing credible"},
       {"bmu_lost", LandingCause::bmu_lost, "the BMU reports nothing credible"},
       {"battery_low", LandingCause::battery_low, "the battery's voltage is below the limit"},
       {"answers_late", LandingCause::answers_late, "the Robostix does not answer in time"},
       {"motor_weak", LandingCause::motor_weak, "a motor gives less thrust than is demanded"},
       {"no_lift", LandingCause::no_lift, "it does not rise at full thrust"}}};
}

/// What the operator is sent.
struct HelicopterReport {
  double roll = 0, pitch = 0, yaw = 0, altitude = 0, x = 0, y = 0, battery = 0;
  FlightState state = FlightState::halt;
  LandingCause cause = LandingCause::none;
  double p = 0, q = 0, r = 0;
  double v_x = 0, v_y = 0, climb = 0;
  double a_x = 0, a_y = 0, a_up = 0;
  double roll_goal = 0, pitch_goal = 0;
  std::array<double, 4> signals{};
  double pressure = 0, temperature = 0;
  double trim_roll = 0, trim_pitch = 0;

  static constexpr auto fields() {
    using R = HelicopterReport;
    return describe(field<&R::roll>("rad"), field<&R::pitch>("rad"), field<&R::yaw>("rad", "from the take-off heading"),
                    field<&R::altitude>("m", "above the start"), field<&R::x>("m", "north of the start"),
                    field<&R::y>("m", "east of the start"), field<&R::battery>("V", "voltage"), field<&R::state>(),
                    field<&R::cause>("", "of a landing that nobody wanted"),
                    field<&R::p>("rad/s", "rate about the body's x"), field<&R::q>("rad/s", "about y"),
                    field<&R::r>("rad/s", "about z"), field<&R::v_x>("m/s", "to the north"),
                    field<&R::v_y>("m/s", "to the east"), field<&R::climb>("m/s", "upwards"),
                    field<&R::a_x>("m/s^2", "to the north"), field<&R::a_y>("m/s^2", "to the east"),
                    field<&R::a_up>("m/s^2", "upwards"), field<&R::roll_goal>("rad", "turned by the yaw"),
                    field<&R::pitch_goal>("rad"), field<&R::signals>("", "of the motors, 0 to 16000"),
                    field<&R::pressure>("Pa", "of the air"), field<&R::temperature>("degC", "of the air"),
                    field<&R::trim_roll>("rad", "that counts as level"), field<&R::trim_pitch>("rad"));
  }
};

/// A place along one axis, as a laser has last measured it.
struct PlaceFix {
  double place = 0, slope = 0, skew = 0, range = 0;
  bool is_new = false;

  static constexpr auto fields() {
    using F = PlaceFix;
    return describe(field<&F::place>("m"),
                    field<&F::slope>("m/rad", "by which it grows with the lean along that axis that is taken for true"),
                    field<&F::skew>("m/rad", "by which it does with the yaw"),
                    field<&F::range>("m", "to the wall, along the axis"), field<&F::is_new>("", "of this period"));
  }
};

/// How the vehicle moves, as far as its sensors report.
struct FlightEstimate {
  double roll = 0, pitch = 0, yaw = 0, heading = 0;
  double p = 0, q = 0, r = 0;
  double x = 0, y = 0, altitude = 0;
  double v_x = 0, v_y = 0, climb = 0;
  double a_x = 0, a_y = 0, a_up = 0;
  double lift = 0, drag_x = 0, drag_y = 0;
  double battery = 0, rates_age = 0;
  std::array<PlaceFix, 2> fixes{};
  bool rates_known = false, attitude_known = false, lean_known = false, tilt_known = false;
  bool touches = false;
  bool altitude_known = false, altitude_confirmed = false, position_known = false;
  bool pressure_known = false, answers_known = false;

  static constexpr auto fields() {
    using E = FlightEstimate;
    return describe(
        field<&E::roll>("rad"), field<&E::pitch>("rad"), field<&E::yaw>("rad", "from the take-off heading"),
        field<&E::heading>("rad", "from north"), field<&E::p>("rad/s", "rate about the body's x"),
        field<&E::q>("rad/s", "about y"), field<&E::r>("rad/s", "about z"), field<&E::x>("m", "north of the start"),
        field<&E::y>("m", "east of the start"), field<&E::altitude>("m", "above the start"),
        field<&E::v_x>("m/s", "to the north"), field<&E::v_y>("m/s", "to the east"), field<&E::climb>("m/s", "upwards"),
        field<&E::a_x>("m/s^2", "to the north"), field<&E::a_y>("m/s^2", "to the east"),
        field<&E::a_up>("m/s^2", "upwards"), field<&E::lift>("m/s^2", "specific force upwards along the rotors' axis"),
        field<&E::drag_x>("m/s^2", "to the north, of all else: drag and wind"),
        field<&E::drag_y>("m/s^2", "to the east"), field<&E::battery>("V", "voltage"),
        field<&E::rates_age>("s", "since the IMU has reported something new"),
        field<&E::fixes>("", "north and east of the start"),
        field<&E::rates_known>("", "the IMU reports something new"),
        field<&E::attitude_known>("", "and its angles agree with its rates"),
        field<&E::lean_known>("", "sonars or lasers show roll and pitch in its place"),
        field<&E::tilt_known>("", "sonars do, on the ground as well"),
        field<&E::touches>("", "so low and leaning so, by the sonars, that a foot may stand"),
        field<&E::altitude_known>("", "the sonar reports something credible"),
        field<&E::altitude_confirmed>("", "and the pressure agrees"),
        field<&E::position_known>("", "the lasers show it, or did of late"),
        field<&E::pressure_known>("", "the BMU does"), field<&E::answers_known>("", "the Robostix answers in time"));
  }
};

/// What is to be done now.
struct FlightDirective {
  FlightState state = FlightState::halt;
  LandingCause cause = LandingCause::none;
  bool hold_position = false, stands = false;
  double roll = 0, pitch = 0, yaw = 0, altitude = 0, x = 0, y = 0;
  double trim_roll = 0, trim_pitch = 0;

  static constexpr auto fields() {
    using D = FlightDirective;
    return describe(field<&D::state>(), field<&D::cause>("", "of a landing that nobody wanted"),
                    field<&D::hold_position>("", "else roll and pitch by hand"),
                    field<&D::stands>("", "on the ground, where it only levels"), field<&D::roll>("rad"),
                    field<&D::pitch>("rad"), field<&D::yaw>("rad", "from the take-off heading"),
                    field<&D::altitude>("m", "above the start"), field<&D::x>("m", "north of the start"),
                    field<&D::y>("m", "east of the start"), field<&D::trim_roll>("rad", "that counts as level"),
                    field<&D::trim_pitch>("rad"));
  }
};

struct AttitudeGoal {
  double roll = 0, pitch = 0, yaw = 0;

  static constexpr auto fields() {
    using A = AttitudeGoal;
    return describe(field<&A::roll>("rad"), field<&A::pitch>("rad"),
                    field<&A::yaw>("rad", "from the take-off heading"));
  }
};

/// Demands on the rotors in parts of the thrust of hover: what is added on one side and taken on the other.
struct TurnDemand {
  double roll = 0, pitch = 0, yaw = 0;

  static constexpr auto fields() {
    using T = TurnDemand;
    return describe(field<&T::roll>("", "to the right"), field<&T::pitch>("", "nose up"),
                    field<&T::yaw>("", "clockwise"));
  }
};

/// How it moves, as sonars, lasers and what the rotors are sent say, without the IMU.
struct BlindMotion {
  double roll = 0, pitch = 0, yaw = 0;
  double p = 0, q = 0, r = 0;
  double x = 0, y = 0, v_x = 0, v_y = 0;
  double drag_x = 0, drag_y = 0, lift = 0;
  bool known = false, tilt_known = false, turns = false;

  static constexpr auto fields() {
    using M = BlindMotion;
    return describe(
        field<&M::roll>("rad"), field<&M::pitch>("rad"),
        field<&M::yaw>("rad", "from the take-off heading, that of a model"),
        field<&M::p>("rad/s", "rate about the body's x"), field<&M::q>("rad/s", "about y"),
        field<&M::r>("rad/s", "about z"), field<&M::x>("m", "north of the start"),
        field<&M::y>("m", "east of the start"), field<&M::v_x>("m/s", "to the north"),
        field<&M::v_y>("m/s", "to the east"), field<&M::drag_x>("m/s^2", "to the north, as felt before: drag and wind"),
        field<&M::drag_y>("m/s^2", "to the east"),
        field<&M::lift>("m/s^2", "specific force upwards along the rotors' axis"),
        field<&M::known>("", "by sonars of late, or by lasers while it does not turn round"),
        field<&M::tilt_known>("", "by sonars"), field<&M::turns>("", "round: where lasers look is not known"));
  }
};

/// Thrust of all rotors, 1 at hover.
struct LiftDemand {
  double thrust = 0;
  bool stands = false;

  static constexpr auto fields() {
    return describe(field<&LiftDemand::thrust>("", "1 at hover"),
                    field<&LiftDemand::stands>("", "on the ground, which it is not to leave now"));
  }
};

}  // namespace jarol::tasks
