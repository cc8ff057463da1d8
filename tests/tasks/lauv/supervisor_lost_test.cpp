// Each instrument of the submarine that reports no more, never, or is not fitted, and what the supervisor calls it.
#include <doctest/doctest.h>

#include <cstdint>

#include "tests/tasks/lauv/watched_submarine.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::calm_submarine;
using tests::Change;
using tests::every_50_ms;
using tests::WatchedSubmarine;

struct Lost {
  std::int64_t& (*count)(Instruments&);
  Alarm alarm;
  bool steered_by = false;  // nothing is steered without it, be it fitted or not
  // it has reported as often as that
  Change as(std::int64_t reports) const {
    return [this, reports](LauvSupervisor::In& in) { count(in.instruments) = reports; };
  }
};
const Lost each_instrument[] = {
    {[](Instruments& i) -> std::int64_t& { return i.depth.count; }, Alarm::depth_gauge},
    {[](Instruments& i) -> std::int64_t& { return i.pressure.count; }, Alarm::ctd},
    {[](Instruments& i) -> std::int64_t& { return i.attitude.count; }, Alarm::attitude, true},
    {[](Instruments& i) -> std::int64_t& { return i.rates.count; }, Alarm::attitude},
    {[](Instruments& i) -> std::int64_t& { return i.forces.count; }, Alarm::forces},
    {[](Instruments& i) -> std::int64_t& { return i.heading.count; }, Alarm::heading},
    {[](Instruments& i) -> std::int64_t& { return i.velocity.count; }, Alarm::speed, true},
    {[](Instruments& i) -> std::int64_t& { return i.rpm.count; }, Alarm::speed},
    {[](Instruments& i) -> std::int64_t& { return i.altitude.count; }, Alarm::altimeter},
    {[](Instruments& i) -> std::int64_t& { return i.conductivity.count; }, Alarm::ctd},
    {[](Instruments& i) -> std::int64_t& { return i.water_temperature.count; }, Alarm::ctd},
    {[](Instruments& i) -> std::int64_t& { return i.leak.count; }, Alarm::leak},
    {[](Instruments& i) -> std::int64_t& { return i.leak1.count; }, Alarm::leak1},
    {[](Instruments& i) -> std::int64_t& { return i.leak2.count; }, Alarm::leak2},
    {[](Instruments& i) -> std::int64_t& { return i.leak3.count; }, Alarm::leak3},
    {[](Instruments& i) -> std::int64_t& { return i.voltage.count; }, Alarm::battery},
    {[](Instruments& i) -> std::int64_t& { return i.current.count; }, Alarm::battery}};
}  // namespace

TEST_SUITE("tasks/lauv_supervisor/lost") {
  TEST_CASE("each instrument that reports no more is lost after 2.5 s, under its own name") {
    for (const Lost& each : each_instrument) {
      CAPTURE(&each - each_instrument);
      WatchedSubmarine submarine;
      for (int step = 1; step <= 20; ++step) CHECK(submarine.run(1, each.as(step)) == Alarm::none);
      const int steps = submarine.steps_to_alarm(each.as(20));
      // the sum of 50 steps may lie a rounding above 2.5
      CHECK((steps == 50 || steps == 51));
      CHECK(submarine.out.condition.alarm == each.alarm);
    }
  }

  TEST_CASE(
      "each that is fitted and never reports is lost 2.5 s after the first of the others has, under its own name") {
    for (const Lost& each : each_instrument) {
      CAPTURE(&each - each_instrument);
      for (const bool waits : {false, true}) {
        CAPTURE(waits);
        WatchedSubmarine submarine;
        // the vehicle may be long in coming
        for (int step = 0; waits && step < 400; ++step)
          LauvSupervisor::run({}, every_50_ms, {}, submarine.state, submarine.out);
        CHECK(submarine.out.condition.alarm == (waits ? Alarm::no_vehicle : Alarm::none));
        const int steps = submarine.steps_to_alarm(each.as(0));
        CHECK((steps == 50 || steps == 51));
        CHECK(submarine.out.condition.alarm == each.alarm);
      }
    }
  }

  TEST_CASE("one that is not fitted is not waited for, but attitude and speed log, without which nothing is steered") {
    for (const Lost& each : each_instrument) {
      CAPTURE(&each - each_instrument);
      for (const int steps : {1, 200})
        CHECK(WatchedSubmarine{}.run(steps, each.as(-1)) == (each.steered_by ? each.alarm : Alarm::none));
    }
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    LauvSupervisor::In blind = calm_submarine(1);
    blind.instruments.depth.count = blind.instruments.pressure.count = -1;
    LauvSupervisor::run({}, every_50_ms, blind, state, out);
    CHECK(out.condition.alarm == Alarm::depth_gauge);
    CHECK(out.setpoint.speed == 0);
  }
}
