// The JAviator's own sensor processing, as its flight controller's "original" loop does it. The project's control loop
// is the source of every constant; units of its Kalman filters are mm and rad.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/room.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// A Kalman filter of place and speed along one axis, with the acceleration as its input.
struct AxisKalman {
  double place = 0, speed = 0;
  double P00 = 0, P01 = 0, P11 = 0;
  double acceleration = 0;
  double last = 0, since = 0;

  static constexpr auto fields() {
    using A = AxisKalman;
    return describe(field<&A::place>("mm"), field<&A::speed>("mm/s"), field<&A::P00>("mm^2", "covariance"),
                    field<&A::P01>("mm^2/s"), field<&A::P11>("mm^2/s^2"),
                    field<&A::acceleration>("mm/s^2", "low-pass filtered"), field<&A::last>("mm", "last measurement"),
                    field<&A::since>("s", "it was taken"));
  }
};

/// Its lasers and walls are taken as they stand to each other: with the take-off heading along a wall and turned by
/// less than 45 degrees from there it computes what the JAviator's controller does, who takes any wall for the one
/// ahead.
struct OriginalFilter {
  static constexpr std::string_view summary = "estimates attitude, position and velocity as the JAviator's controller";
  struct Param {
    Room room{};
    static constexpr auto fields() { return describe(field<&Param::room>("", "whose walls the lasers see")); }
  };
  struct In {
    JaviatorSensors sensors{};
    FlightDirective directive{};
    BlindMotion blind{};
    SonarRanges sonars{};
    static constexpr auto fields() {
      return describe(field<&In::sensors>(), field<&In::directive>("", "of the period before"),
                      field<&In::blind>("", "not looked at"), field<&In::sonars>("", "not looked at"));
    }
  };
  struct State {
    AxisKalman x{}, y{}, z{};
    double roll = 0, pitch = 0, yaw = 0;
    double zero_x = 0, zero_y = 0, zero_z = 0, zero_yaw = 0, unwrapped_yaw = 0;
    double turning = 0;
    std::uint32_t answers = 0;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::x>(), field<&S::y>(), field<&S::z>("", "upwards"), field<&S::roll>("rad"),
                      field<&S::pitch>("rad"), field<&S::yaw>("rad"), field<&S::zero_x>("mm", "where it stood"),
                      field<&S::zero_y>("mm"), field<&S::zero_z>("mm"), field<&S::zero_yaw>("rad"),
                      field<&S::unwrapped_yaw>("rad", "all turns counted"),
                      field<&S::turning>("s", "for which its rotors may still run down"),
                      field<&S::answers>("", "of the Robostix, up to now"));
    }
  };
  struct Out {
    FlightEstimate estimate{};
    static constexpr auto fields() { return describe(field<&Out::estimate>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
