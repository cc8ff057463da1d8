// What the helicopter does next: starting, flying, landing, and when it lands of its own accord.
#pragma once

#include <numbers>
#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/trim.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// Where walls were seen along an axis, ahead and behind; nowhere near before.
struct Walls {
  double ahead = 1e9, behind = -1e9;

  static constexpr auto fields() { return describe(field<&Walls::ahead>("m"), field<&Walls::behind>("m")); }
};

/// When it flies to another place, and how near to walls that its lasers see.
struct WayLimits {
  double far = 0.5;
  double fast = 1;
  double wall_margin = 1.5;
  double stop_time = 0.5;

  static constexpr auto fields() {
    using W = WayLimits;
    return describe(
        field<&W::far>("m", "from the place, beyond which it is on its way there"),
        field<&W::fast>("m/s", "to the side, beyond which it is on its way"),
        field<&W::wall_margin>("m",
                               "from a wall to the places that it flies to: half of its span, and what it overshoots"),
        field<&W::stop_time>("s", "in which it comes to rest where it is to stay, by its speed").in(0, 100));
  }
};

/// When a landing begins in a turn, which ends along the walls that its lasers can see.
struct LandingTurn {
  double rate = 0.3;
  double stop_time = 0.3;

  static constexpr auto fields() {
    using T = LandingTurn;
    return describe(field<&T::rate>("rad/s", "of yaw, from which on it turns"),
                    field<&T::stop_time>("s", "in which such a turn comes to rest, by that rate"));
  }
};

struct FlightLogic {
  static constexpr std::string_view summary = "decides when the helicopter starts, flies and lands";
  struct Param {
    double spin_up = 1.5;
    double roll_limit = 0.6;
    double pitch_limit = 0.6;
    double yaw_limit = 4;
    double altitude_limit = 2.8;
    double battery_limit = 13.4;
    double patience = 0.525;
    double answers_patience = 2.5;
    double still = 0.08;
    double light = 0.6;
    double carried = 0.8;
    double level = 0.07;
    double touch_time = 0.3;
    double doubt_time = 1.5;
    double high_time = 5;
    double out_of_control = 0.8;
    double out_of_control_time = 0.1;
    double overturned = 1;
    double tips_below = 0.2;
    double full = 1.4;
    double lift_patience = 1.5;
    double too_low = 0.1;
    double no_climb = 0.05;
    double least_time = 1;
    double long_silence = 0.3;
    double high = 0.5;
    double low = 0.3;
    double on_ground = 0.02;
    double max_trim = default_max_trim;
    WayLimits way{};
    LandingTurn turning{};
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::spin_up>("s", "for the rotors to reach idle"),
          field<&P::roll_limit>("rad", "beyond which it lands"), field<&P::pitch_limit>("rad", "beyond which it lands"),
          field<&P::yaw_limit>("rad",
                               "from the take-off heading, the short way, beyond which it lands; none at pi and more"),
          field<&P::altitude_limit>("m", "beyond which it lands"),
          field<&P::battery_limit>("V", "below which it lands"),
          field<&P::patience>("s", "without the operator, before it lands"),
          field<&P::answers_patience>(
              "s",
              "without an answer of the Robostix, or without being run, after which the motors "
              "are locked: less than until its `safe`, or they start again with what comes then"),
          field<&P::still>("m/s", "rate of descent below which it may have touched down"),
          field<&P::light>("", "thrust below which the ground must carry"),
          field<&P::carried>("", "thrust above which it may hover where it is still").in(0, 10),
          field<&P::level>("rad", "of lean, beyond which it may stand on one foot").in(0, std::numbers::pi),
          field<&P::touch_time>("s", "for which it is still or light when it has touched down").in(0.001, 100),
          field<&P::doubt_time>("s", "the same, where it may hover or stand on one foot").in(0.01, 100),
          field<&P::high_time>(
              "s",
              "the same, where it measures that it is above `high`, or by its sonars that no foot stands, "
              "unless it is both still and light: then doubt_time")
              .in(0.01, 100),
          field<&P::out_of_control>("rad",
                                    "of lean that the IMU shows, beyond which a landing ends with the motors locked")
              .in(0, std::numbers::pi),
          field<&P::out_of_control_time>("s", "of that"),
          field<&P::overturned>("rad", "of lean that is known without an IMU, likewise, for touch_time")
              .in(0, std::numbers::pi),
          field<&P::tips_below>("m",
                                "altitude below which a lean beyond its limit locks the motors: it tips over; and "
                                "below which it has come down while the Robostix was silent"),
          field<&P::full>("", "thrust that lifts whatever it may carry"),
          field<&P::lift_patience>("s", "for which that does not lift it, before it lands"),
          field<&P::too_low>("m", "below the altitude commanded: it is not lifted"),
          field<&P::no_climb>("m/s", "climb below which it is not"),
          field<&P::least_time>("s", "of a landing, before it can be over"),
          field<&P::long_silence>("s", "of the Robostix, after which nobody knows whether it flies"),
          field<&P::high>("m", "altitude from which on it touches nothing, if that is measured; still below it, it has")
              .in(0, 0.5),
          field<&P::low>("m", "altitude below which a lean brings feet near the ground, and there is no time to turn"),
          field<&P::on_ground>("m", "altitude commanded up to which it is sent to the ground"),
          field<&P::max_trim>("rad", "lean, to either side, that may be stored as level").in(0, std::numbers::pi / 2),
          field<&P::way>("", "to another place"), field<&P::turning>("", "a landing that begins in a turn"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    PilotCommand command{};
    LiftDemand lift{};
    MotorCondition motors{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::command>(),
                      field<&In::lift>("", "little of it while landing: the ground carries"), field<&In::motors>(),
                      field<&In::gains>("", "of other laws: not looked at"));
    }
  };
  struct State {
    double since = 0, unheard = 0, unanswered = 0, still = 0, lies_over = 0, without_lift = 0;
    bool settles = false;
    Walls walls_x{}, walls_y{};
    std::int64_t before = -1;
    std::uint32_t state_switches = 0, shut_downs = 0;
    TrimKeys trim{};
    static constexpr auto fields() {
      using S = State;
      return describe(
          field<&S::since>("s", "the state began"), field<&S::unheard>("s", "the operator was heard"),
          field<&S::unanswered>("s", "the Robostix answered in time, and that was looked at"),
          field<&S::still>("s",
                           "it has been still or light, counted slower where it may hover, stand on one foot or fly"),
          field<&S::lies_over>("s", "it has leant like one that has overturned"),
          field<&S::without_lift>("s", "it has not risen at full thrust"),
          field<&S::settles>("", "where it is, as it is to go to the ground"),
          field<&S::walls_x>("", "of the room, which it keeps away from"), field<&S::walls_y>(),
          field<&S::before>("", "activation that ran last"),
          field<&S::state_switches>("", "of the operator, up to now"), field<&S::shut_downs>("", "likewise"),
          field<&S::trim>("", "likewise"));
    }
  };
  struct Out {
    FlightDirective directive{};
    static constexpr auto fields() { return describe(field<&Out::directive>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
