// The submarine's fins when one of them fails: what finds it, and what steers with the other three. And its propeller.
#pragma once

#include <array>
#include <string_view>

#include "graph/math/geometry.h"
#include "graph/task.h"
#include "tasks/values/fins.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// A sound servo is between where it is sent and where one that turns at `servo_rate` would be by now. One that is
/// further out by more than `error` is wrong; wrong for `error_time` longer than it was right, it is stuck, until the
/// operator demands a stop: then it is tried anew. A servo that is fitted is silent if it reports no more, or nothing
/// since another did; of a vehicle that reports none no fin is checked. A propeller is stuck that turns by more than
/// `propeller_error` of its full speed otherwise than it is sent, now or at the reading before, for `propeller_time`:
/// longer than the supervisor takes to find that its speed is reported wrong.
struct FinWatch {
  static constexpr std::string_view summary = "finds fins and a propeller that do not do what they are sent";
  struct Param {
    double error = 3 * degree;
    double error_time = 0.3;
    double servo_rate = 200 * degree;
    double silence = 2.5;
    double full_speed = 2500;
    double propeller_error = 0.35;
    double propeller_time = 8;
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::error>("rad", "greatest difference of a servo and what its rate explains").in(0, max_fin_angle),
          field<&P::error_time>("s", "how long a greater one has to last").in(0, 60),
          field<&P::servo_rate>("rad/s", "at which a sound servo turns at least").in(0.1, 100),
          field<&P::silence>("s", "a servo that is fitted and reports nothing for so long is silent").in(0, 3600),
          field<&P::full_speed>("rpm", "of the propeller, at full thrust").in(1, 100000),
          field<&P::propeller_error>("", "part of that by which it may differ from what it is sent").in(0, 2),
          field<&P::propeller_time>("s", "how long it has to differ by more").in(0, 3600));
    }
  };
  struct In {
    Servos servos{};
    Contact contact{};
    static constexpr auto fields() { return describe(field<&In::servos>(), field<&In::contact>()); }
  };
  struct State {
    std::array<std::int64_t, 4> counts{};
    std::array<double, 4> silences{};
    std::array<double, 4> expected{};
    std::array<double, 4> wrong_for{};
    std::int64_t propeller_count = 0;
    double propeller_silence = 0;
    double propeller_wrong_for = 0;
    double propeller_commanded = 0;
    FinCondition fins{};
    std::uint32_t stops = 0;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::counts>("", "readings of each servo"), field<&S::silences>("s", "of each servo"),
                      field<&S::expected>("rad", "where one would be that turns at the least rate"),
                      field<&S::wrong_for>("s", "less what it was right since"),
                      field<&S::propeller_count>("", "readings of its speed"),
                      field<&S::propeller_silence>("s", "since the last one"),
                      field<&S::propeller_wrong_for>("s", "less what it was right since"),
                      field<&S::propeller_commanded>("", "by the reading before"), field<&S::fins>(),
                      field<&S::stops>("", "of the operator, up to now"));
    }
  };
  struct Out {
    FinCondition fins{};
    static constexpr auto fields() { return describe(field<&Out::fins>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

/// As FinAllocator while no fin is stuck. The other fin of a stuck one's pair takes over its part of the demand, and
/// undoes what it does where it stands; the other pair takes out the roll that this makes, as far as its own demand
/// leaves room. A stuck fin is sent to where it is: one whose servo only measures wrong then stays there, too. Where
/// both of a pair are stuck, both are sent their demand, which steers if only what servos report is wrong.
struct FaultTolerantAllocator {
  static constexpr std::string_view summary = "as FinAllocator, and without a fin that is stuck";
  struct Param {
    double limit = 25 * degree;
    static constexpr auto fields() {
      return describe(
          field<&Param::limit>("rad", "greatest fin angle that gives more lift than less does").in(0, max_fin_angle));
    }
  };
  struct In {
    Moment pitch{};
    Moment yaw{};
    Thrust thrust{};
    FinCondition fins{};
    static constexpr auto fields() {
      return describe(field<&In::pitch>(), field<&In::yaw>(), field<&In::thrust>(), field<&In::fins>());
    }
  };
  struct Out {
    Actuation actuation{};
    static constexpr auto fields() { return describe(field<&Out::actuation>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out);
};

}  // namespace jarol::tasks
