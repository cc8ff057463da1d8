// Legs of a plan, and how far the submarine is on one. Earth frame NED about the origin of navigation, SI units,
// radians.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// What the vehicle does on a leg.
enum class Course : std::uint8_t { none, line, circle, station, rest, fix };
/// What depth and altitude are measured from.
enum class Vertical : std::uint8_t { depth, altitude };

constexpr auto enumerators(Course) {
  using enum Course;
  return std::array<Enumerator<Course>, 6>{
      {{"none", none, "the operator's setpoint counts"},
       {"line", line, "straight to a place"},
       {"circle", circle, "around a place"},
       {"station", station, "near a place at the surface, propeller off while it is"},
       {"rest", rest, "propeller off"},
       {"fix", fix, "propeller off until GPS has found it"}}};
}
constexpr auto enumerators(Vertical) {
  return std::array<Enumerator<Vertical>, 2>{{{"depth", Vertical::depth}, {"altitude", Vertical::altitude}}};
}

/// Defaults of who steers and of who watches over a plan. Farther off a circle (m), or off a station (in its radii),
/// its time does not go on; a station is come back to at the surface within them.
constexpr double circle_edge = 15, station_edge = 2.5;

/// A part of a maneuver. One with another number is another leg, and begins anew.
struct Leg {
  std::uint32_t number = 0;
  Course course = Course::none;
  double north = 0, east = 0;
  double turn = 0;
  double radius = 0;
  double duration = 0;
  bool until_level = false;
  Vertical vertical = Vertical::depth;
  double level = 0;
  double amplitude = 0, slope = 0;
  Drive drive = Drive::speed;
  double surge = 0, thrust = 0;

  static constexpr auto fields() {
    using L = Leg;
    return describe(
        field<&L::number>("", "another one is another leg"), field<&L::course>("", "what it does"),
        field<&L::north>("m", "of the origin: the end of the line, or the centre"),
        field<&L::east>("m", "of the origin"),
        field<&L::turn>("rad", "of the course where the next line begins; 0: there is none"),
        field<&L::radius>("m", "of the circle, clockwise where it is positive; of the station"),
        field<&L::duration>("s", "of circle, station or rest, from when it is there; 0: without end"),
        field<&L::until_level>("", "it ends where the level is reached"),
        field<&L::vertical>("", "what the level is measured from"), field<&L::level>("m", "depth or altitude"),
        field<&L::amplitude>("m", "up and down about the level on a line"),
        field<&L::slope>("rad", "pitch on the way up and down"), field<&L::drive>("", "what drives: speed or thrust"),
        field<&L::surge>("m/s", "through the water"), field<&L::thrust>("", "-1 (full astern) to 1 (full ahead)"));
  }
};

/// How far the vehicle is on a leg.
struct Progress {
  std::uint32_t on_leg = 0;
  bool near = false;
  bool levelled = false;
  bool done = false;
  double distance = 0;
  double cross_track = 0;
  double left = -1;

  static constexpr auto fields() {
    using P = Progress;
    return describe(field<&P::on_leg>("", "its number; 0: none"),
                    field<&P::near>("", "it is at the line's end, on the circle, at its station"),
                    field<&P::levelled>("", "it is at its depth or altitude"), field<&P::done>("", "the leg is over"),
                    field<&P::distance>("m", "to the line's end, or to the centre"),
                    field<&P::cross_track>("m", "to starboard of the line; outside of the circle"),
                    field<&P::left>("s", "until it is done, as it goes; -1: without end"));
  }
};

/// How the water moves over ground, as navigation estimates it.
struct Stream {
  double north = 0, east = 0;

  static constexpr auto fields() { return describe(field<&Stream::north>("m/s"), field<&Stream::east>("m/s")); }
};

/// How well navigation knows its place.
struct PlaceAccuracy {
  bool known = false;
  double deviation = 0;
  std::int64_t left_out = 0;

  static constexpr auto fields() {
    using P = PlaceAccuracy;
    return describe(field<&P::known>("", "GPS has found it once"),
                    field<&P::deviation>("m", "standard deviation of the place, of both axes together"),
                    field<&P::left_out>("", "fixes and ranges that fit nothing known, so far"));
  }
};

}  // namespace jarol::tasks
