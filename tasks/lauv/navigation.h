// The submarine's navigation: from what its instruments tell to how it moves.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/values/guidance.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// Complementary filters: rates and velocities carry on what slower instruments set right. With exact instruments the
/// motion is exact but for what a period of the task hides.
struct LauvNavigation {
  static constexpr std::string_view summary = "tells the submarine's motion from its instruments";
  struct Param {
    double angle_time = 0.5;
    double depth_time = 0.7;
    double speed_time = 0.2;
    double place_time = 5;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::angle_time>("s", "after which angles follow IMU and compass rather than rates"),
                      field<&P::depth_time>("s", "after which depth follows the gauge rather than the motion"),
                      field<&P::speed_time>("s", "over which the speed log is smoothed"),
                      field<&P::place_time>("s", "after which the place follows GPS rather than the motion"));
    }
  };
  struct In {
    Instruments instruments{};
    static constexpr auto fields() { return describe(field<&In::instruments>()); }
  };
  struct State {
    bool started = false;
    Motion motion{};
    std::int64_t fixes = 0;
    static constexpr auto fields() {
      return describe(field<&State::started>(), field<&State::motion>("", "as told last"),
                      field<&State::fixes>("", "of GPS, taken so far"));
    }
  };
  struct Out {
    Motion motion{};
    Stream stream{};
    static constexpr auto fields() { return describe(field<&Out::motion>(), field<&Out::stream>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
