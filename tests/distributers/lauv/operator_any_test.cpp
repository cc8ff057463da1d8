// Whatever a console sends, what is commanded lies within the limits.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

// Messages of a console, with numbers that are right, wrong, or none.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }
  // Of that form, with messages within messages.
  messages::Message make(std::uint32_t id, int depth = 0) {
    messages::Message made(*imc::message_set().find(id, 0));
    for (const messages::FieldDescriptor& field : made.descriptor()->fields) {
      auto* const to = static_cast<std::byte*>(made.value()) + field.offset;
      if (field.wire == messages::Wire::fp32) {
        const auto number = static_cast<float>(pick(field.name));
        std::memcpy(to, &number, sizeof number);
      } else if (field.wire == messages::Wire::fp64) {
        const double number = pick(field.name);
        std::memcpy(to, &number, sizeof number);
      } else if (field.wire == messages::Wire::message && depth < 4) {
        *reinterpret_cast<messages::InlineMessage*>(to) = inside(field.name, depth);
      } else if (field.wire == messages::Wire::message_list && depth < 4) {
        auto& list = *reinterpret_cast<Sequence<messages::InlineMessage>*>(to);
        for (std::size_t k = below(3); k > 0; --k) list.push_back(inside(field.name, depth));
      } else if (field.wire == messages::Wire::plaintext && field.name != "custom") {
        *reinterpret_cast<String*>(to) = field.name == "actions" ? hand() : below(8) == 0 ? "other" : "m";
      } else if (messages::size_of(field.wire) == 1) {
        *to = static_cast<std::byte>(below(12) == 0 ? 255 : below(4));
      } else if (messages::size_of(field.wire) == 2) {
        const auto number = static_cast<std::uint16_t>(below(3) == 0 ? 0 : below(300));
        std::memcpy(to, &number, sizeof number);
      }
    }
    return made;
  }
  std::uint32_t any_maneuver() {
    constexpr std::uint32_t ids[] = {imc::Goto::message_id,          imc::FollowPath::message_id,
                                     imc::Rows::message_id,          imc::Loiter::message_id,
                                     imc::YoYo::message_id,          imc::StationKeeping::message_id,
                                     imc::Elevator::message_id,      imc::PopUp::message_id,
                                     imc::Teleoperation::message_id, imc::FollowReference::message_id,
                                     imc::IdleManeuver::message_id};
    return ids[below(std::size(ids))];
  }

 private:
  messages::InlineMessage inside(std::string_view where, int depth) {
    const std::uint32_t id = where == "points"                 ? imc::PathPoint::message_id
                             : where == "maneuvers"            ? imc::PlanManeuver::message_id
                             : where == "speed"                ? imc::DesiredSpeed::message_id
                             : where == "z"                    ? imc::DesiredZ::message_id
                             : where == "arg" && below(2) == 0 ? imc::PlanSpecification::message_id
                             : where == "data" || where == "maneuver" || where == "arg" ? any_maneuver()
                                                                                        : messages::InlineMessage::none;
    messages::InlineMessage to;
    if (id != messages::InlineMessage::none) REQUIRE(messages::put_inline(make(id, depth + 1), to));
    return to;
  }
  double pick(std::string_view name) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double wrong[] = {0, -1, 1e30, -1e30, infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), 1e-40};
    if (below(30) == 0) return wrong[below(std::size(wrong))];
    const double share = static_cast<double>(below(1000)) / 1000;
    if (name == "lat") return origin.latitude + 1e-5 * share;
    if (name == "lon") return origin.longitude + 1e-5 * share;
    if (name == "pitch") return 0.7 * share;
    return (below(5) == 0 ? 100 : 3) * share;
  }
  const char* hand() {
    constexpr const char* all[] = {"Thrust=127",
                                   "Thrust=-127;Heading=1e9",
                                   "Heading=-127;Accelerate=1",
                                   "Decelerate=1",
                                   "Thrust=nan;Heading=inf",
                                   "Exit=1",
                                   "Stop=1",
                                   "Thrust=1e308"};
    return all[below(std::size(all))];
  }
  std::mt19937 random_;
};

bool is_within(const tasks::Setpoint& s) {
  return s.depth >= 0 && s.depth <= 11.5 && s.speed >= 0 && std::isfinite(s.speed) && std::abs(s.thrust) <= 1 &&
         std::isfinite(s.heading) && std::isfinite(s.rate);
}

bool is_within(const tasks::Leg& leg) {
  const bool by_depth = leg.vertical == tasks::Vertical::depth, up_and_down = leg.amplitude != 0;
  const bool level =
      by_depth ? leg.level >= 0 && leg.level + leg.amplitude <= 11.5 + 1e-4 : leg.level - leg.amplitude >= 2.5 - 1e-4;
  return level && std::hypot(leg.north, leg.east) <= 100e3 && std::abs(leg.radius) <= 1000.1 && leg.duration >= 0 &&
         leg.surge >= 0 && leg.surge <= 2.001 && leg.thrust >= 0 && leg.thrust <= 1 && std::isfinite(leg.turn) &&
         (!up_and_down || (leg.amplitude > 0 && leg.slope > 0 && leg.slope <= 0.8));
}
}  // namespace

TEST_SUITE("distributers/lauv/operator_any") {
  TEST_CASE("whatever numbers a console sends, what is commanded is within the limits") {
    constexpr std::uint32_t ids[] = {imc::DesiredZ::message_id,
                                     imc::DesiredHeading::message_id,
                                     imc::DesiredHeadingRate::message_id,
                                     imc::DesiredSpeed::message_id,
                                     imc::RemoteActions::message_id,
                                     imc::PlanControl::message_id,
                                     imc::PlanDB::message_id,
                                     imc::VehicleCommand::message_id,
                                     imc::Reference::message_id,
                                     imc::TeleoperationDone::message_id,
                                     imc::Abort::message_id,
                                     imc::SetServoPosition::message_id,
                                     imc::SetThrusterActuation::message_id};
    std::size_t plans = 0, legs = 0, setpoints = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Chance chance(seed);
      Conversation c;
      tasks::Leg leg;
      for (int k = 0; k < 2000; ++k) {
        // every second one a maneuver, so that many are flown
        if (chance.below(2) == 0) {
          imc::PlanControl start;
          REQUIRE(messages::put_inline(chance.make(chance.any_maneuver()), start.arg));
          c.say(start);
        } else {
          const messages::Message any = chance.make(ids[chance.below(std::size(ids))]);
          c.adapter.receive(any);
        }
        c.report({.depth = static_cast<double>(chance.below(3)),
                  .alarm = chance.below(50) == 0 ? tasks::Alarm::leak : tasks::Alarm::none});
        c.pass(chance.below(20) == 0 ? 1100ms : 50ms);
        const tasks::Setpoint setpoint = c.setpoint();
        setpoints += setpoint.speed > 0 || setpoint.thrust != 0 ? 1 : 0;
        CAPTURE(seed);
        CAPTURE(k);
        REQUIRE(is_within(setpoint));
        if (c.adapter.take<&LauvOperator::In::leg>(leg)) {
          legs += leg.course != tasks::Course::none ? 1 : 0;
          REQUIRE(is_within(leg));
        }
        c.adapter.hand_over<&LauvOperator::Out::progress>({.on_leg = leg.number, .done = chance.below(3) == 0}, c.to);
        for (const auto& reply : c.to.all<imc::PlanControl>())
          plans += reply.type == imc::PlanControl::Type::SUCCESS ? 1 : 0;
        c.to.got.clear();
      }
    }
    CHECK(plans > 1000);
    CHECK(legs > 1000);
    CHECK(setpoints > 1000);
  }
}
