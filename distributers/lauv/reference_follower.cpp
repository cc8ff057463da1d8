#include "distributers/lauv/reference_follower.h"

#include <cmath>

#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

using tasks::Course;

constexpr std::uint16_t any_system = 0xffff;
constexpr std::uint8_t any_entity = 0xff;
constexpr double usual_speed = 1;   // m/s, until a reference has one
constexpr double same_place = 0.5;  // m
constexpr double surface = 0.5;     // m, where it keeps its station with the propeller off

// The message in that field, which has to be an M.
template <class M>
M read(const messages::InlineMessage& field, const char* name) {
  messages::Message message;
  if (!messages::take_inline(imc::message_set(), field, message) || message.as<M>() == nullptr)
    throw InputError(std::string("the reference's ") + name + " is no " + std::string(M::descriptor.name));
  return *message.as<M>();
}

// Below 0: counterclockwise. A station has no side.
double radius_on(Course course, double radius) {
  const double size = std::max(std::abs(radius), default_radius);
  return course == Course::circle && radius < 0 ? -size : size;
}

}  // namespace

bool needs_altitude(const imc::Reference& reference) {
  return (reference.flags & imc::Reference::Flags::Z) != 0 &&
         read<imc::DesiredZ>(reference.z, "z").z_units == imc::ZUnits::ALTITUDE;
}

ReferenceFollower::ReferenceFollower(const Maneuver& maneuver, Duration now, const FlightLimits& limits)
    : source_(maneuver.control_source),
      entity_(maneuver.control_entity),
      timeout_(maneuver.timeout),
      radius_(maneuver.loiter_radius),
      limits_(limits),
      heard_(now),
      leg_{.course = Course::rest, .surge = usual_speed} {}

bool ReferenceFollower::obeys(std::uint16_t source, std::uint8_t entity) const {
  return (source_ == any_system || source_ == source) && (entity_ == any_entity || entity_ == entity);
}

bool ReferenceFollower::take(const imc::Reference& reference, std::uint16_t source, std::uint8_t entity, Duration now,
                             const Origin& origin, const tasks::Motion& motion) {
  using Flags = imc::Reference::Flags;
  if (!obeys(source, entity)) return false;
  tasks::Leg leg = leg_;
  if ((reference.flags & Flags::LOCATION) != 0) {
    set_place(leg, reference.lat, reference.lon, origin);
    if (leg.course == Course::rest || std::hypot(leg.north - leg_.north, leg.east - leg_.east) > same_place)
      leg.course = Course::line;
    else
      leg.north = leg_.north, leg.east = leg_.east;
  } else if (leg.course == Course::rest) {  // without a place it is where the vehicle is
    leg.course = Course::line;
    leg.north = motion.x, leg.east = motion.y;
  }
  if ((reference.flags & Flags::SPEED) != 0) {
    const auto speed = read<imc::DesiredSpeed>(reference.speed, "speed");
    if (speed.value == 0)
      leg.drive = tasks::Drive::thrust, leg.thrust = 0;
    else
      set_speed(leg, speed.value, speed.speed_units, limits_);
  }
  if ((reference.flags & Flags::Z) != 0) {
    const auto z = read<imc::DesiredZ>(reference.z, "z");
    set_level(leg, static_cast<double>(z.value), z.z_units, limits_);
  }
  if ((reference.flags & Flags::RADIUS) != 0) {
    if (!std::isfinite(reference.radius)) throw InputError("the reference's radius is no number");
    check_radius(limits_, std::abs(static_cast<double>(reference.radius)), "the reference's radius");
    radius_ = static_cast<double>(reference.radius);
    if (leg.course == Course::circle || leg.course == Course::station) leg.radius = radius_on(leg.course, radius_);
  }
  done_ |= (reference.flags & Flags::MANDONE) != 0;
  heard_ = now;
  heard_any_ = true;
  reference_ = reference;
  leg_ = leg;
  return true;
}

bool ReferenceFollower::note(const tasks::Progress& progress) {
  progress_ = progress;
  if (leg_.course != Course::line || !progress.done) return false;
  leg_.course = leg_.vertical == tasks::Vertical::depth && leg_.level < surface ? Course::station : Course::circle;
  leg_.radius = radius_on(leg_.course, radius_);
  return true;
}

bool ReferenceFollower::is_late(Duration now) const { return timeout_ > 0 && seconds(now - heard_) > timeout_; }

imc::FollowRefState ReferenceFollower::state() const {
  using State = imc::FollowRefState::State;
  using Proximity = imc::FollowRefState::Proximity;
  imc::FollowRefState report;
  report.control_src = source_;
  report.control_ent = entity_;
  if (heard_any_ && !messages::put_inline(messages::refer_to(reference_), report.reference)) report.reference = {};
  switch (leg_.course) {
    case Course::line: report.state = State::GOTO; break;
    case Course::circle: report.state = progress_.levelled ? State::LOITER : State::ELEVATOR; break;
    case Course::station: report.state = State::HOVER; break;
    case Course::rest:
    case Course::fix:
    case Course::none: report.state = State::WAIT; break;
  }
  const bool there = leg_.course == Course::circle || leg_.course == Course::station;
  report.proximity = static_cast<std::uint8_t>((there ? Proximity::XY_NEAR : Proximity::FAR) |
                                               (progress_.levelled ? Proximity::Z_NEAR : 0));
  return report;
}

}  // namespace jarol::distributers
