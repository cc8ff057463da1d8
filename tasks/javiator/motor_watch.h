// The helicopter's motors when one of them gives less thrust than is demanded: what finds it, by how it turns.
#pragma once

#include <array>
#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/rotor_law.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// What a motor lacks turns the vehicle: towards it, and about one axis alone, as wind seldom does. How fast it should
/// turn follows from what the rotors are sent and their lag; a first-order observer of the rates shows by how much it
/// turns faster (a momentum observer, De Luca and Mattone 2003, of one body). Which signals had acted when the IMU was
/// sampled the answers show, however long they took. Signals that nobody has answered were perhaps heard, perhaps not:
/// both are followed, and what lies between is doubted. A motor that lacks more than `allowance` for two or three
/// periods is weak, until it stands and the operator has acknowledged that; how weak is followed from then on.
/// A landing whose altitude nothing confirms finds none: it may stand already, and the ground turns it.
struct MotorWatch {
  static constexpr std::string_view summary = "finds a motor that gives less thrust than is demanded";
  struct Param {
    double effect = 153;
    double damping = 3.9;
    double bandwidth = 120;
    double allowance = 0.2;
    double evidence = 0.004;
    double wind = 0.1;
    double wind_time = 0.5;
    double follow = 20;
    double contact = 0.1;
    double low = 0.06;
    double hover = 8000;
    double exponent = 1.415;
    double voltage = 15.887;
    double lag = 0.05;
    double sample_time = 0.005;
    double of_one_sample = 0.9;
    double min_thrust = 0.1;
    double min_effectiveness = 0.1;
    BatteryScale battery{};
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::effect>("rad/s^2", "angular acceleration of roll and pitch per demand, as AttitudeControl has it")
              .in(1e-3, 1e6),
          field<&P::damping>("1/s", "at which the rotors brake roll and pitch"),
          field<&P::bandwidth>("rad/s", "of the observer of the rates"),
          field<&P::allowance>("", "thrust of hover that a sound motor may seem to lack, in gusts").in(0, 1),
          field<&P::evidence>("s", "thrust of hover times seconds that it may seem to lack beyond that, at once")
              .in(0, 10),
          field<&P::wind>("", "thrust of hover that it may seem to lack for long, in wind").in(0, 1),
          field<&P::wind_time>("s", "in which that is learnt").in(1e-3, 1000),
          field<&P::follow>("1/s", "at which what a weak one gives is followed"),
          field<&P::contact>("m", "altitude below which the ground may turn it as well"),
          field<&P::low>("m", "of the sonar, down to which one that fails as it lands is found all the same"),
          field<&P::hover>("", "signal that hovers, as MotorMixer has it").in(1, max_motor_signal),
          field<&P::exponent>("", "thrust grows with the signal to this power").in(0.1, 10),
          field<&P::voltage>("V", "of the battery at which it does"), field<&P::lag>("s", "of the rotors").in(1e-3, 10),
          field<&P::sample_time>("s", "from when signals act until the IMU is sampled").in(0, 1),
          field<&P::of_one_sample>("", "of evidence that one sample may add, as signals that were held up act late")
              .in(0, 1),
          field<&P::min_thrust>(
              "", "least mean thrust, in parts of that of hover, that the lack of a weak motor is divided by")
              .in(0.01, 1),
          field<&P::min_effectiveness>("", "of its thrust that a weak motor is taken to give, at least").in(0.01, 1),
          field<&P::battery>("", "how much signal makes up for another one, as MotorMixer has it"));
    }
  };
  struct In {
    JaviatorSensors sensors{};
    FlightEstimate estimate{};
    FlightDirective directive{};
    MotorCommand motors{};
    static constexpr auto fields() {
      return describe(field<&In::sensors>(), field<&In::estimate>(), field<&In::directive>(),
                      field<&In::motors>("", "of this period"));
    }
  };
  /// A command that was sent.
  struct Sent {
    MotorCommand motors{};
    bool heard = false;
    static constexpr auto fields() {
      return describe(field<&Sent::motors>(), field<&Sent::heard>("", "it was answered"));
    }
  };
  /// The rotors, if signals that were not answered were heard, or were not.
  struct Rotors {
    std::array<double, 4> signals{}, reached{}, now{};
    bool operator==(const Rotors&) const = default;
    static constexpr auto fields() {
      using R = Rotors;
      return describe(field<&R::signals>("", "that they follow"), field<&R::reached>("", "signals followed so far"),
                      field<&R::now>("", "thrusts of hover, by these"));
    }
  };
  static constexpr std::uint32_t kept = 32;  // periods, half a second: longer gaps begin anew
  struct State {
    std::array<Sent, kept> sent{};
    std::array<Rotors, 2> rotors{};
    std::uint32_t acted = 0;
    double p = 0, q = 0;
    bool follows = false;
    double wind_roll = 0, wind_pitch = 0, doubt = 0;
    std::array<double, 4> evidence{};
    std::uint32_t answers = 0, answered = 0;
    MotorCondition motors{};
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::sent>("", "at its number modulo their count"),
                      field<&S::rotors>("", "all heard; only those answered"),
                      field<&S::acted>("", "number of the signals that the rotors got last, before the newest sample"),
                      field<&S::p>("rad/s", "expected"), field<&S::q>("rad/s", "expected"),
                      field<&S::follows>("", "these are those of the sample before"),
                      field<&S::wind_roll>("", "thrust that seems to be lacking for long"), field<&S::wind_pitch>(),
                      field<&S::doubt>("", "thrust that was expected perhaps wrongly"),
                      field<&S::evidence>("s", "that each motor is weak"),
                      field<&S::answers>("", "of the Robostix, up to now"),
                      field<&S::answered>("", "number of the signals answered last"), field<&S::motors>());
    }
  };
  struct Out {
    MotorCondition motors{};
    static constexpr auto fields() { return describe(field<&Out::motors>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
