#include "vehicles/submarine/sensor.h"
#include "graph/text/errors.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace {
using namespace jarol::vehicles;
using namespace std::chrono_literals;

using Parameters = SensorOf<DepthSensor>;

// What it reports at steps 0, 1, ... of a truth that grows by 1 at each; NaN where it reports nothing.
std::vector<double> reported(const Parameters& parameters, int steps, std::uint64_t seed = 0) {
  Sensor sensor(parameters, "depth", seed);
  std::vector<double> all;
  for (int i = 0; i < steps; ++i) {
    sensor.step(i, Sensor::Values{static_cast<double>(i)});
    all.push_back(sensor.reported() ? sensor.value() : std::nan(""));
  }
  return all;
}

// NaN is NaN here
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))) return false;
  return true;
}

const double none = std::nan("");

Parameters exact(jarol::Duration period) {
  Parameters parameters;
  parameters.period = period;
  return parameters;
}
}  // namespace

TEST_SUITE("vehicles/sensor") {
  TEST_CASE("without errors it reports the truth, at its rate") {
    CHECK(same(reported(exact(30ms), 7), {0, none, none, 3, none, none, 6}));
  }

  TEST_CASE("with a delay it reports later what was") {
    Parameters parameters = exact(20ms);
    parameters.delay = 30ms;
    CHECK(same(reported(parameters, 8), {none, none, none, 0, none, 2, none, 4}));
  }

  TEST_CASE("a bias that drifts walks at random: its deviation is as stated after 100 s, half of that after 25 s") {
    constexpr int sensors = 2000;
    const auto deviation_after = [](int seconds) {
      double sum = 0, squares = 0;
      for (int seed = 0; seed < sensors; ++seed) {
        Parameters parameters;
        parameters.period = 1s;
        parameters.drift = 0.2;
        Sensor sensor(parameters, "depth", static_cast<std::uint64_t>(seed));
        for (int second = 0; second <= seconds; ++second) sensor.step(100 * second, Sensor::Values{5});
        sum += sensor.value() - 5;
        squares += (sensor.value() - 5) * (sensor.value() - 5);
      }
      CHECK(std::abs(sum / sensors) < 0.015);
      return std::sqrt(squares / sensors);
    };
    CHECK(deviation_after(100) == doctest::Approx(0.2).scale(0).epsilon(0.05));
    CHECK(deviation_after(25) == doctest::Approx(0.1).scale(0).epsilon(0.05));
    CHECK(deviation_after(0) == 0);
  }

  TEST_CASE("it drifts as far while the sensor reports nothing or has nothing to measure") {
    constexpr int sensors = 2000;
    const auto deviation_of = [](const SensorFailure& failure, bool has_truth) {
      double squares = 0;
      for (int seed = 0; seed < sensors; ++seed) {
        Parameters parameters;
        parameters.period = 1s;
        parameters.drift = 0.2;
        parameters.failure = failure;
        Sensor sensor(parameters, "depth", static_cast<std::uint64_t>(seed));
        for (int second = 0; second <= 100; ++second) {
          const bool measures = has_truth || second == 0 || second == 100;
          sensor.step(100 * second, measures ? std::optional(Sensor::Values{5}) : std::nullopt);
        }
        squares += (sensor.value() - 5) * (sensor.value() - 5);
      }
      return std::sqrt(squares / sensors);
    };
    const SensorFailure lost{.kind = FailureKind::lost, .at = 0.5, .lasts = 99};
    CHECK(deviation_of(lost, true) == doctest::Approx(0.2).scale(0).epsilon(0.05));
    CHECK(deviation_of({}, false) == doctest::Approx(0.2).scale(0).epsilon(0.05));
  }

  TEST_CASE("a bias that drifts leaves the noise as it is") {
    Parameters parameters = exact(10ms);
    parameters.noise = 0.1;
    const std::vector<double> still = reported(parameters, 50, 7);
    parameters.drift = 2;
    const std::vector<double> drifts = reported(parameters, 50, 7);
    parameters.noise = 0;
    const std::vector<double> alone = reported(parameters, 50, 7);
    for (std::size_t i = 0; i < 50; ++i)
      CHECK(drifts[i] - still[i] == doctest::Approx(alone[i] - static_cast<double>(i)).scale(1).epsilon(1e-12));
    CHECK(alone[49] != 49);
  }

  TEST_CASE("a bias is added, and readings are multiples of the resolution") {
    Parameters parameters = exact(10ms);
    parameters.bias = 0.3;
    parameters.resolution = 0.5;
    CHECK(same(reported(parameters, 3), {0.5, 1.5, 2.5}));
    parameters.bias = 0.2;
    CHECK(same(reported(parameters, 3), {0, 1, 2}));
  }

  TEST_CASE("noise has the stated deviation about the truth, and none beyond six times of it") {
    Parameters parameters = exact(10ms);
    parameters.noise = 0.2;
    const auto readings = reported(parameters, 20000, 7);
    double sum = 0, squares = 0, max = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double error = readings[i] - static_cast<double>(i);
      sum += error;
      squares += error * error;
      max = std::max(max, std::abs(error));
    }
    // four standard errors of mean and deviation
    CHECK(std::abs(sum / 20000) < 4 * 0.2 / std::sqrt(20000));
    CHECK(std::sqrt(squares / 20000) == doctest::Approx(0.2).scale(0).epsilon(4 / std::sqrt(40000)));
    CHECK(max < 6 * 0.2);
    CHECK(max > 3 * 0.2);
  }

  TEST_CASE("the same seed gives the same noise, another seed or another sensor another") {
    Parameters parameters = exact(10ms);
    parameters.noise = 1;
    CHECK(same(reported(parameters, 50, 1), reported(parameters, 50, 1)));
    CHECK(!same(reported(parameters, 50, 1), reported(parameters, 50, 2)));
    Sensor depth(parameters, "depth", 1), other(parameters, "other", 1);
    depth.step(0, Sensor::Values{});
    other.step(0, Sensor::Values{});
    CHECK(depth.value() != other.value());
  }

  TEST_CASE("a lost sensor reports nothing more, a stuck one its last, a biased one too much") {
    Parameters parameters = exact(10ms);
    parameters.failure = {FailureKind::lost, 0.02, 0};
    CHECK(same(reported(parameters, 4), {0, 1, none, none}));
    parameters.failure = {FailureKind::stuck, 0.02, 0};
    CHECK(same(reported(parameters, 4), {0, 1, 1, 1}));
    parameters.failure = {FailureKind::biased, 0.02, 5};
    CHECK(same(reported(parameters, 4), {0, 1, 7, 8}));
    parameters.failure = {FailureKind::stuck, 0, 0};
    CHECK(same(reported(parameters, 3), {none, none, none}));
  }

  TEST_CASE("a failure that lasts 20 ms ends after them, and the sensor reads right again") {
    Parameters parameters = exact(10ms);
    const auto failing = [&](FailureKind kind, double by) {
      parameters.failure = {.kind = kind, .at = 0.02, .by = by, .lasts = 0.02};
      return reported(parameters, 6);
    };
    CHECK(same(failing(FailureKind::lost, 0), {0, 1, none, none, 4, 5}));
    CHECK(same(failing(FailureKind::stuck, 0), {0, 1, 1, 1, 4, 5}));
    CHECK(same(failing(FailureKind::biased, 5), {0, 1, 7, 8, 4, 5}));
    CHECK(same(failing(FailureKind::drifting, 100), {0, 1, 2, 4, 4, 5}));
  }

  TEST_CASE("one that begins by chance lasts as long from when it began") {
    Parameters parameters = exact(10ms);
    parameters.failure = {.kind = FailureKind::lost, .chance = 10, .lasts = 0.1};
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const auto readings = reported(parameters, 500, seed);
      CHECK(std::count_if(readings.begin(), readings.end(), [](double x) { return std::isnan(x); }) == 10);
    }
  }

  TEST_CASE("what there is not it does not report, and reads as no number before the first") {
    Sensor sensor(exact(10ms), "depth", 0);
    CHECK(std::isnan(sensor.value()));
    sensor.step(0, std::nullopt);
    CHECK(!sensor.reported());
    CHECK(std::isnan(sensor.value()));
    sensor.step(1, Sensor::Values{3});
    CHECK(sensor.reported());
    sensor.step(2, std::nullopt);
    CHECK(!sensor.reported());
    CHECK(sensor.value() == 3);
  }

  TEST_CASE("period and delay are steps of the vehicle") {
    CHECK_THROWS_WITH_AS(reported(exact(15ms), 1),
                         "submarine: sensors.depth.period must be a multiple of the vehicle's steps of 10ms",
                         jarol::InputError);
    CHECK_THROWS_WITH_AS(reported(exact(0ms), 1), "submarine: sensors.depth.period must be above zero",
                         jarol::InputError);
    Parameters parameters;
    parameters.delay = 5ms;
    CHECK_THROWS_WITH_AS(reported(parameters, 1),
                         "submarine: sensors.depth.delay must be a multiple of the vehicle's steps of 10ms",
                         jarol::InputError);
    parameters.delay = 60010ms;
    CHECK_THROWS_WITH_AS(reported(parameters, 1), "submarine: sensors.depth.delay is longer than a minute",
                         jarol::InputError);
    parameters.delay = {};
    parameters.noise = -1;
    CHECK_THROWS_WITH_AS(reported(parameters, 1), "submarine: sensors.depth.noise is below zero", jarol::InputError);
  }
}
