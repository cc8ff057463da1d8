// What goes wrong on a dive ends at the surface.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/how_many.h"
#include "tests/tools/dive.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tasks::Alarm;
using test::Dive;
using test::dive;

// The dive with these parameters of the vehicle, long enough to come up by buoyancy, 3 m at 3.9 cm/s.
Dive dive_with(const std::string& parameters) {
  return dive("specs/exolauv.yaml", {"distributers.dune.link.parameters={" + parameters + "}"}, 0, 140s);
}

// One of many that take long each; all with JAROL_FULL.
template <class Case, std::size_t N>
std::vector<Case> chosen_of(const Case (&cases)[N]) {
  if (jarol::tests::is_full()) return {cases, cases + N};
  return {cases[N / 2]};
}

struct Case {
  const char* sensor;
  double at, by;
  Alarm alarm;
};

// It came up after the alarm, and stayed.
void check_surfaces(const Dive& done, Alarm alarm, double alarm_by) {
  CHECK(static_cast<int>(done.alarm) == static_cast<int>(alarm));
  CHECK(done.alarmed_at <= alarm_by);
  CHECK(done.samples.back().motion.z < 0.3);
  CHECK(std::abs(done.samples.back().motion.u) < 0.1);
}

std::string failing(const std::string& sensor, const std::string& kind, double at, double by = 0) {
  return "sensors: {" + sensor + ": {failure: {kind: " + kind + ", at: " + std::to_string(at) +
         ", by: " + std::to_string(by) + "}}}";
}

void check_failures(const std::string& kind, const std::vector<Case>& cases) {
  for (const Case& each : cases) {
    CAPTURE(std::string(each.sensor));
    check_surfaces(dive_with(failing(each.sensor, kind, each.at, each.by)), each.alarm, each.at + 20);
  }
}
}  // namespace

TEST_SUITE("tools/surfacing") {
  TEST_CASE("a sensor that is lost ends the dive") {
    static constexpr Case cases[] = {{"depth", 30, 0, Alarm::depth_gauge},     {"pressure", 30, 0, Alarm::ctd},
                                     {"imu_attitude", 30, 0, Alarm::attitude}, {"imu_rates", 30, 0, Alarm::attitude},
                                     {"imu_forces", 30, 0, Alarm::forces},     {"compass", 30, 0, Alarm::heading},
                                     {"speed_log", 30, 0, Alarm::speed},       {"rpm", 30, 0, Alarm::speed},
                                     {"altitude", 30, 0, Alarm::altimeter},    {"conductivity", 30, 0, Alarm::ctd},
                                     {"water_temperature", 30, 0, Alarm::ctd}, {"leak", 30, 0, Alarm::leak},
                                     {"voltage", 30, 0, Alarm::battery},       {"current", 30, 0, Alarm::battery},
                                     {"servos", 30, 0, Alarm::bottom_fin}};
    check_failures("lost", chosen_of(cases));
  }

  TEST_CASE("a depth gauge that is silent for two seconds does not end the dive, one that is so for three does") {
    const auto silent_for = [](const std::string& time) {
      return dive("specs/exolauv.yaml",
                  {"distributers.dune.link.parameters.sensors.depth.failure={kind: lost, at: 30 s, "
                   "lasts: " +
                   time + "}"});
    };
    const Dive on = silent_for("2 s");
    CHECK(on.alarm == Alarm::none);
    CHECK(on.samples.back().motion.z == doctest::Approx(3).scale(0).epsilon(0.02));
    check_surfaces(silent_for("3 s"), Alarm::depth_gauge, 33);
  }

  TEST_CASE("a battery that runs low ends the dive while there is charge, and one that is flat stops the propeller") {
    // 20.06 V with the propeller off: below the limit as soon as it turns
    const Dive low = dive_with("power: {charge: 0.3}");
    check_surfaces(low, Alarm::voltage_limit, 10);
    CHECK(low.alarmed_at > 2);
    // nobody looks at the voltage: 25 mA h are gone after some 30 s, and nothing lies
    const Dive flat = dive("specs/exolauv.yaml",
                           {"distributers.dune.link.parameters={power: {charge: 0.00125}}",
                            "tasks.supervisor.parameters={min_voltage: 0 V}"},
                           0, 140s);
    CHECK(flat.samples.back().motion.z < 0.3);
    CHECK(std::abs(flat.samples.back().motion.u) < 0.1);
    // one that is above the limit until its charge is used up: its fins stand still, and are not blamed
    check_surfaces(dive_with("power: {charge: 0.0013, empty: 21 V}"), Alarm::voltage_limit, 40);
  }

  TEST_CASE("a sensor that lies ends the dive") {
    static constexpr Case cases[] = {
        {"depth", 30, 0.5, Alarm::depth_gauge},     {"pressure", 30, -60, Alarm::depth_gauge},
        {"imu_attitude", 30, 0.3, Alarm::attitude}, {"imu_rates", 30, 0.3, Alarm::attitude},
        {"imu_forces", 30, 4, Alarm::forces},       {"compass", 30, 0.5, Alarm::heading},
        {"speed_log", 30, 0.8, Alarm::speed},       {"rpm", 30, -1500, Alarm::speed},
        {"altitude", 30, -5, Alarm::altimeter},     {"leak", 30, 1, Alarm::leak},
        {"voltage", 30, -10, Alarm::voltage_limit}};
    check_failures("biased", chosen_of(cases));
  }

  TEST_CASE("a sensor that is stuck while the vehicle moves ends the dive") {
    static constexpr Case cases[] = {{"depth", 5, 0, Alarm::depth_gauge},     {"pressure", 5, 0, Alarm::depth_gauge},
                                     {"imu_attitude", 3, 0, Alarm::attitude}, {"imu_rates", 3, 0, Alarm::attitude},
                                     {"imu_forces", 3, 0, Alarm::forces},     {"compass", 49, 0, Alarm::heading},
                                     {"speed_log", 2.5, 0, Alarm::speed},     {"rpm", 2.1, 0, Alarm::speed},
                                     {"altitude", 3, 0, Alarm::altimeter}};
    check_failures("stuck", chosen_of(cases));
  }

  TEST_CASE("without GPS it does not leave the surface") {
    const Dive done = dive("specs/exolauv.yaml",
                           {"distributers.dune.link.parameters={sensors: {gps: {failure: {kind: lost}}}}",
                            "distributers.neptus.link.file=missions/late.csv"},
                           0, 40s);
    check_surfaces(done, Alarm::gps, 6);
  }

  TEST_CASE(
      "each leak sensor that sees water or is silent ends the dive under its own name, one that sticks does not") {
    const auto alarm_of = [](const std::string& sensor, const std::string& failure) {
      return dive("specs/exolauv.yaml",
                  {"distributers.dune.link.parameters={dynamics: rigid, sensors: {" + sensor + ": {failure: {at: 3, " +
                   failure + "}}}}"},
                  0, 7s)
          .alarm;
    };
    const std::pair<std::string, Alarm> sensors[] = {
        {"leak", Alarm::leak}, {"leak1", Alarm::leak1}, {"leak2", Alarm::leak2}, {"leak3", Alarm::leak3}};
    for (const auto& [sensor, alarm] : sensors) {
      CAPTURE(sensor);
      CHECK(static_cast<int>(alarm_of(sensor, "kind: biased, by: 1")) == static_cast<int>(alarm));
      CHECK(static_cast<int>(alarm_of(sensor, "kind: lost")) == static_cast<int>(alarm));
      CHECK(alarm_of(sensor, "kind: stuck") == Alarm::none);
    }
    CHECK(alarm_of("hull_temperature2", "kind: lost") == Alarm::none);
  }

  TEST_CASE("water that the first leak sensor does not see another does") {
    CHECK(dive("specs/exolauv.yaml",
               {"distributers.dune.link.parameters={dynamics: rigid, leak_at: 4 s, "
                "sensors: {leak: {failure: {kind: stuck, at: 2}}}}"},
               0, 5s)
              .alarm == Alarm::leak1);
  }

  TEST_CASE("water in the hull ends the dive") { check_surfaces(dive_with("leak_at: 30s"), Alarm::leak, 32); }

  TEST_CASE("a propeller that is lost, or can't be stopped, ends the dive, and the operator is told") {
    const auto with = [](const std::string& failure, Duration time) {
      return dive("specs/exolauv.yaml",
                  {"distributers.dune.link.parameters={failures: {propeller: {" + failure + "}}, dynamics: rigid}"}, 0,
                  time);
    };
    check_surfaces(with("kind: lost, at: 30", 160s), Alarm::propeller, 39);
    // at the surface it goes on, at whatever speed that gives
    const Dive ahead = with("kind: hardover, to: 1, at: 30", 120s);
    CHECK(static_cast<int>(ahead.alarm) == static_cast<int>(Alarm::propeller));
    CHECK(ahead.alarmed_at < 60);
    CHECK(ahead.samples.back().motion.z < 0.3);
  }

  TEST_CASE("a propeller that turns full astern, whatever it is sent, leaves it upright, and it comes up") {
    for (const double at : {5.0, 30.0, 50.6}) {
      CAPTURE(at);
      const Dive done =
          dive("specs/exolauv.yaml",
               {fmt::format("distributers.dune.link.parameters={{failures: {{propeller: {{kind: hardover, "
                            "at: {}, to: -1}}}}, dynamics: rigid}}",
                            at)},
               0, 220s);
      double deepest = 0, steepest = 0;
      for (const auto& sample : done.samples) {
        deepest = std::max(deepest, sample.motion.z);
        steepest = std::max(steepest, std::abs(sample.motion.theta));
      }
      CHECK(deepest < 6.5);
      CHECK(steepest < 50 * std::numbers::pi / 180);
      CHECK(done.samples.back().motion.z < 0.3);
    }
  }

  TEST_CASE("a fin that goes hard over ends the dive, whichever it is and to whichever side, and it hardly sinks") {
    struct Fin {
      int number, to;
      Alarm alarm;
    };
    static constexpr Fin fins[] = {
        {0, 1, Alarm::bottom_fin},    {0, -1, Alarm::bottom_fin},    {1, 1, Alarm::port_fin}, {1, -1, Alarm::port_fin},
        {2, 1, Alarm::starboard_fin}, {2, -1, Alarm::starboard_fin}, {3, 1, Alarm::top_fin},  {3, -1, Alarm::top_fin}};
    for (const Fin& fin : fins) {
      CAPTURE(fin.number);
      CAPTURE(fin.to);
      // an elevator that noses down leaves it no more than buoyancy
      const Dive done = dive("specs/exolauv.yaml",
                             {fmt::format("distributers.dune.link.parameters={{failures: {{fin{}: {{kind: hardover, "
                                          "at: 30, to: {}}}}}, dynamics: rigid}}",
                                          fin.number, fin.to)},
                             0, 220s);
      check_surfaces(done, fin.alarm, 31.1);  // with the next reading of the voltage
      double deepest = 0;
      for (const auto& sample : done.samples) deepest = std::max(deepest, sample.motion.z);
      CHECK(deepest < 5);
    }
  }

  TEST_CASE("a rudder that sticks before or in the turn ends the dive, and where it goes on the turn is made") {
    // amidships it is missed as soon as the turn begins, turned when it is to turn back
    for (const auto& [at, alarm_by] : {std::pair{49.0, 51.0}, std::pair{50.4, 60.0}}) {
      CAPTURE(at);
      const std::string stuck =
          fmt::format("distributers.dune.link.parameters={{failures: {{fin3: {{kind: stuck, at: {}}}}}}}", at);
      check_surfaces(dive("specs/exolauv.yaml", {stuck}, 0, 140s), Alarm::top_fin, alarm_by);
      const Dive on = dive("specs/exolauv.yaml", {stuck, "tasks.supervisor.parameters.fins_end_dive=false"});
      CHECK(on.alarm == Alarm::none);
      CHECK(on.fins == tasks::FinCheck::top_failed);
      const tasks::Motion& end = on.samples.back().motion;
      CHECK(end.psi == doctest::Approx(std::numbers::pi / 2).scale(0).epsilon(0.01));
      CHECK(end.z == doctest::Approx(3).scale(0).epsilon(0.02));
    }
  }

  TEST_CASE("a vehicle that never reports its servos dives as it is sent, with a stuck rudder, too") {
    const Dive done = dive("specs/exolauv.yaml",
                           {"distributers.dune.link.parameters={failures: {fin3: {kind: stuck, at: 50.4}}, sensors: "
                            "{servos: {failure: {kind: lost}}}}"});
    CHECK(done.alarm == Alarm::none);
    CHECK(done.samples.back().motion.z == doctest::Approx(3).scale(0).epsilon(0.02));
  }

  TEST_CASE("servos that all report as much too much end the dive, and it goes no deeper") {
    for (const double by : {0.2, 0.4}) {
      const Dive done = dive_with(failing("servos", "biased", 20, by));
      check_surfaces(done, Alarm::bottom_fin, 21);
      double deepest = 0;
      for (const auto& sample : done.samples) deepest = std::max(deepest, sample.motion.z);
      CHECK(deepest < 3.1);
    }
  }

  TEST_CASE("an operator who is lost ends the dive") {
    check_surfaces(dive("specs/exolauv.yaml", {"distributers.neptus.link.file=missions/lost_operator.csv"}, 0, 100s),
                   Alarm::operator_lost, 41.2);
  }

  TEST_CASE("it stays at the surface when the operator is heard again, and dives again after a stop was demanded") {
    const Dive done =
        dive("specs/exolauv.yaml", {"distributers.neptus.link.file=../tests/data/lauv-recovered.csv"}, 0, 110s);
    CHECK(done.alarm == Alarm::none);
    const auto depth = [&](double time) {
      for (const auto& sample : done.samples)
        if (sample.time >= time) return sample.motion.z;
      return -1.0;
    };
    CHECK(depth(36) == doctest::Approx(3).scale(0).epsilon(0.05));
    CHECK(depth(60) < 0.3);
    CHECK(depth(72) < 0.3);
    CHECK(depth(109) == doctest::Approx(3).scale(0).epsilon(0.05));
  }

  TEST_CASE("a limit that is exceeded ends the dive") {
    const auto limited = [](const std::string& limit) {
      return dive("specs/exolauv.yaml", {"tasks.supervisor.parameters={" + limit + "}"}, 0, 140s);
    };
    check_surfaces(limited("max_depth: 2"), Alarm::depth_limit, 20);
    check_surfaces(limited("min_altitude: 48"), Alarm::altitude_limit, 20);
    check_surfaces(limited("max_pitch: 20deg"), Alarm::pitch_limit, 20);
    check_surfaces(limited("min_voltage: 25"), Alarm::voltage_limit, 20);
  }
}
