// Fields of messages to bytes and back: nesting, lists, limits.
#include "distributers/messages/payload.h"

#include <doctest/doctest.h>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/messages/recorded.h"

using namespace jarol;
using namespace jarol::messages;

namespace {

std::string written(MessageRef message, ByteOrder order = ByteOrder::little) {
  std::vector<std::byte> bytes;
  std::string why;
  return write_payload(message, order, bytes, &why) ? hex_of(bytes) : why;
}

template <class M>
std::string complaint(const std::string& hex) {
  M message;
  std::string why;
  return read_payload(M::descriptor, ByteOrder::little, bytes_of(hex), &message, &why) ? "" : why;
}

template <class M>
InlineMessage inlined(const M& message) {
  InlineMessage made;
  REQUIRE(put_inline(refer_to(message), made));
  return made;
}

}  // namespace

TEST_SUITE("distributers/messages/payload") {
  TEST_CASE("a nested message is its id and its fields, in the order of the packet") {
    imc::Reference reference;
    reference.flags = imc::Reference::Flags::SPEED | imc::Reference::Flags::Z;
    reference.speed = inlined(imc::DesiredSpeed{1.0, imc::SpeedUnits::METERS_PS});
    reference.lat = 0.5;
    const std::string tail =
        "000000000000e03f"
        "0000000000000000"
        "00000000";
    CHECK(written(refer_to(reference)) ==
          "06"
          "9201"
          "000000000000f03f00"
          "ffff" +
              tail);
    CHECK(written(refer_to(reference), ByteOrder::big) ==
          "06"
          "0192"
          "3ff000000000000000"
          "ffff"
          "3fe0000000000000"
          "0000000000000000"
          "00000000");

    imc::Reference back;
    REQUIRE(read_payload(imc::Reference::descriptor, ByteOrder::big,
                         bytes_of(written(refer_to(reference), ByteOrder::big)), &back));
    CHECK(back.z.empty());
    Message speed;
    REQUIRE(take_inline(imc::message_set(), back.speed, speed));
    REQUIRE(speed.as<imc::DesiredSpeed>() != nullptr);
    CHECK(speed.as<imc::DesiredSpeed>()->value == 1.0);
  }

  TEST_CASE("lists of messages with lists of messages come back as they were, in both orders") {
    imc::PlanManeuver maneuver;
    maneuver.maneuver_id = "m1";
    imc::Goto there;
    there.z = 2.0F;
    there.custom = "a=1";
    maneuver.data = inlined(there);
    maneuver.start_actions.push_back(inlined(imc::Heartbeat{}));
    imc::PlanSpecification plan;
    plan.plan_id = "p";
    plan.maneuvers.push_back(inlined(maneuver));
    plan.maneuvers.push_back(inlined(maneuver));
    for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
      imc::PlanSpecification back;
      const std::vector<std::byte> bytes = bytes_of(written(refer_to(plan), order));
      REQUIRE(read_payload(imc::PlanSpecification::descriptor, order, bytes, &back));
      CHECK(written(refer_to(back), order) == hex_of(bytes));
      REQUIRE(back.maneuvers.size() == 2);
      CHECK(back.maneuvers[1] == plan.maneuvers[1]);
    }
  }

  TEST_CASE("a message that may not stand in a field is refused, read or written") {
    imc::Reference reference;
    reference.z = inlined(imc::DesiredSpeed{});
    CHECK(written(refer_to(reference)) == "field 'z' of Reference holds DesiredSpeed, which is no DesiredZ");
    CHECK(complaint<imc::Reference>("00ffff9201") == "field 'z' of Reference holds DesiredSpeed, which is no DesiredZ");
    imc::VehicleCommand command;
    command.maneuver = inlined(imc::Abort{});
    CHECK(written(refer_to(command)) == "field 'maneuver' of VehicleCommand holds Abort, which is no Maneuver");
    CHECK(
        complaint<imc::Reference>("000f27") ==
        "field 'speed' of Reference holds message id 9999, which is not in the set or can't stand in another message");
    reference.z.payload.pop_back();
    reference.z.id = imc::DesiredZ::message_id;
    reference.z.payload.resize(4);
    CHECK(
        written(refer_to(reference)) ==
        "field 'z' of Reference holds a message that can't be read: field 'z_units' of DesiredZ needs 1 bytes where 0 "
        "are left");
    reference.z.payload.resize(7);
    CHECK(written(refer_to(reference)) == "field 'z' of Reference holds DesiredZ with 2 bytes too many");
  }

  TEST_CASE("every length is held against what is there and what can be sent") {
    CHECK(complaint<imc::EntityState>("0000"
                                      "0500"
                                      "61") == "field 'description' of EntityState needs 5 bytes where 1 are left");
    CHECK(complaint<imc::EntityState>("0000"
                                      "05") == "field 'description' of EntityState needs 2 bytes where 1 are left");
    CHECK(complaint<imc::EntityState>("0000"
                                      "0100"
                                      "6162") == "EntityState has 5 bytes of fields, but 6 of payload");
    CHECK(complaint<imc::Distance>("00"
                                   "0100"
                                   "ff") == "field 'location' of Distance needs 2 bytes where 1 are left");
    CHECK(complaint<imc::Distance>("00"
                                   "ffff"
                                   "ffffffff") == "field 'location' of Distance needs 131070 bytes where 4 are left");

    imc::TransmissionRequest request;
    request.raw_data.resize(65536);
    CHECK(written(refer_to(request)) ==
          "field 'raw_data' of TransmissionRequest has 65536 bytes; at most 65535 can be sent");
    imc::Distance distance;
    distance.location.resize(65536);
    CHECK(written(refer_to(distance)) == "field 'location' of Distance has 65536 messages; at most 65535 can be sent");
  }

  TEST_CASE("messages are nested sixteen deep, and no deeper") {
    imc::PlanControl outer;
    for (int depth = 0; depth < 16; ++depth) {
      imc::PlanControl next;
      next.arg = inlined(outer);
      outer = next;
    }
    const std::vector<std::byte> bytes = bytes_of(written(refer_to(outer)));
    imc::PlanControl back;
    CHECK(read_payload(imc::PlanControl::descriptor, ByteOrder::little, bytes, &back));
    imc::PlanControl too_deep;
    InlineMessage sixteen;
    REQUIRE(put_inline(refer_to(outer), sixteen));
    too_deep.arg = sixteen;
    const std::string why = written(refer_to(too_deep));
    CHECK(why.ends_with("field 'arg' of PlanControl is nested deeper than 16 messages"));
  }

  TEST_CASE("what failed leaves the bytes before it alone") {
    imc::Reference reference;
    reference.z = inlined(imc::DesiredSpeed{});
    std::vector<std::byte> bytes(3);
    CHECK(!write_payload(refer_to(reference), ByteOrder::little, bytes));
    CHECK(bytes.size() == 3);
  }

  TEST_CASE("the members of a report's parts follow one another") {
    javiator::GroundReport report;
    report.sensors.roll = 1;
    report.signals.id = 2;
    report.state_mode.mode = javiator::StateMode::Mode::POSITION;
    const std::string hex = written(refer_to(report), ByteOrder::big);
    CHECK(hex.size() == 2 * 62);
    CHECK(hex.substr(0, 4) == "0001");
    CHECK(hex.substr(2 * 50, 4) == "0002");
    CHECK(hex.substr(2 * 61) == "02");
  }

  TEST_CASE("a message is a value: it has a type, and is copied with all that it holds") {
    CHECK(type_of<imc::SimulatedState>().fields.size() == 18);
    CHECK(!type_of<imc::SimulatedState>().is_deep());
    CHECK(type_of<imc::Announce>().is_deep());
    imc::Announce announce;
    announce.sys_name = "lauv";
    const Message copy(refer_to(announce));
    announce.sys_name = "";
    CHECK(copy.as<imc::Announce>()->sys_name == "lauv");
  }
}
