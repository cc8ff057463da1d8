// Guidance: from the leg of a plan to depth, heading and speed.
#pragma once

#include <string_view>

#include "graph/math/geometry.h"
#include "graph/task.h"
#include "tasks/values/guidance.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// How it keeps its station, in radii of that.
struct StationKeeping {
  double back = 0.5;
  double edge = station_edge;

  static constexpr auto fields() {
    using S = StationKeeping;
    return describe(
        field<&S::back>("", "distance from its place to which it drives back, in radii of the station").in(0, 1),
        field<&S::edge>(
            "", "distance, in such radii, up to which its time counts; at the surface it drives back from there")
            .in(1, 1000));
  }
};

/// Without a leg the operator's setpoint goes through. On one, line of sight with an integral (Fossen, Handbook of
/// Marine Craft Hydrodynamics and Motion Control, 2nd ed. 2021, section 12.5; Borhaug, Pavlov, Pettersen, CDC 2008, eq.
/// 10), n frame, m and rad: the course to keep is
///   line:    chi = chi_p - atan((e + sigma) / lookahead), e to starboard of the line whose course is chi_p
///   circle:  chi = gamma + s (pi / 2 + atan((e + sigma) / lookahead)), e = distance - radius, gamma the bearing from
///   the
///            centre, s = 1 clockwise and -1 counterclockwise
///   sigma_dot = integral lookahead e / (lookahead^2 + (e + sigma)^2), while |e| < reach
/// and the heading is that course less the drift, asin(stream across chi / speed through the water). On a circle it is
/// ahead by what the heading lags, turn rate times heading_time, and by the slip of the hull, -atan(v / u). A line
/// begins where the last one ended if the vehicle is near there, else where the vehicle is. It ends before its end
/// where the course turns: by radius tan(turn / 2), of the circle on which the vehicle turns. Who comes past its end,
/// by what navigation says, but farther off than `miss` and twice that radius, as after a leap of its place or out of a
/// current, steers for it anew: the line begins where the vehicle is. Depth counts nothing there, as in DUNE. A station
/// is driven to at its depth, and where the vehicle has been there back to at the surface, on which it floats,
/// within station.edge radii, as DUNE does. Its time counts while the vehicle is within them, that of a circle while it
/// is within `miss` of it. An altitude is not reached before the altimeter has reported one; until then the vehicle
/// keeps its depth.
struct LauvGuidance {
  static constexpr std::string_view summary = "follows the legs of a plan: lines, circles, stations";
  struct Param {
    double lookahead = 6;
    double integral = 0.1;
    double turn_rate = 0.125;
    double heading_time = 1.25;
    double reach = 2;
    double level = 0.3;
    double miss = circle_edge;
    double joins = 4;
    double max_turn = 100 * degree;
    double max_drift = 0.9;
    double min_speed = 0.1;
    StationKeeping station{};
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::lookahead>("m", "along the path, of the point that it steers for").in(0.01, 10000),
          field<&P::integral>("m/s", "of the cross-track error"),
          field<&P::turn_rate>("rad/s", "at which the vehicle turns from line to line").in(0.001, 10),
          field<&P::heading_time>("s", "by which the heading is behind its command"),
          field<&P::reach>("m", "from a place, where it is reached"),
          field<&P::level>("m", "from a depth, where it is reached"),
          field<&P::miss>("m", "past the end of a line by so much, to any side, it is not reached"),
          field<&P::joins>("",
                           "times `reach`, plus the radius of a turn: a line that begins so near to the end of the "
                           "last one begins there")
              .in(0, 1000),
          field<&P::max_turn>(
              "rad", "from line to line: before a sharper turn it begins no earlier than before one by this angle")
              .in(0, 170 * degree),
          field<&P::max_drift>("", "greatest sine of the angle by which it heads into a stream").in(0, 1),
          field<&P::min_speed>("m/s", "least speed by which times and drift are reckoned").in(0.001, 10),
          field<&P::station>("", "how it keeps a station"));
    }
  };
  struct In {
    Leg leg{};
    Setpoint setpoint{};
    Motion motion{};
    Stream stream{};
    Instruments instruments{};
    static constexpr auto fields() {
      return describe(field<&In::leg>(), field<&In::setpoint>(), field<&In::motion>(), field<&In::stream>(),
                      field<&In::instruments>());
    }
  };
  struct State {
    std::uint32_t number = 0;
    bool has_end = false;
    double end_x = 0, end_y = 0;
    double begin_x = 0, begin_y = 0;
    bool returns = false;
    double sigma = 0;
    double since = 0;
    bool arrived = false, drifted = false, done = false;
    std::int64_t fixes = 0;
    double depth = 0;
    bool descends = true;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::number>("", "of the leg"), field<&S::has_end>("", "the last leg was a line"),
                      field<&S::end_x>("m", "of the last line"), field<&S::end_y>("m", "of the last line"),
                      field<&S::begin_x>("m", "of the line"), field<&S::begin_y>("m", "of the line"),
                      field<&S::returns>("", "to the end of a line that it has missed"),
                      field<&S::sigma>("m", "integral of the cross-track error"),
                      field<&S::since>("s", "that it was there"), field<&S::arrived>(),
                      field<&S::drifted>("", "away from its station"), field<&S::done>(),
                      field<&S::fixes>("", "of GPS when the leg began"),
                      field<&S::depth>("m", "commanded on the way up and down"), field<&S::descends>());
    }
  };
  struct Out {
    Setpoint setpoint{};
    Progress progress{};
    static constexpr auto fields() { return describe(field<&Out::setpoint>(), field<&Out::progress>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
