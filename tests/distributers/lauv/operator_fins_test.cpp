// What a console is sent while no fin is checked, or one has failed, as it stands in packets.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "distributers/messages/packet.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using tasks::FinCheck;

// What goes out, written as a packet and read again: a line of each log book entry and state of an entity.
struct PacketLines : messages::Receiver {
  void receive(messages::MessageRef message) override {
    const imc::Header none;
    const auto* const its = static_cast<const imc::Header*>(message.header);
    std::vector<std::byte> packet;
    REQUIRE(write_packet(messages::refer_to(its == nullptr ? none : *its), message, imc::message_set().order, packet));
    REQUIRE(reader.read(packet) == messages::PacketError::none);
    const messages::MessageRef read = reader.message();
    const std::string who = std::to_string(static_cast<const imc::Header*>(read.header)->src_ent) + ": ";
    if (const auto* entry = read.as<imc::LogBookEntry>())
      lines.push_back(who + "entry " + std::to_string(entry->type) + " " + std::string(entry->text.view()));
    if (const auto* state = read.as<imc::EntityState>())
      lines.push_back(who + "state " + std::to_string(state->state) + " " + std::string(state->description.view()));
  }
  messages::PacketReader reader{imc::message_set()};
  std::vector<std::string> lines;
};

// A vehicle that reports ten times a second, to one console.
struct Reporting {
  void pass(Duration time, const tasks::VehicleReport& report) {
    for (const Duration end = now + time; now < end; now += 100ms) {
      adapter.reach(now, to);
      adapter.hand_over<&LauvOperator::Out::report>(report, to);
    }
  }
  std::vector<std::string> take() { return std::exchange(to.lines, {}); }

  distributers::Typed<LauvOperator> adapter;
  PacketLines to;
  Duration now{};
};

const std::string unchecked = "no fin is checked, as no servo reports where it is";
using Lines = std::vector<std::string>;
}  // namespace

TEST_SUITE("distributers/lauv_operator_fins") {
  TEST_CASE("that no fin is checked is sent as a warning and as the supervisor's state, once while it lasts") {
    Reporting vehicle;
    vehicle.pass(2s, {});
    CHECK(vehicle.take().empty());
    vehicle.pass(20s, {.fins = FinCheck::unchecked});
    CHECK(vehicle.take() == Lines{"1: entry 1 " + unchecked, "2: state 2 " + unchecked});
    vehicle.pass(20s, {.fins = FinCheck::checked});
    CHECK(vehicle.take() == Lines{"1: entry 0 fins are checked again, as their servos report", "2: state 1 active"});
    vehicle.pass(1s, {.fins = FinCheck::unchecked});
    CHECK(vehicle.take() == Lines{"1: entry 1 " + unchecked, "2: state 2 " + unchecked});
  }

  TEST_CASE("so is a fin that has failed and ends no dive, by its name, another one, and that all are tried again") {
    Reporting vehicle;
    const std::string top = "the top rudder is stuck or its servo silent";
    const std::string several = "several fins are stuck or their servos silent";
    vehicle.pass(2s, {.fins = FinCheck::top_failed});
    CHECK(vehicle.take() == Lines{"1: entry 1 " + top, "2: state 2 " + top});
    vehicle.pass(2s, {.fins = FinCheck::several_failed});
    CHECK(vehicle.take() == Lines{"1: entry 1 " + several, "2: state 2 " + several});
    vehicle.pass(2s, {.fins = FinCheck::checked});
    CHECK(vehicle.take() == Lines{"1: entry 0 all fins are tried again", "2: state 1 active"});
    vehicle.pass(2s, {.fins = FinCheck::port_failed});
    vehicle.pass(2s, {.fins = FinCheck::unchecked});
    vehicle.take();
    vehicle.pass(2s, {.fins = FinCheck::checked});
    CHECK(vehicle.take() == Lines{"1: entry 0 fins are checked again, as their servos report", "2: state 1 active"});
  }

  TEST_CASE("whoever asks for states while no fin is checked gets that one; an alarm is before it") {
    Reporting vehicle;
    vehicle.pass(1s, {.fins = FinCheck::unchecked});
    vehicle.take();
    const auto supervisor = [&](const tasks::VehicleReport& report) {
      vehicle.adapter.receive(messages::refer_to(imc::QueryEntityState{}));
      vehicle.pass(100ms, report);
      const Lines lines = vehicle.take();
      REQUIRE(lines.size() >= 3);
      return lines[2];
    };
    CHECK(supervisor({.fins = FinCheck::unchecked}) == "2: state 2 " + unchecked);
    vehicle.pass(1s, {.alarm = tasks::Alarm::leak, .fins = FinCheck::unchecked});
    vehicle.take();
    CHECK(supervisor({.alarm = tasks::Alarm::leak, .fins = FinCheck::unchecked}) == "2: state 4 leak");
  }
}
