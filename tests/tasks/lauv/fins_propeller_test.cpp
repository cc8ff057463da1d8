// A propeller that does not turn as it is sent: found by FinWatch, and answered by the supervisor.
#include <doctest/doctest.h>

#include "tasks/lauv/fins.h"
#include "tasks/lauv/supervisor.h"
#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::calm_submarine;
using tests::every_50_ms;

struct TurningPropeller {
  FinWatch::Param param{};
  FinWatch::State state{};
  FinWatch::In in{};
  FinWatch::Out out{};

  void step() { FinWatch::run(param, every_50_ms, in, state, out); }
};
}  // namespace

TEST_SUITE("tasks/lauv_propeller") {
  TEST_CASE(
      "a propeller that turns by a third of its full speed otherwise than it is sent is stuck, but not before others "
      "may have found that its speed is reported wrong") {
    const auto found_after = [](double commanded, double rpm, int every = 1) {
      TurningPropeller w;
      for (int step = 0; step < 400; ++step) {
        if (step % every == 0) w.in.servos.propeller = {rpm, commanded, w.in.servos.propeller.count + 1};
        w.step();
        if (w.out.fins.propeller == FinState::stuck) return step * 0.05;
      }
      CHECK(w.out.fins.propeller == FinState::follows);
      return 0.0;
    };
    CHECK(found_after(0.48, 0) == doctest::Approx(8.05));      // at 1.2 m/s and lost
    CHECK(found_after(0, 1200) == doctest::Approx(8.05));      // it can't be stopped
    CHECK(found_after(0.48, -2500) == doctest::Approx(8.05));  // full astern
    CHECK(found_after(-1, 2500) == doctest::Approx(8.05));
    CHECK(found_after(0.48, 0, 4) == doctest::Approx(8.1).scale(0).epsilon(0.015));  // by 5 readings a second as by 20
    CHECK(found_after(0.48, 1200) == 0);
    CHECK(found_after(-0.6, -1500) == 0);
    CHECK(found_after(0.3, 0) == 0);          // too slow to tell
    CHECK(found_after(1, 0.71 * 2500) == 0);  // it gives half its thrust, and drives on
  }

  TEST_CASE("a propeller that gets up its speed late is not stuck; one whose speed is not reported is not checked") {
    TurningPropeller w;
    double speed = 0;
    for (int step = 0; step < 4000; ++step) {
      const double commanded = (step / 200) % 2 == 0 ? 1 : -1;  // every 10 s the other way
      speed += 0.05 / 3 * (2500 * commanded - speed);           // in 3 s
      w.in.servos.propeller = {speed, commanded, step + 1};
      w.step();
      CHECK(w.out.fins.propeller == FinState::follows);
    }
    // told each second, half a second late, while it is sent the other way each second
    TurningPropeller late;
    for (int step = 0; step < 2000; ++step) {
      const double commanded = (step / 20) % 2 == 0 ? 0.6 : -0.6;
      if (step % 20 == 10) late.in.servos.propeller = {-2500 * commanded, commanded, step + 1};
      late.step();
      CHECK(late.out.fins.propeller != FinState::stuck);
    }
    w.in.servos.propeller = {speed, speed > 0 ? -1.0 : 1.0, w.in.servos.propeller.count};
    for (int step = 0; step < 400; ++step) w.step();
    CHECK(w.out.fins.propeller == FinState::follows);
    TurningPropeller unheard;
    unheard.in.servos.propeller = {0, 1, 0};
    for (int step = 0; step < 400; ++step) unheard.step();
    CHECK(unheard.out.fins.propeller == FinState::unknown);
  }

  TEST_CASE("a stuck propeller stays stuck until the operator stops everything: then it is tried anew") {
    TurningPropeller w;
    const auto turn = [&](double commanded, double rpm, int steps) {
      for (int i = 0; i < steps; ++i) {
        w.in.servos.propeller = {rpm, commanded, w.in.servos.propeller.count + 1};
        w.step();
      }
      return w.out.fins.propeller;
    };
    CHECK(turn(0.5, 0, 200) == FinState::stuck);
    CHECK(turn(0, 0, 400) == FinState::stuck);
    w.in.contact.stops = 1;
    CHECK(turn(0, 0, 400) == FinState::follows);
    CHECK(turn(0.5, 0, 200) == FinState::stuck);
  }

  TEST_CASE("a propeller that does not turn as it is sent brings it up by buoyancy, the propeller off") {
    // after a second in which it was sound, one step
    const auto with = [](FinState state, double voltage) {
      LauvSupervisor::State at;
      LauvSupervisor::Out out;
      for (int k = 1; k <= 21; ++k) {
        LauvSupervisor::In in = calm_submarine(k);
        if (k == 21) in.fins.propeller = state;
        if (k == 21) in.instruments.voltage.value = voltage;
        LauvSupervisor::run({}, every_50_ms, in, at, out);
      }
      return out;
    };
    constexpr double full = 25;
    const auto out = with(FinState::stuck, full);
    CHECK(out.condition.alarm == Alarm::propeller);
    CHECK(out.setpoint.depth == 0);
    CHECK(out.setpoint.speed == 0);
    for (const FinState state : {FinState::unknown, FinState::follows})
      CHECK(with(state, full).condition.alarm == Alarm::none);
    // that of a flat battery is not blamed
    CHECK(with(FinState::stuck, 0).condition.alarm == Alarm::voltage_limit);
  }
}
