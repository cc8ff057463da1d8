#include "distributers/lauv/maneuvers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

using tasks::Course;
using tasks::Leg;

constexpr double min_step = 1e-3;  // m across, of a curve of rows
constexpr std::size_t max_legs = 1000;

[[noreturn]] void refuse(const std::string& text) { throw InputError(text); }

// Where maneuvers are flown.
struct Sea {
  const Origin& origin;
  const FlightLimits& limits;
};

double finite(double value, const char* name) {
  if (!std::isfinite(value)) refuse(fmt::format("{} is no number", name));
  return value;
}

double angle(double value, const char* name, double max = 2 * pi) {
  if (std::abs(finite(value, name)) > max)
    refuse(fmt::format("{} is {:.6g} rad; it is {:.4g} to {:.4g} rad", name, value, -max, max));
  return value;
}

void refuse_far(const Leg& leg, const Origin& origin) {
  if (const double far = std::hypot(leg.north, leg.east); far > origin.furthest)
    refuse(fmt::format("its place is {:.0f} km from the origin; places within {:.0f} km are gone to", far / 1000,
                       origin.furthest / 1000));
}

// The vehicle can't follow a smaller circle than the usual one; DUNE widens them, too.
Leg circle_of(Leg leg, Course course, double radius, double duration) {
  leg.course = course;
  leg.radius = std::max(radius, default_radius);
  leg.duration = duration;
  return leg;
}

// What most maneuvers have: a line to a place.
template <class M>
Leg line_to(const M& m, const Sea& sea) {
  Leg leg{.course = Course::line};
  set_place(leg, m.lat, m.lon, sea.origin);
  set_level(leg, static_cast<double>(m.z), m.z_units, sea.limits);
  set_speed(leg, static_cast<double>(m.speed), m.speed_units, sea.limits);
  return leg;
}

double radius_of(double radius, const FlightLimits& limits) {
  if (finite(radius, "radius") < 0) refuse(fmt::format("radius is {:.6g} m; it can't be negative", radius));
  check_radius(limits, radius, "radius");
  return radius;
}

using Legs = std::vector<PlannedLeg>;

Legs legs_of(const imc::Goto& m, const Sea& sea) { return {{line_to(m, sea)}}; }

Legs legs_of(const imc::FollowPath& m, const Sea& sea) {
  const Leg start = line_to(m, sea);
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
    refuse_far(leg, sea.origin);
    const double down = finite(static_cast<double>(z), "z of a point");
    leg.level += leg.vertical == tasks::Vertical::depth ? down : -down;
    if (leg.level < 0) refuse(fmt::format("point {} is {:.6g} m above the surface", legs.size() + 1, -leg.level));
    check_level(sea.limits, leg.vertical, leg.level, fmt::format("the level of point {}", legs.size() + 1));
    legs.push_back({leg});
  }
  return legs;
}

// As DUNE flies them: from `coff` before a corner along `bearing`, across to the side of the first curve, and back.
// Each row goes on `coff` beyond the area; with square curves it turns there, else at the area. The first step across
// and every second one after it is `alternation` percent of `hstep`, the others what two steps leave; there are as many
// as even ones have room.
Legs legs_of(const imc::Rows& m, const Sea& sea) {
  const Leg corner = line_to(m, sea);
  const auto length = finite(static_cast<double>(m.length), "length"),
             width = finite(static_cast<double>(m.width), "width"),
             step = finite(static_cast<double>(m.hstep), "hstep");
  if (!(length > 0) || !(step > 0) || width < 0)
    refuse(fmt::format("rows of {:.6g} m, {:.6g} m apart over {:.6g} m; lengths are positive", length, step, width));
  // the second step would go back
  if (m.alternation > 200) refuse(fmt::format("alternation is {} %; it is at most 200 %, of hstep", m.alternation));
  const bool square = (m.flags & imc::Rows::Flags::SQUARE_CURVE) != 0;
  const double side = (m.flags & imc::Rows::Flags::CURVE_RIGHT) != 0 ? 1 : -1;
  const double along = angle(m.bearing, "bearing"),
               across = along + side * (pi / 2 + angle(m.cross_angle, "cross_angle"));
  Legs legs;
  const auto go_to = [&](double a, double b) {
    if (legs.size() == max_legs) refuse(fmt::format("more than {} lines", max_legs));
    Leg leg = corner;
    leg.north += a * std::cos(along) + b * std::cos(across);
    leg.east += a * std::sin(along) + b * std::sin(across);
    refuse_far(leg, sea.origin);
    legs.push_back({leg});
  };
  const double out = m.coff, share = 0.01 * m.alternation;
  if (out > 0) go_to(-out, 0);
  go_to(0, 0);
  float curves = std::floor(m.width / m.hstep);
  double b = 0;
  for (bool away = true;; away = !away) {
    const double far = away ? length : 0, beyond = away ? length + out : -out;
    go_to(beyond, b);
    const double across_by = step * (away ? share : 2 - share);
    const bool is_curve = std::abs(across_by) > min_step;
    if (is_curve && curves-- < 1) return legs;
    b += across_by;
    if (is_curve || !square) go_to(square ? beyond : far, b);
  }
}

Legs legs_of(const imc::Loiter& m, const Sea& sea) {
  using Type = imc::Loiter::Type;
  if (m.type != Type::DEFAULT && m.type != Type::CIRCULAR)
    refuse(fmt::format("a loiter is flown as a circle, types 0 and 1, not {}", m.type));
  if (m.direction > imc::Loiter::Direction::IWINDCURR)
    refuse(fmt::format("direction is {}; it is VDEP, CLOCKW, CCLOCKW or IWINDCURR, 0 to 3", m.direction));
  const double side = m.direction == imc::Loiter::Direction::CCLOCKW ? -1 : 1;
  Leg leg =
      circle_of(line_to(m, sea), Course::circle, radius_of(static_cast<double>(m.radius), sea.limits), m.duration);
  leg.radius *= side;
  return {{leg}};
}

Legs legs_of(const imc::StationKeeping& m, const Sea& sea) {
  return {
      {circle_of(line_to(m, sea), Course::station, radius_of(static_cast<double>(m.radius), sea.limits), m.duration)}};
}

Legs legs_of(const imc::YoYo& m, const Sea& sea) {
  Leg leg = line_to(m, sea);
  leg.amplitude = finite(static_cast<double>(m.amplitude), "amplitude");
  leg.slope = finite(static_cast<double>(m.pitch), "pitch");
  if (!(leg.amplitude > 0) || !(leg.slope > 0) || leg.slope > 45 * degree)
    refuse(fmt::format("up and down by {:.6g} m at {:.6g} rad; these are positive, and no more than 0.785 rad",
                       leg.amplitude, leg.slope));
  const bool down = leg.vertical == tasks::Vertical::depth;
  check_level(sea.limits, leg.vertical, leg.level + (down ? leg.amplitude : -leg.amplitude),
              down ? "z plus amplitude" : "z less amplitude");
  return {{leg}};
}

Legs legs_of(const imc::Elevator& m, const Sea& sea) {
  const bool here = (m.flags & imc::Elevator::Flags::CURR_POS) != 0;
  Leg there{.course = Course::line};
  if (!here) set_place(there, m.lat, m.lon, sea.origin);
  set_speed(there, static_cast<double>(m.speed), m.speed_units, sea.limits);
  Leg up_or_down = circle_of(there, Course::circle, radius_of(static_cast<double>(m.radius), sea.limits), 0);
  up_or_down.until_level = true;
  set_level(up_or_down, static_cast<double>(m.end_z), m.end_z_units, sea.limits, "end_z");
  if (here) return {{up_or_down, true}};
  set_level(there, static_cast<double>(m.start_z), m.start_z_units, sea.limits, "start_z");
  return {{there}, {up_or_down}};
}

// As DUNE flies it: there, up on a spiral, at the surface a station where it came up, or until GPS has found it, and
// down again.
Legs legs_of(const imc::PopUp& m, const Sea& sea) {
  using Flags = imc::PopUp::Flags;
  const bool here = (m.flags & Flags::CURR_POS) != 0,
             stays = (m.flags & (Flags::WAIT_AT_SURFACE | Flags::STATION_KEEP)) != 0;
  const double radius = radius_of(static_cast<double>(m.radius), sea.limits);
  Leg there{.course = Course::line};
  if (!here) set_place(there, m.lat, m.lon, sea.origin);
  set_level(there, static_cast<double>(m.z), m.z_units, sea.limits);
  set_speed(there, static_cast<double>(m.speed), m.speed_units, sea.limits);
  Leg down = circle_of(there, Course::circle, 0, 0);
  down.until_level = true;
  Leg up = down;
  set_level(up, 0, imc::ZUnits::DEPTH, sea.limits);
  Legs legs;
  if (!here) legs.push_back({there});
  legs.push_back({up, here});
  Leg at_surface = circle_of(up, stays ? Course::station : Course::fix, radius, stays ? m.duration : 0);
  at_surface.until_level = false;
  if (!stays || m.duration > 0) legs.push_back({at_surface, true});
  legs.push_back({down, true});
  return legs;
}

Legs legs_of(const imc::IdleManeuver& m, const Sea&) {
  return {{{.course = Course::rest, .duration = static_cast<double>(m.duration)}}};
}

Legs legs_of(const imc::Teleoperation&, const Sea&) { return {}; }
Legs legs_of(const imc::FollowReference&, const Sea&) { return {}; }

// True: it is an M, and done.
template <class M>
bool take(const messages::Message& message, const Sea& sea, Maneuver& to) {
  const M* m = message.as<M>();
  if (m == nullptr) return false;
  to.legs = legs_of(*m, sea);
  if constexpr (requires { m->timeout; }) {
    to.timeout = finite(static_cast<double>(m->timeout), "timeout");
    if (to.timeout < 0) refuse(fmt::format("timeout is {:.6g} s; it can't be negative", to.timeout));
  }
  if constexpr (requires { m->control_src; }) {
    to.control_source = m->control_src;
    to.control_entity = m->control_ent;
    to.loiter_radius = finite(static_cast<double>(m->loiter_radius), "loiter_radius");
    check_radius(sea.limits, std::abs(to.loiter_radius), "loiter_radius");
  }
  return true;
}

template <class... M>
bool take_any(const messages::Message& message, const Sea& sea, Maneuver& to) {
  return (take<M>(message, sea, to) || ...);
}

}  // namespace

void set_place(Leg& leg, double latitude, double longitude, const Origin& origin) {
  const EarthRadii radii = earth_radii(origin.latitude);
  leg.north = (angle(latitude, "lat", pi / 2) - origin.latitude) * radii.north;
  leg.east = wrapped(angle(longitude, "lon") - origin.longitude) * radii.east;
  refuse_far(leg, origin);
}

void set_level(Leg& leg, double z, std::uint8_t units, const FlightLimits& limits, const char* name) {
  using Units = imc::ZUnits;
  if (!(finite(z, name) >= 0)) refuse(fmt::format("{} is {:.6g} m; depths and altitudes are not negative", name, z));
  const bool known = units == Units::DEPTH || units == Units::ALTITUDE || (units == Units::NONE && z == 0);
  if (!known) refuse(fmt::format("{} is taken as DEPTH or ALTITUDE, 1 or 2, not {}", name, units));
  leg.vertical = units == Units::ALTITUDE ? tasks::Vertical::altitude : tasks::Vertical::depth;
  leg.level = z;
  check_level(limits, leg.vertical, z, name);
}

void set_speed(Leg& leg, double speed, std::uint8_t units, const FlightLimits& limits) {
  using Units = imc::SpeedUnits;
  if (units != Units::METERS_PS && units != Units::PERCENTAGE)
    refuse(fmt::format("speed is taken in m/s or %, 0 or 2, not {}", units));
  const bool percentage = units == Units::PERCENTAGE;
  (percentage ? check_percentage : check_speed)(limits, finite(speed, "speed"));
  leg.drive = percentage ? tasks::Drive::thrust : tasks::Drive::speed;
  leg.surge = percentage ? 0 : speed;
  leg.thrust = percentage ? speed / 100 : 0;
}

Maneuver make_maneuver(const messages::InlineMessage& message, const Origin& origin, const FlightLimits& limits) {
  messages::Message opened;
  std::string why;
  if (!messages::take_inline(imc::message_set(), message, opened, &why)) refuse("it can't be read: " + why);
  if (opened.descriptor() == nullptr) refuse("there is no maneuver in it");
  Maneuver made{.type = message.id};
  if (!take_any<imc::Goto, imc::FollowPath, imc::Rows, imc::Loiter, imc::StationKeeping, imc::YoYo, imc::Elevator,
                imc::PopUp, imc::IdleManeuver, imc::Teleoperation, imc::FollowReference>(opened, {origin, limits},
                                                                                         made))
    refuse(fmt::format("{} is not flown here", opened.descriptor()->name));
  return made;
}

bool needs_place(const Maneuver& maneuver) {
  const auto goes_by_it = [](const PlannedLeg& each) {
    const Course course = each.leg.course;
    if (each.here && each.leg.until_level) return false;  // up or down from wherever it is
    return course == Course::line || course == Course::circle || course == Course::station;
  };
  return maneuver.type == imc::FollowReference::message_id ||
         std::any_of(maneuver.legs.begin(), maneuver.legs.end(), goes_by_it);
}

bool needs_altitude(const Maneuver& maneuver) {
  return std::any_of(maneuver.legs.begin(), maneuver.legs.end(),
                     [](const PlannedLeg& each) { return each.leg.vertical == tasks::Vertical::altitude; });
}

}  // namespace jarol::distributers
