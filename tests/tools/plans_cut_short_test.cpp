// Plans that end in the middle: by an abort, by another console, by water in the hull.
#include <doctest/doctest.h>

#include <string>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"
#include "tests/tools/lauv_mission.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using test::Mission;
using Last = imc::PlanControlState::LastOutcome;
using State = imc::PlanControlState::State;

imc::PlanControl start_rows() {
  imc::Rows rows;
  rows.lat = origin.latitude;
  rows.lon = origin.longitude;
  rows.z = 3;
  rows.z_units = imc::ZUnits::DEPTH;
  rows.speed = 1.2F;
  rows.length = 60;
  rows.width = 60;
  rows.hstep = 20;
  rows.alternation = 100;
  imc::PlanControl request;
  request.plan_id = "rows";
  request.arg = packed(rows);
  return request;
}

// Its answer: why not, or nothing.
std::string start(Mission& mission) {
  mission.say(start_rows());
  mission.fly(100ms);
  return std::string(mission.console.to.last<imc::PlanControl>().info.view());
}

// In the middle of the rows, at depth.
void fly_into_rows(Mission& mission) {
  CHECK(start(mission) == "");
  CHECK_FALSE(mission.fly(50s, [&] { return mission.is_over(); }));
  CHECK(mission.truth("depth") > 2.5);
}

bool comes_up(Mission& mission) {
  return mission.fly(200s, [&] { return mission.truth("depth") < 0.3; });
}
}  // namespace

TEST_SUITE("tools/plans_cut_short") {
  TEST_CASE("an abort in the middle of rows ends them, it comes up, and the rows are flown anew when they are wanted") {
    Mission mission;
    fly_into_rows(mission);
    mission.say(imc::Abort{});
    mission.fly(100ms);
    CHECK(mission.plan().state == State::BLOCKED);
    CHECK(mission.plan().last_outcome == Last::FAILURE);
    CHECK(start(mission) == "just aborted");
    CHECK(comes_up(mission));
    CHECK(mission.alarm() == tasks::Alarm::none);
    CHECK(start(mission) == "");
    CHECK(mission.fly(600s, [&] { return mission.is_over(); }));
    CHECK(mission.plan().last_outcome == Last::SUCCESS);
  }

  TEST_CASE("water in the hull ends a plan; no other begins, and no stop has it forgotten, while there is any") {
    Mission mission({"distributers.dune.link.parameters.leak_at=60 s"});
    fly_into_rows(mission);
    CHECK(mission.fly(20s, [&] { return mission.is_over(); }));
    for (const bool stopped : {false, true}) {
      if (stopped) {
        imc::PlanControl stop;
        stop.op = imc::PlanControl::Op::STOP;
        mission.say(stop);
        mission.fly(1s);
      }
      CHECK(mission.alarm() == tasks::Alarm::leak);
      CHECK(mission.plan().last_outcome == Last::FAILURE);
      CHECK(mission.plan().state == State::BLOCKED);
      CHECK(mission.console.to.last<imc::VehicleState>().control_loops == 0);
      CHECK(start(mission) == "the vehicle comes up: leak");
    }
    CHECK(comes_up(mission));
  }

  TEST_CASE("the plan of another console takes the place of that which is flown, and its stop ends it") {
    Mission mission;
    fly_into_rows(mission);
    const auto say_as = [&](std::uint16_t system, const auto& message) {
      const imc::Header header{.timestamp = seconds(mission.now()), .src = system};
      messages::MessageRef made = messages::refer_to(message);
      made.header = &header;
      mission.console.adapter.receive(made);
      mission.fly(100ms);
      return mission.console.to.last<imc::PlanControl>().type == imc::PlanControl::Type::SUCCESS;
    };
    auto other = start_rows();
    other.plan_id = "other";
    CHECK(say_as(0x4002, other));
    CHECK(mission.plan().plan_id == "other");
    CHECK(mission.plan().state == State::EXECUTING);
    other.op = imc::PlanControl::Op::STOP;
    CHECK(say_as(0x4001, other));
    CHECK(mission.plan().state == State::READY);
    CHECK(comes_up(mission));
  }
}
