#include "distributers/lauv/maneuvers.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

using tasks::Course;
using tasks::Leg;

constexpr double furthest = 100e3;  // m, from the origin: the ground is flat there
constexpr double surface = 0.5;     // m, where a station is kept with the propeller off
constexpr std::size_t most_legs = 1000;

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument(text); }

double finite(double value, const char* name) {
  if (!std::isfinite(value)) refuse(fmt::format("{} is no number", name));
  return value;
}

// What most maneuvers have: a line to a place.
template <class M>
Leg line_to(const M& m, const Origin& origin) {
  Leg leg{.course = Course::line};
  set_place(leg, m.lat, m.lon, origin);
  set_level(leg, static_cast<double>(m.z), m.z_units);
  set_speed(leg, static_cast<double>(m.speed), m.speed_units);
  return leg;
}

Leg circle_of(Leg leg, double radius, double duration) {
  leg.course = Course::circle;
  leg.radius = radius == 0 ? default_radius : radius;
  leg.duration = duration;
  return leg;
}

// At the surface the vehicle floats; below it has to go on, for it is a little lighter than water.
Leg station_of(Leg leg, double radius, double duration) {
  leg = circle_of(leg, radius, duration);
  if (leg.vertical == tasks::Vertical::depth && leg.level < surface) leg.course = Course::station;
  return leg;
}

double radius_of(double radius) {
  if (finite(radius, "radius") < 0) refuse(fmt::format("radius is {:.6g} m; it can't be negative", radius));
  return radius;
}

using Legs = std::vector<PlannedLeg>;

Legs legs_of(const imc::Goto& m, const Origin& origin) { return {{line_to(m, origin)}}; }

Legs legs_of(const imc::FollowPath& m, const Origin& origin) {
  const Leg start = line_to(m, origin);
  if (m.points.empty()) refuse("a path has at least one point");
  Legs legs;
  for (const messages::InlineMessage& each : m.points) {
    messages::Message point;
    std::string why;
    if (!messages::take_inline(imc::message_set(), each, point, &why) || point.as<imc::PathPoint>() == nullptr)
      refuse(fmt::format("point {} is no PathPoint", legs.size() + 1));
    const auto& [x, y, z] = *point.as<imc::PathPoint>();
    Leg leg = start;
    leg.north += finite(static_cast<double>(x), "x of a point");
    leg.east += finite(static_cast<double>(y), "y of a point");
    const double down = finite(static_cast<double>(z), "z of a point");
    leg.level += leg.vertical == tasks::Vertical::depth ? down : -down;
    if (leg.level < 0) refuse(fmt::format("point {} is {:.6g} m above the surface", legs.size() + 1, -leg.level));
    legs.push_back({leg});
  }
  return legs;
}

// From a corner along `bearing`, across it to the side of the first curve, and back; the first step across and every
// second one after it is `alternation` percent of `hstep`, the others what two steps leave: as DUNE flies them, evenly
// at 100. With square curves a row begins where the last one turned, `coff` beyond the area.
Legs legs_of(const imc::Rows& m, const Origin& origin) {
  const Leg corner = line_to(m, origin);
  const auto length = finite(static_cast<double>(m.length), "length"),
             width = finite(static_cast<double>(m.width), "width"),
             step = finite(static_cast<double>(m.hstep), "hstep");
  if (!(length > 0) || !(step > 0) || width < 0)
    refuse(fmt::format("rows of {:.6g} m, {:.6g} m apart over {:.6g} m; lengths are positive", length, step, width));
  const bool square = (m.flags & imc::Rows::Flags::SQUARE_CURVE) != 0;
  const double side = (m.flags & imc::Rows::Flags::CURVE_RIGHT) != 0 ? 1 : -1;
  const double along = finite(m.bearing, "bearing"),
               across = along + side * pi / 2 + finite(m.cross_angle, "cross_angle");
  const double share = 0.01 * std::min<int>(m.alternation, 200);
  Legs legs;
  const auto go_to = [&](double a, double b) {
    if (legs.size() == most_legs) refuse(fmt::format("more than {} lines", most_legs));
    Leg leg = corner;
    leg.north += a * std::cos(along) + b * std::cos(across);
    leg.east += a * std::sin(along) + b * std::sin(across);
    legs.push_back({leg});
  };
  go_to(0, 0);
  bool away = true, first = true;
  for (double b = 0; b <= width;) {
    const double far = away ? length : 0, out = away ? m.coff : -static_cast<double>(m.coff);
    const double next = b + step * (first ? share : 2 - share);
    const bool last = next > width;
    go_to(last ? far : far + out, b);
    if (last) break;
    go_to(square ? far + out : far, next);
    b = next;
    away = !away;
    first = !first;
  }
  return legs;
}

Legs legs_of(const imc::Loiter& m, const Origin& origin) {
  using Type = imc::Loiter::Type;
  if (m.type != Type::DEFAULT && m.type != Type::CIRCULAR)
    refuse(fmt::format("a loiter is flown as a circle, types 0 and 1, not {}", m.type));
  const double side = m.direction == imc::Loiter::Direction::CCLOCKW ? -1 : 1;
  const double radius = radius_of(static_cast<double>(m.radius));
  return {{circle_of(line_to(m, origin), side * (radius == 0 ? default_radius : radius), m.duration)}};
}

Legs legs_of(const imc::StationKeeping& m, const Origin& origin) {
  return {{station_of(line_to(m, origin), radius_of(static_cast<double>(m.radius)), m.duration)}};
}

Legs legs_of(const imc::YoYo& m, const Origin& origin) {
  Leg leg = line_to(m, origin);
  leg.amplitude = finite(static_cast<double>(m.amplitude), "amplitude");
  leg.slope = finite(static_cast<double>(m.pitch), "pitch");
  if (!(leg.amplitude > 0) || !(leg.slope > 0) || leg.slope > 45 * degree)
    refuse(fmt::format("up and down by {:.6g} m at {:.6g} rad; these are positive, and no more than 0.785 rad",
                       leg.amplitude, leg.slope));
  return {{leg}};
}

Legs legs_of(const imc::Elevator& m, const Origin& origin) {
  const bool here = (m.flags & imc::Elevator::Flags::CURR_POS) != 0;
  Leg there{.course = Course::line};
  if (!here) set_place(there, m.lat, m.lon, origin);
  set_speed(there, static_cast<double>(m.speed), m.speed_units);
  Leg up_or_down = circle_of(there, radius_of(static_cast<double>(m.radius)), 0);
  up_or_down.until_level = true;
  set_level(up_or_down, static_cast<double>(m.end_z), m.end_z_units);
  if (here) return {{up_or_down, true}};
  set_level(there, static_cast<double>(m.start_z), m.start_z_units);
  return {{there}, {up_or_down}};
}

Legs legs_of(const imc::PopUp& m, const Origin& origin) {
  using Flags = imc::PopUp::Flags;
  const bool here = (m.flags & Flags::CURR_POS) != 0;
  Leg there{.course = Course::line};
  if (!here) set_place(there, m.lat, m.lon, origin);
  set_level(there, static_cast<double>(m.z), m.z_units);
  set_speed(there, static_cast<double>(m.speed), m.speed_units);
  Leg up = circle_of(there, default_radius, 0);
  set_level(up, 0, imc::ZUnits::DEPTH);
  up.until_level = true;
  Legs legs;
  if (!here) legs.push_back({there});
  legs.push_back({up, here});
  if ((m.flags & Flags::WAIT_AT_SURFACE) == 0) return legs;
  Leg wait = station_of(up, radius_of(static_cast<double>(m.radius)), m.duration);
  wait.until_level = false;
  if ((m.flags & Flags::STATION_KEEP) == 0) wait.course = Course::rest;
  if (m.duration > 0) legs.push_back({wait, here && wait.course == Course::station});
  return legs;
}

Legs legs_of(const imc::IdleManeuver& m, const Origin&) {
  return {{{.course = Course::rest, .duration = static_cast<double>(m.duration)}}};
}

Legs legs_of(const imc::Teleoperation&, const Origin&) { return {}; }
Legs legs_of(const imc::FollowReference&, const Origin&) { return {}; }

// True: it is an M, and done.
template <class M>
bool take(const messages::Message& message, const Origin& origin, Maneuver& to) {
  const M* m = message.as<M>();
  if (m == nullptr) return false;
  to.legs = legs_of(*m, origin);
  if constexpr (requires { m->timeout; }) to.timeout = finite(static_cast<double>(m->timeout), "timeout");
  if constexpr (requires { m->control_src; }) {
    to.control_source = m->control_src;
    to.control_entity = m->control_ent;
    to.loiter_radius = radius_of(static_cast<double>(m->loiter_radius));
  }
  return true;
}

template <class... M>
bool take_any(const messages::Message& message, const Origin& origin, Maneuver& to) {
  return (take<M>(message, origin, to) || ...);
}

}  // namespace

void set_place(Leg& leg, double latitude, double longitude, const Origin& origin) {
  const EarthRadii radii = earth_radii(origin.latitude);
  leg.north = (finite(latitude, "lat") - origin.latitude) * radii.north;
  leg.east = wrapped(finite(longitude, "lon") - origin.longitude) * radii.east;
  if (const double far = std::hypot(leg.north, leg.east); far > furthest)
    refuse(fmt::format("its place is {:.0f} km from the origin; places within 100 km are gone to", far / 1000));
}

void set_level(Leg& leg, double z, std::uint8_t units) {
  using Units = imc::ZUnits;
  if (!(finite(z, "z") >= 0)) refuse(fmt::format("z is {:.6g} m; depths and altitudes are not negative", z));
  const bool known = units == Units::DEPTH || units == Units::ALTITUDE || (units == Units::NONE && z == 0);
  if (!known) refuse(fmt::format("z is taken as DEPTH or ALTITUDE, 1 or 2, not {}", units));
  leg.vertical = units == Units::ALTITUDE ? tasks::Vertical::altitude : tasks::Vertical::depth;
  leg.level = z;
}

void set_speed(Leg& leg, double speed, std::uint8_t units) {
  using Units = imc::SpeedUnits;
  if (units != Units::METERS_PS && units != Units::PERCENTAGE)
    refuse(fmt::format("speed is taken in m/s or %, 0 or 2, not {}", units));
  if (!(finite(speed, "speed") > 0)) refuse(fmt::format("speed is {:.6g}; it is positive", speed));
  leg.drive = units == Units::PERCENTAGE ? tasks::Drive::thrust : tasks::Drive::speed;
  leg.surge = units == Units::PERCENTAGE ? 0 : speed;
  leg.thrust = units == Units::PERCENTAGE ? std::min(speed / 100, 1.0) : 0;
}

Maneuver make_maneuver(const messages::InlineMessage& message, const Origin& origin) {
  messages::Message opened;
  std::string why;
  if (!messages::take_inline(imc::message_set(), message, opened, &why)) refuse("it can't be read: " + why);
  if (opened.form() == nullptr) refuse("there is no maneuver in it");
  Maneuver made{.type = message.id};
  if (!take_any<imc::Goto, imc::FollowPath, imc::Rows, imc::Loiter, imc::StationKeeping, imc::YoYo, imc::Elevator,
                imc::PopUp, imc::IdleManeuver, imc::Teleoperation, imc::FollowReference>(opened, origin, made))
    refuse(fmt::format("{} is not flown here", opened.form()->name));
  return made;
}

}  // namespace jarol::distributers
