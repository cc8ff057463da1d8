#include "tasks/lauv/supervisor.h"

#include <doctest/doctest.h>

#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::calm_submarine;

using tests::every_50_ms;
const Setpoint wanted{3, 1.5, 1.2};

// After some seconds in which `change` spoils the instruments from the first second on.
template <class Change>
LauvSupervisor::Out after(double seconds, Change change) {
  LauvSupervisor::State state;
  LauvSupervisor::Out out;
  for (int k = 0; k < static_cast<int>(20 * seconds); ++k) {
    LauvSupervisor::In in = calm_submarine(k + 1);
    if (k >= 20) change(in);
    LauvSupervisor::run({}, every_50_ms, in, state, out);
  }
  return out;
}
}  // namespace

TEST_SUITE("tasks/lauv_supervisor") {
  TEST_CASE("while all is well the setpoint passes") {
    const auto out = after(30, [](LauvSupervisor::In&) {});
    CHECK(out.condition.alarm == Alarm::none);
    CHECK(out.setpoint.depth == 3);
    CHECK(out.setpoint.heading == 1.5);
    CHECK(out.setpoint.speed == 1.2);
  }

  TEST_CASE("an instrument that reports no more is lost after the time-out, not before") {
    const auto silent = [](LauvSupervisor::In& in) { in.instruments.depth.count = 20; };
    CHECK(after(3.3, silent).condition.alarm == Alarm::none);
    const auto out = after(4, silent);
    CHECK(out.condition.alarm == Alarm::depth_gauge);
    CHECK(out.setpoint.depth == -1000);
    CHECK(out.setpoint.speed == 1);
  }

  TEST_CASE("without attitude the propeller stops") {
    const auto out = after(4, [](LauvSupervisor::In& in) { in.instruments.attitude.count = 20; });
    CHECK(out.condition.alarm == Alarm::attitude);
    CHECK(out.setpoint.speed == 0);
  }

  TEST_CASE("a gauge that differs from the pressure alarms once it lasts") {
    const auto wrong = [](LauvSupervisor::In& in) { in.instruments.depth.value = 5.4; };
    CHECK(after(1.9, wrong).condition.alarm == Alarm::none);
    CHECK(after(2.3, wrong).condition.alarm == Alarm::depth_gauge);
    CHECK(after(30, [](LauvSupervisor::In& in) { in.instruments.depth.value = 5.2; }).condition.alarm == Alarm::none);
  }

  TEST_CASE("a fin that is stuck alarms with the next reading of the voltage, and not where a flat battery stops it") {
    // stuck for half a second after the voltage's 20th reading, then with this one
    const auto alarm_at = [](const Reading& voltage) {
      int k = 0;
      const auto stuck = [&](LauvSupervisor::In& in) {
        if (k > 0) in.fins.states[1] = FinState::stuck;
        in.instruments.voltage = k++ < 10 ? Reading{25, 20} : voltage;
      };
      return after(1.55, stuck).condition.alarm;
    };
    CHECK(alarm_at({25, 20}) == Alarm::none);
    CHECK(alarm_at({25, 21}) == Alarm::port_fin);
    CHECK(alarm_at({0, 21}) == Alarm::voltage_limit);
    // nobody waits for a voltage that is not fitted
    CHECK(alarm_at({0, -1}) == Alarm::port_fin);
  }

  TEST_CASE("limits alarm at once") {
    CHECK(after(1.1, [](LauvSupervisor::In& in) { in.contact.silence = 6; }).condition.alarm == Alarm::operator_lost);
    CHECK(after(1.1, [](LauvSupervisor::In& in) { in.instruments.leak.value = 1; }).condition.alarm == Alarm::leak);
    CHECK(after(1.1, [](LauvSupervisor::In& in) { in.instruments.depth.value = 13; }).condition.alarm ==
          Alarm::depth_limit);
    CHECK(after(1.1, [](LauvSupervisor::In& in) { in.instruments.altitude.value = 1; }).condition.alarm ==
          Alarm::altitude_limit);
    CHECK(after(1.1, [](LauvSupervisor::In& in) { in.instruments.attitude.y = 1; }).condition.alarm ==
          Alarm::pitch_limit);
    CHECK(after(1.1, [](LauvSupervisor::In& in) { in.instruments.voltage.value = 19; }).condition.alarm ==
          Alarm::voltage_limit);
  }

  TEST_CASE("the first alarm stays, whatever comes after, and it is not taken back") {
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    LauvSupervisor::In in = calm_submarine(1);
    in.instruments.leak.value = 1;
    LauvSupervisor::run({}, every_50_ms, in, state, out);
    in = calm_submarine(2);
    in.contact.silence = 100;
    LauvSupervisor::run({}, every_50_ms, in, state, out);
    CHECK(out.condition.alarm == Alarm::leak);
    LauvSupervisor::run({}, every_50_ms, calm_submarine(3), state, out);
    CHECK(out.condition.alarm == Alarm::leak);
  }

  TEST_CASE("water in the hull takes the place of any other cause, and how it comes up stays") {
    const auto then_leaks = [](auto change) {
      LauvSupervisor::State state;
      LauvSupervisor::Out out;
      for (int k = 1; k < 40; ++k) {
        LauvSupervisor::In in = calm_submarine(k);
        if (k >= 10 && k < 30) change(in);
        in.instruments.leak.value = k >= 30 ? 1 : 0;
        LauvSupervisor::run({}, every_50_ms, in, state, out);
        if (k == 29) CHECK(out.condition.alarm != Alarm::leak);
      }
      CHECK(state.since_alarm == doctest::Approx(0.05 * 30));
      return out;
    };
    const auto climbs = then_leaks([](LauvSupervisor::In& in) { in.contact.silence = 6; });
    CHECK(climbs.condition.alarm == Alarm::leak);
    CHECK(climbs.setpoint.speed == 1);
    const auto leans = [](LauvSupervisor::In& in) { in.instruments.attitude.y = 1; };
    const auto is_flat = [](LauvSupervisor::In& in) {
      in.instruments.voltage.value = LauvSupervisor::Param{}.min_voltage - 0.1;
    };
    for (const auto floats : {then_leaks(leans), then_leaks(is_flat)}) {
      CHECK(floats.condition.alarm == Alarm::leak);
      CHECK(floats.setpoint.speed == 0);
    }
  }

  TEST_CASE("of several causes at once water in the hull is the one") {
    const auto out = after(1.1, [](LauvSupervisor::In& in) {
      in.instruments.leak.value = 1;
      in.contact.silence = 6;
      in.fins.states[0] = FinState::stuck;
    });
    CHECK(out.condition.alarm == Alarm::leak);
  }

  TEST_CASE(
      "a vehicle that comes after the graph is waited for with propeller off, and then each instrument has its time") {
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    LauvSupervisor::In nothing = calm_submarine(0);
    const auto wait = [&](double seconds) {
      for (int k = 0; k < static_cast<int>(20 * seconds); ++k)
        LauvSupervisor::run({}, every_50_ms, nothing, state, out);
      return out;
    };
    CHECK(wait(2.5).condition.alarm == Alarm::none);
    CHECK(wait(0.1).condition.alarm == Alarm::no_vehicle);
    CHECK(out.setpoint.speed == 0);
    CHECK(wait(60).condition.alarm == Alarm::no_vehicle);
    // all but the depth gauge report something
    const auto report = [&](double seconds, std::int64_t depth_count) {
      static std::int64_t k = 0;
      for (const std::int64_t end = k + static_cast<std::int64_t>(20 * seconds); k < end;) {
        LauvSupervisor::In in = calm_submarine(++k);
        in.instruments.depth.count = std::min(k, depth_count);
        LauvSupervisor::run({}, every_50_ms, in, state, out);
      }
      return out;
    };
    CHECK(report(2.4, 0).condition.alarm == Alarm::none);
    CHECK(out.setpoint.speed == wanted.speed);
    CHECK(report(10, 1000).condition.alarm == Alarm::none);
    CHECK(report(3, 0).condition.alarm == Alarm::depth_gauge);
  }

  TEST_CASE("an instrument that comes a second after a vehicle that came two seconds after the graph is not lost") {
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    for (int k = 0; k < 80; ++k) {
      LauvSupervisor::In in = calm_submarine(std::max(0, k - 39));  // from 2 s on
      in.instruments.depth.count = std::max(0, k - 59);             // and the depth gauge from 3 s on
      LauvSupervisor::run({}, every_50_ms, in, state, out);
      CHECK(out.condition.alarm == Alarm::none);
    }
  }

  TEST_CASE("a vehicle of which something was heard is lost when it falls silent") {
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    LauvSupervisor::run({}, every_50_ms, calm_submarine(1), state, out);
    for (int k = 0; k < 60; ++k) LauvSupervisor::run({}, every_50_ms, calm_submarine(1), state, out);
    CHECK(out.condition.alarm == Alarm::vehicle_lost);
    CHECK(out.setpoint.speed == 0);
  }

  TEST_CASE(
      "a vehicle that falls silent is lost, not the instrument that had reported first, nor one that is not fitted") {
    // each second a battery's voltage, ten times a second all else; voltage may not be fitted
    const auto alarm_after = [](double silence, bool voltage_fitted, bool depth_goes_on, double last_rate = 0) {
      LauvSupervisor::State state;
      LauvSupervisor::Out out;
      for (int k = 0; k < static_cast<int>(20 * (5.9 + silence)); ++k) {
        const int heard = std::min(k, 118);  // 5.9 s
        LauvSupervisor::In in = calm_submarine(heard / 2 + 1);
        in.instruments.voltage.count = voltage_fitted ? heard / 20 + 1 : -1;
        if (k >= 118) in.instruments.rates.z = last_rate;
        if (depth_goes_on) in.instruments.depth.count = k / 2 + 1;
        LauvSupervisor::run({}, every_50_ms, in, state, out);
      }
      return out.condition.alarm;
    };
    CHECK(alarm_after(1.5, true, false) == Alarm::none);
    CHECK(alarm_after(1.8, true, false) == Alarm::vehicle_lost);
    CHECK(alarm_after(1.8, true, true) == Alarm::battery);
    CHECK(alarm_after(2.4, false, false) == Alarm::none);
    CHECK(alarm_after(4, false, false) == Alarm::vehicle_lost);
    // what it reported last, while it turned, does not fit a heading that stays
    CHECK(alarm_after(2, false, false, 0.2) == Alarm::vehicle_lost);
    CHECK(alarm_after(2, false, true, 0.2) == Alarm::attitude);
  }

  TEST_CASE("a stop of the operator has an alarm forgotten whose cause is gone, and no other") {
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    std::int64_t k = 0;
    const auto run = [&](double leak, std::uint32_t stops) {
      LauvSupervisor::In in = calm_submarine(++k);
      in.instruments.leak.value = leak;
      in.contact.stops = stops;
      LauvSupervisor::run({}, every_50_ms, in, state, out);
      return out.condition.alarm;
    };
    CHECK(run(1, 0) == Alarm::leak);
    CHECK(run(1, 1) == Alarm::leak);  // water still there: it goes on coming up
    CHECK(state.since_alarm == doctest::Approx(0.1));
    CHECK(run(0, 1) == Alarm::leak);  // one stop counts once
    CHECK(out.setpoint.speed == 1);
    CHECK(run(0, 2) == Alarm::none);
    CHECK(out.setpoint.depth == wanted.depth);
    CHECK(out.setpoint.speed == wanted.speed);
    CHECK(run(0, 2) == Alarm::none);
    // and the next alarm begins as the first did
    CHECK(run(1, 2) == Alarm::leak);
    CHECK(out.setpoint.speed == 1);
    CHECK(state.since_alarm == doctest::Approx(0.05));
  }

  TEST_CASE(
      "a fin that is stuck or silent brings it up by its propeller, under its own name; others are none of that") {
    constexpr Alarm alarms[] = {Alarm::bottom_fin, Alarm::port_fin, Alarm::starboard_fin, Alarm::top_fin};
    for (std::size_t fin = 0; fin < 4; ++fin) {
      const auto with = [fin](FinState state) {
        return after(1.05, [&](LauvSupervisor::In& in) { in.fins.states[fin] = state; });
      };
      for (const FinState state : {FinState::stuck, FinState::silent}) {
        const auto out = with(state);
        CHECK(out.condition.alarm == alarms[fin]);
        CHECK(out.setpoint.depth == -1000);
        CHECK(out.setpoint.speed == 1);
      }
      for (const FinState state : {FinState::unknown, FinState::follows})
        CHECK(with(state).condition.alarm == Alarm::none);
    }
  }

  TEST_CASE("GPS ends the climb, and so does a climb that takes too long or goes blind") {
    const auto climb = [](double seconds, auto change) {
      return after(seconds, [&](LauvSupervisor::In& in) {
        in.instruments.leak.value = 1;
        change(in);
      });
    };
    CHECK(climb(10, [](LauvSupervisor::In&) {}).setpoint.speed == 1);
    CHECK(climb(70, [](LauvSupervisor::In&) {}).setpoint.speed == 0);
    CHECK(climb(10, [](LauvSupervisor::In& in) {
            in.instruments.place.count = in.instruments.depth.count > 100 ? 1 : 0;
          }).setpoint.speed == 0);
    CHECK(climb(10, [](LauvSupervisor::In& in) { in.instruments.rates.count = 20; }).setpoint.speed == 0);
  }

  TEST_CASE("GPS has to report at the surface only") {
    const auto afloat = [](LauvSupervisor::In& in) {
      in.instruments.depth.value = 0.07;
      in.instruments.pressure.value = 1013.25 + 7;
      in.instruments.altitude.value = 49.93;
    };
    const auto found = after(6, [&](LauvSupervisor::In& in) {
      afloat(in);
      in.instruments.place.count = in.instruments.depth.count / 20;
    });
    CHECK(found.condition.alarm == Alarm::none);
    CHECK(after(6, [&](LauvSupervisor::In& in) { afloat(in); }).condition.alarm == Alarm::gps);
  }
}
