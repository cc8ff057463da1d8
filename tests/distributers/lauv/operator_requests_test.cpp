// Requests that come twice, that hold what can't be read, or that come while the run ends.
#include <doctest/doctest.h>

#include "distributers/messages/packet.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

constexpr const char* run_ends = "the run is ending: the vehicle is brought to rest";

imc::Goto ahead() {
  imc::Goto m;
  m.lat = origin.latitude + 1e-5;
  m.lon = origin.longitude;
  m.z = 3;
  m.z_units = imc::ZUnits::DEPTH;
  m.speed = 1;
  return m;
}

// A console whose packets have a header, as over a link.
struct Sender : Conversation {
  template <class M>
  void send(const M& message, double time, std::uint16_t source = 0x4001) {
    const imc::Header header{.timestamp = time, .src = source, .src_ent = 7};
    messages::MessageRef made = messages::refer_to(message);
    made.header = &header;
    adapter.receive(made);
    pass(50ms);
  }
  imc::PlanControl control(std::uint8_t op) const {
    imc::PlanControl request;
    request.op = op;
    request.request_id = 21;
    request.plan_id = "there";
    if (op == imc::PlanControl::Op::START) request.arg = packed(ahead());
    return request;
  }
  void start(double time, std::uint16_t source = 0x4001) { send(control(imc::PlanControl::Op::START), time, source); }
  void stop(double time) { send(control(imc::PlanControl::Op::STOP), time); }
  std::size_t begun() const {
    std::size_t count = 0;
    for (const auto& entry : to.all<imc::LogBookEntry>()) count += entry.text == "plan 'there' begins" ? 1 : 0;
    return count;
  }
  bool flies() {
    adapter.take<&LauvOperator::In::leg>(leg);
    return leg.course != tasks::Course::none;
  }
  tasks::Leg leg;
};
}  // namespace

TEST_SUITE("distributers/lauv/operator_requests") {
  TEST_CASE("a request that comes twice is answered twice and obeyed once, after a stop and an abort too") {
    Sender c;
    c.start(100);
    CHECK(c.flies());
    c.stop(101);
    CHECK_FALSE(c.flies());
    const std::size_t answers = c.to.all<imc::PlanControl>().size();
    c.start(100);
    CHECK_FALSE(c.flies());
    const auto all = c.to.all<imc::PlanControl>();
    REQUIRE(all.size() == answers + 1);
    CHECK(all.back().type == imc::PlanControl::Type::SUCCESS);
    CHECK(all.back().op == imc::PlanControl::Op::START);
    CHECK(all.back().request_id == 21);
    CHECK(c.begun() == 1);
    c.start(102);
    CHECK(c.flies());
    c.stop(101);  // the first one, again
    CHECK(c.flies());
    c.say(imc::Abort{});
    c.pass(2s);
    c.start(102);
    CHECK_FALSE(c.flies());
    CHECK(c.begun() == 2);
    c.start(103);  // a number that is used again, as after a restart of the console
    CHECK(c.flies());
    c.stop(104);
    c.start(103, 0x4002);  // another console's
    CHECK(c.flies());
    CHECK(c.begun() == 4);
  }

  TEST_CASE("a change of the stored plans that comes twice changes them once") {
    Sender c;
    const auto request = [](std::uint8_t op) {
      imc::PlanDB made;
      made.op = op;
      made.request_id = 5;
      made.plan_id = "p";
      imc::PlanManeuver named;
      named.maneuver_id = "m";
      named.data = packed(ahead());
      imc::PlanSpecification plan;
      plan.start_man_id = "m";
      plan.maneuvers.push_back(packed(named));
      if (op == imc::PlanDB::Op::SET) made.arg = packed(plan);
      return made;
    };
    using Op = imc::PlanDB::Op;
    const auto is_stored = [&](double time) {
      c.send(request(Op::GET), time);
      return c.to.last<imc::PlanDB>().type == imc::PlanDB::Type::SUCCESS;
    };
    c.send(request(Op::SET), 1);
    CHECK(is_stored(9));
    c.send(request(Op::DEL), 2);
    c.send(request(Op::SET), 1);
    CHECK(c.to.last<imc::PlanDB>().type == imc::PlanDB::Type::SUCCESS);
    CHECK_FALSE(is_stored(9));  // what only asks is answered anew
    c.send(request(Op::SET), 3);
    c.send(request(Op::DEL), 2);
    CHECK(is_stored(9));
  }

  TEST_CASE("what was refused is refused again, with the same reason; a vehicle command is obeyed once too") {
    Sender c;
    c.send(c.control(imc::PlanControl::Op::GET), 5);
    c.start(6);
    imc::PlanControl load = c.control(imc::PlanControl::Op::LOAD);
    load.arg = packed(imc::PlanSpecification{});
    c.send(load, 7);
    c.send(c.control(imc::PlanControl::Op::GET), 5);
    CHECK(c.to.last<imc::PlanControl>().info == "no plan is loaded");
    imc::VehicleCommand command;
    command.request_id = 3;
    command.maneuver = packed(ahead());
    c.send(command, 8);
    CHECK(c.flies());
    c.stop(9);
    c.send(command, 8);
    CHECK_FALSE(c.flies());
    CHECK(c.to.last<imc::VehicleCommand>().type == imc::VehicleCommand::Type::SUCCESS);
    CHECK(c.to.last<imc::VehicleCommand>().request_id == 3);
  }

  TEST_CASE("where packets state no time each request is obeyed") {
    Sender c;
    c.start(0);
    c.stop(0);
    c.start(0);
    CHECK(c.flies());
    CHECK(c.begun() == 2);
  }

  TEST_CASE("a path whose points are other messages comes through a link, and is refused with the reason") {
    imc::FollowPath path;
    path.lat = origin.latitude;
    path.lon = origin.longitude;
    path.speed = 1;
    path.points.push_back(packed(imc::PathPoint{30, 5, 1}));
    imc::PlanControl request;
    request.plan_id = "path";
    request.arg = packed(path);
    // the point's id and its three numbers, before an empty text
    auto& bytes = request.arg.payload;
    std::vector<std::uint8_t> changed(bytes.begin(), bytes.end());
    changed.erase(changed.end() - 14, changed.end() - 2);
    changed[changed.size() - 4] = imc::Abort::message_id & 0xff;
    changed[changed.size() - 3] = imc::Abort::message_id >> 8;
    bytes.resize(changed.size());
    std::copy(changed.begin(), changed.end(), bytes.begin());
    std::vector<std::byte> packet;
    const imc::Header header{.timestamp = 1, .src = 0x4001};
    REQUIRE(messages::write_packet(messages::refer_to(header), messages::refer_to(request), messages::ByteOrder::little,
                                   packet));
    messages::PacketReader reader(imc::message_set());
    std::string why;
    REQUIRE(reader.read(packet, &why) == messages::PacketError::none);
    Conversation c;
    c.adapter.receive(reader.message());
    c.pass(50ms);
    CHECK(c.to.last<imc::PlanControl>().type == imc::PlanControl::Type::FAILURE);
    CHECK(c.to.last<imc::PlanControl>().info ==
          "it can't be read: field 'points' of FollowPath holds Abort, which is no PathPoint");
  }

  TEST_CASE("while the run ends a plan fails and none begins; a stop or an abort is obeyed in place of the graph") {
    for (const bool abort : {false, true}) {
      CAPTURE(abort);
      Sender c;
      c.start(1);
      c.adapter.ending();
      CHECK_FALSE(c.flies());
      c.pass(50ms);
      const auto state = c.to.last<imc::PlanControlState>();
      CHECK(state.state == imc::PlanControlState::State::READY);
      CHECK(state.last_outcome == imc::PlanControlState::LastOutcome::FAILURE);
      CHECK(c.to.last<imc::VehicleState>().last_error == run_ends);
      CHECK(c.to.last<imc::LogBookEntry>().text.view() == std::string("plan 'there' ends: ") + run_ends);
      c.start(2);
      CHECK_FALSE(c.flies());
      CHECK(c.to.last<imc::PlanControl>().type == imc::PlanControl::Type::FAILURE);
      CHECK(c.to.last<imc::PlanControl>().info == run_ends);
      CHECK_FALSE(c.adapter.overrides_end());
      c.adapter.take<&LauvOperator::In::setpoint>(c.value);
      if (abort)
        c.say(imc::Abort{});
      else
        c.stop(3);
      CHECK(c.adapter.overrides_end());
      tasks::Setpoint value{.depth = 1, .speed = 1};
      CHECK(c.adapter.take<&LauvOperator::In::setpoint>(value));
      check(value, {});
      c.pass(2s);
      c.start(4);
      CHECK(c.to.last<imc::PlanControl>().info == run_ends);
    }
    Sender stopped_before;
    stopped_before.stop(1);
    stopped_before.adapter.ending();
    CHECK_FALSE(stopped_before.adapter.overrides_end());
  }
}
