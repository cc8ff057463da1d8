// What the supervisor says of fins that have failed, where they end no dive.
#include <doctest/doctest.h>

#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::calm_submarine;
using tests::every_50_ms;
}  // namespace

TEST_SUITE("tasks/lauv_supervisor_fins") {
  TEST_CASE("it goes on without a fin that is stuck or silent where its parameter says so, and says without which") {
    constexpr FinCheck failed[] = {FinCheck::bottom_failed, FinCheck::port_failed, FinCheck::starboard_failed,
                                   FinCheck::top_failed};
    for (std::size_t fin = 0; fin < 4; ++fin)
      for (const FinState is : {FinState::stuck, FinState::silent}) {
        LauvSupervisor::State state;
        LauvSupervisor::Out out;
        LauvSupervisor::In in = calm_submarine(1);
        in.fins.states = {FinState::follows, FinState::follows, FinState::follows, FinState::follows};
        in.fins.states[fin] = is;
        LauvSupervisor::run({.fins_end_dive = false}, every_50_ms, in, state, out);
        CHECK(out.condition.alarm == Alarm::none);
        CHECK(out.condition.fins == failed[fin]);
        CHECK(out.setpoint.depth == in.setpoint.depth);
        in.fins.states[(fin + 1) % 4] = is;
        LauvSupervisor::run({.fins_end_dive = false}, every_50_ms, in, state, out);
        CHECK(out.condition.fins == FinCheck::several_failed);
        in.fins.states = {FinState::follows, FinState::follows, FinState::follows, FinState::follows};
        LauvSupervisor::run({.fins_end_dive = false}, every_50_ms, in, state, out);
        CHECK(out.condition.fins == FinCheck::checked);
      }
  }

  TEST_CASE("it says so with the next reading of the voltage, and not where a flat battery stops the servos") {
    for (const bool flat : {false, true}) {
      LauvSupervisor::State state;
      LauvSupervisor::Out out;
      const auto step = [&](std::int64_t voltages, FinState fin) {
        LauvSupervisor::In in = calm_submarine(1);
        in.instruments.voltage = {flat && fin == FinState::stuck ? 5.0 : in.instruments.voltage.value, voltages};
        in.fins.states = {fin, FinState::follows, FinState::follows, FinState::follows};
        LauvSupervisor::run({.fins_end_dive = false}, every_50_ms, in, state, out);
        return out.condition.fins;
      };
      CHECK(step(7, FinState::follows) == FinCheck::checked);
      CHECK(step(7, FinState::stuck) == FinCheck::checked);
      CHECK(step(8, FinState::stuck) == (flat ? FinCheck::checked : FinCheck::bottom_failed));
      CHECK(out.condition.alarm == (flat ? Alarm::voltage_limit : Alarm::none));
    }
  }
}
