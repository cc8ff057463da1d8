// Four leak sensors: water at any, or silence of any, brings the submarine up under the name of that one.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "tests/tasks/lauv/watched_submarine.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;

constexpr std::array names{Alarm::leak, Alarm::leak1, Alarm::leak2, Alarm::leak3};

struct LeakWatch : tests::WatchedSubmarine {
  Alarm run_wet(std::initializer_list<std::size_t> sensors, int steps = 1) {
    return run(steps, [&](LauvSupervisor::In& in) {
      for (const std::size_t sensor : sensors) (in.instruments.*leak_readings[sensor]).value = 1;
    });
  }
};
}  // namespace

TEST_SUITE("tasks/lauv_supervisor/leaks") {
  TEST_CASE("water at one sensor alarms at once, under its name, and it comes up by the propeller") {
    for (std::size_t sensor = 0; sensor < hull_sensors; ++sensor) {
      CAPTURE(sensor);
      LeakWatch w;
      CHECK(w.run_wet({}, 20) == Alarm::none);
      CHECK(w.run_wet({sensor}) == names[sensor]);
      CHECK(w.out.setpoint.depth == -1000);
      CHECK(w.out.setpoint.speed == 1);
    }
  }

  TEST_CASE("a sensor that reports no more, or never does, is lost after 2.5 s, under its name") {
    for (std::size_t sensor = 0; sensor < hull_sensors; ++sensor)
      for (const std::int64_t last : {0, 20}) {
        CAPTURE(sensor);
        LeakWatch w;
        const auto is_silent = [&](LauvSupervisor::In& in) {
          std::int64_t& count = (in.instruments.*leak_readings[sensor]).count;
          count = std::min(count, last);
        };
        w.run(20, is_silent);
        CHECK(w.run(last == 0 ? 29 : 49, is_silent) == Alarm::none);
        CHECK(w.run(3, is_silent) == names[sensor]);
      }
  }

  TEST_CASE("nobody waits for sensors that are not fitted") {
    LeakWatch w;
    CHECK(w.run(200, [](LauvSupervisor::In& in) {
      for (const auto leak : leak_readings) (in.instruments.*leak).count = -1;
    }) == Alarm::none);
  }

  TEST_CASE("of several with water the first is named, and then that stays while there is water at it") {
    LeakWatch w;
    CHECK(w.run_wet({3, 2}) == Alarm::leak2);
    CHECK(w.run_wet({0, 2, 3}) == Alarm::leak2);
    CHECK(w.run_wet({1, 3}) == Alarm::leak1);
    CHECK(w.run_wet({3}) == Alarm::leak3);
    CHECK(w.run_wet({}) == Alarm::leak3);
  }

  TEST_CASE("water at a sensor takes the place of another's silence") {
    LeakWatch w;
    CHECK(w.run(60, [](LauvSupervisor::In& in) { in.instruments.leak.count = 1; }) == Alarm::leak);
    CHECK(w.run(1, [](LauvSupervisor::In& in) {
      in.instruments.leak.count = 1;
      in.instruments.leak3.value = 1;
    }) == Alarm::leak3);
  }
}
