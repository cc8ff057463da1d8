// The submarine's navigation: from what its instruments report to how it moves.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/lauv/depth_source.h"
#include "tasks/lauv/place_filter.h"
#include "tasks/values/guidance.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// Complementary filters: rates and velocities carry on what slower instruments set right. In SI units and rad, NED and
/// body axes as in control.h, k(T) = min(dt / T, 1):
///   phi += dt phi_dot(p, q, r) + k(angle_time) (measured - phi)    (rotations.h, euler_rates); and so theta, and psi
///   z   += dt (R_nb (u, v, w))_z + k(depth_time) (depth - z)
///   u   += k(speed_time) (measured - u); and so v and w
/// With exact instruments the motion is exact but for what a period of the task hides. Depth is that of the best
/// source. Place and current are those of the place filter, from the first fix on: before, nobody knows where it is.
/// After `restart` fixes in a row that fit nothing the place begins anew with the next one.
struct LauvNavigation {
  static constexpr std::string_view summary = "estimates the submarine's motion from its instruments";
  struct Param {
    double angle_time = 0.5;
    double depth_time = 0.7;
    double depth_timeout = 2.5;
    double depth_error = 0.6;
    double fix_depth = 0.15;
    double fix_depth_error = 0.3;
    std::int64_t surface_fixes = 3;
    Water water{};
    double speed_time = 0.2;
    double drift = 0.05;
    double current_change = 0.003;
    double current = 0.5;
    double fix_error = 2.5;
    double range_error = 1;
    double gate = 3.3;
    std::int64_t restart = 10;
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::angle_time>("s", "after which angles follow IMU and compass rather than rates"),
          field<&P::depth_time>("s", "after which depth follows the gauge rather than the motion"),
          field<&P::depth_timeout>("s", "a gauge that reports nothing for so long is lost"),
          field<&P::depth_error>(
              "m", "where the pressure is deeper than the gauge by more, it counts; more than the supervisor allows"),
          field<&P::fix_depth>("m", "greatest depth at which GPS works, as the supervisor has it"),
          field<&P::fix_depth_error>("m", "a depth greater than that by more is wrong beside a fix"),
          field<&P::surface_fixes>("", "in a row that prove it at the surface: one may have been late, or another's")
              .in(1, 1000),
          field<&P::water>("", "by which a pressure is a depth, as the supervisor's reckoning.water"),
          field<&P::speed_time>("s", "over which the speed log is smoothed"),
          field<&P::drift>("m/s^0.5", "deviation of the way reckoned, after 1 s"),
          field<&P::current_change>("m/s^1.5", "deviation by which the current changes in 1 s"),
          field<&P::current>("m/s", "deviation of the current before anything is known of it"),
          field<&P::fix_error>("m", "deviation of GPS, per axis").in(0.001, 1000),
          field<&P::range_error>("m", "deviation of the range to a beacon").in(0.001, 1000),
          field<&P::gate>("", "a fix or range that is off by more deviations is left out"),
          field<&P::restart>("", "fixes left out in a row, after which the next one counts"));
    }
  };
  struct In {
    Instruments instruments{};
    static constexpr auto fields() { return describe(field<&In::instruments>()); }
  };
  struct State {
    bool started = false;
    Motion motion{};
    DepthSource depth{};
    PlaceFilter place{};
    std::int64_t fixes = 0, misfits = 0, left_out = 0;
    std::array<std::int64_t, 2> ranges{};
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::started>(), field<&S::motion>("", "as reported last"), field<&S::depth>(),
                      field<&S::place>(), field<&S::fixes>("", "of GPS, so far"),
                      field<&S::misfits>("", "fixes left out in a row"),
                      field<&S::left_out>("", "fixes and ranges so far"), field<&S::ranges>("", "so far, per beacon"));
    }
  };
  struct Out {
    Motion motion{};
    Stream stream{};
    PlaceAccuracy accuracy{};
    static constexpr auto fields() {
      return describe(field<&Out::motion>(), field<&Out::stream>(), field<&Out::accuracy>());
    }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
