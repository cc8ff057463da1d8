#include "vehicles/helicopter/sensors.h"
#include "vehicles/helicopter/helicopter.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "graph/math/rotations.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
using messages::javiator::JaviatorData;

HelicopterSensors::Scene level(double north, double east, double down) {
  HelicopterSensors::Scene scene;
  scene.motion.p_n = {north, east, down};
  scene.specific_force = {0, 0, -9.81};
  scene.voltage = 15;
  return scene;
}

std::string text(const std::array<std::uint8_t, 8>& digits) { return {digits.begin(), digits.end()}; }

constexpr std::int64_t ms = 1'000'000;

// Answers after a second of sampling each 5 ms.
JaviatorData after_a_second(const HelicopterParameters& parameters, const HelicopterSensors::Scene& scene) {
  HelicopterSensors sensors(parameters, 1);
  for (int i = 0; i <= 200; ++i) sensors.sample(5 * i * ms, scene);
  sensors.sample_imu(1000 * ms, scene);
  return sensors.answer(3);
}

// How often each bit of `state` is set in that many seconds of answers every 15 ms.
std::array<int, 5> count_news(const HelicopterParameters& parameters, int seconds) {
  HelicopterSensors sensors(parameters, 1);
  std::array<int, 5> counts{};
  for (int i = 0; i < 200 * seconds; ++i) {
    sensors.sample(5 * i * ms, level(0, 0, 0));
    if (i % 3 != 0) continue;
    sensors.sample_imu(5 * i * ms, level(0, 0, 0));
    const JaviatorData data = sensors.answer(0);
    for (std::size_t bit = 0; bit < 5; ++bit) counts[bit] += (data.flags >> bit) & 1;
  }
  return counts;
}
}  // namespace

TEST_SUITE("vehicles/helicopter_sensors") {
  TEST_CASE("at rest it reports what the recorded vehicle reported") {
    HelicopterParameters parameters;
    parameters.sensors.sonars = 1;
    parameters.sensors.sonar_x = parameters.sensors.sonar_y = -0.095;
    parameters.feet.stiffness = 1e9;
    const JaviatorData data = after_a_second(parameters, level(0, 0, -0.2));
    CHECK(data.maps == 14782186);
    CHECK(data.temp == 1311);
    CHECK(data.batt == 853);
    CHECK(data.sonar == 49);
    CHECK(data.flags == 31);
    CHECK(data.id == 3);
    CHECK(text(data.x_pos) == std::string("0008070\0", 8));
    CHECK(text(data.y_pos) == std::string("0008077\0", 8));
    CHECK(data.ddz == -4681);
  }

  TEST_CASE("angles, rates and forces come in the wire's units, body axes") {
    HelicopterSensors::Scene scene = level(0, 0, -2);
    const double roll = 0.1;
    scene.motion.R_nb = {{{1, 0, 0}, {0, std::cos(roll), -std::sin(roll)}, {0, std::sin(roll), std::cos(roll)}}};
    scene.motion.omega_b = {0.5, -0.25, 1};
    scene.specific_force = {1, 0, -9.81};
    const JaviatorData data = after_a_second({}, scene);
    CHECK(data.roll == 1043);   // 0.1 * 65536 / (2 pi)
    CHECK(data.droll == 1928);  // 0.5 * 32768 / 8.5
    CHECK(data.dpitch == -964);
    CHECK(data.dyaw == 3855);
    CHECK(data.ddx == 477);  // 4681 / 9.81
  }

  TEST_CASE("sonar 22 Hz, lasers 25 Hz, pressure 27.5 Hz, the IMU in each answer") {
    const std::array<int, 5> counts = count_news({}, 10);
    CHECK(counts[0] == 667);
    CHECK(counts[1] == 275);
    CHECK(counts[2] == 220);
    CHECK(counts[3] == 250);
    CHECK(counts[4] == 250);
  }

  TEST_CASE(
      "the sonar measures along the body's axis: from 1.9 m at 60 degrees of roll it sees the ground at 3.8 m, out of "
      "reach") {
    HelicopterSensors::Scene scene = level(0, 0, -1.9 - 0.055 * 0.5);
    const double roll = std::acos(0.5);
    scene.motion.R_nb = {{{1, 0, 0}, {0, std::cos(roll), -std::sin(roll)}, {0, std::sin(roll), std::cos(roll)}}};
    CHECK(after_a_second({}, scene).sonar == 1023);
    scene.motion.p_n[2] = -1 - 0.055 * 0.5;
    CHECK(after_a_second({}, scene).sonar == 682);  // 2 m of 3 m
  }

  TEST_CASE("of four sonars the mean of the middle two counts, so that one may be wrong") {
    HelicopterParameters parameters;
    parameters.noise.sonar_outliers = 0.1;
    HelicopterSensors four(parameters, 5);
    parameters.sensors.sonars = 1;
    HelicopterSensors one(parameters, 5);
    int wrong_of_four = 0, wrong_of_one = 0;
    for (int i = 0; i < 20000; ++i) {
      four.sample(50 * i * ms, level(0, 0, -1.055));
      one.sample(50 * i * ms, level(0, 0, -1.055));
      wrong_of_four += std::abs(four.answer(0).sonar - 341) > 3 ? 1 : 0;
      wrong_of_one += std::abs(one.answer(0).sonar - 341) > 3 ? 1 : 0;
    }
    CHECK(wrong_of_one == doctest::Approx(2000).scale(0).epsilon(0.1));
    CHECK(wrong_of_four < 800);  // two have to be wrong at once, 5 % of the time, and on the same side
  }

  TEST_CASE("each of four sonars, on the arms front, right, rear and left, measures along the body's axis") {
    // 20 cm forward and 15 cm right of the axis, and so on round
    HelicopterParameters parameters;
    parameters.sensors.sonar_x = 0.2;
    parameters.sensors.sonar_y = 0.15;
    const double pitch = 0.1, roll = -0.2;
    HelicopterSensors::Scene scene = level(0, 0, -1);
    const Eigen::Matrix3d R = rotation_of(roll, pitch, 0.3);
    for (int i = 0; i < 3; ++i) scene.motion.R_nb[static_cast<std::size_t>(i)] = {R(i, 0), R(i, 1), R(i, 2)};
    HelicopterSensors sensors(parameters, 1);
    sensors.sample(0, scene);
    const auto ranges = sensors.each_sonar(7);
    CHECK(ranges.id == 7);
    // from the plane of the ground: 0 = height - (R r + range R e_z)_z
    const auto expected = [&](double x, double y) {
      const Eigen::Vector3d r_n = R * Eigen::Vector3d(x, y, parameters.sensors.sonar_z);
      return static_cast<int>((1 - r_n.z()) / R(2, 2) / 3 * 1024);
    };
    CHECK(ranges.front == expected(0.2, 0.15));
    CHECK(ranges.right == expected(-0.15, 0.2));
    CHECK(ranges.rear == expected(-0.2, -0.15));
    CHECK(ranges.left == expected(0.15, -0.2));
    CHECK(ranges.front > ranges.rear + 10);  // nose up
    CHECK(ranges.right > ranges.left + 10);  // to the left
  }

  TEST_CASE("noise has the deviation it is given, and is another with another seed") {
    HelicopterParameters parameters;
    parameters.noise.rate = 0.01;
    parameters.noise.laser = 0.01;
    double sum = 0, squares = 0, laser_squares = 0;
    HelicopterSensors one(parameters, 1), two(parameters, 2);
    int different = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      one.sample(50 * i * ms, level(0, 0, 0));
      two.sample(50 * i * ms, level(0, 0, 0));
      one.sample_imu(50 * i * ms, level(0, 0, 0));
      two.sample_imu(50 * i * ms, level(0, 0, 0));
      const JaviatorData a = one.answer(0), b = two.answer(0);
      const double p = a.droll * 8.5 / 32768;
      sum += p;
      squares += p * p;
      const double laser = 1e-3 * (std::stoi(text(a.x_pos)) - 8070);
      laser_squares += laser * laser;
      different += a.droll != b.droll ? 1 : 0;
    }
    CHECK(std::abs(sum / n) < 3e-4);
    CHECK(std::sqrt(squares / n) == doctest::Approx(0.01).scale(0).epsilon(0.02));
    CHECK(std::sqrt(laser_squares / n) == doctest::Approx(0.01).scale(0).epsilon(0.02));
    CHECK(different > n / 2);
  }

  TEST_CASE("from its time on a lost sensor says nothing, a stuck one the same, a biased one too much") {
    HelicopterParameters parameters;
    const auto readings = [&](FailureKind kind) {
      parameters.failures.sonar = {kind, 2, 0.3};
      HelicopterSensors sensors(parameters, 1);
      std::vector<std::pair<bool, int>> all;
      for (int second = 0; second < 4; ++second) {
        sensors.sample(second * 1000 * ms, level(0, 0, -1 - 0.1 * second));
        const JaviatorData data = sensors.answer(0);
        all.emplace_back((data.flags & JaviatorData::Flags::SONAR) != 0, data.sonar);
      }
      return all;
    };
    using Readings = std::vector<std::pair<bool, int>>;
    CHECK(readings(FailureKind::none) == Readings{{true, 322}, {true, 356}, {true, 390}, {true, 424}});
    CHECK(readings(FailureKind::lost) == Readings{{true, 322}, {true, 356}, {false, 356}, {false, 356}});
    CHECK(readings(FailureKind::stuck) == Readings{{true, 322}, {true, 356}, {true, 356}, {true, 356}});
    CHECK(readings(FailureKind::biased) == Readings{{true, 322}, {true, 356}, {true, 493}, {true, 527}});
  }

  TEST_CASE(
      "a drifting sensor is wrong by more each second, a jumping one in every second reading, a noisy one all around") {
    const auto readings = [](const SensorFailure& failure) {
      HelicopterParameters parameters;
      parameters.noise.sonar = 0.01;
      parameters.failures.sonar = failure;
      HelicopterSensors sensors(parameters, 1);
      std::vector<double> all;
      for (int i = 0; i < 4000; ++i) {
        sensors.sample(50 * i * ms, level(0, 0, -1.555));
        all.push_back(sensors.answer(0).sonar * 3 / 1024.0 - 1.5);
      }
      return all;
    };
    const auto drifting = readings({FailureKind::drifting, 100, 0.01});
    CHECK(std::abs(drifting[1999]) < 0.03);
    CHECK(drifting[3999] == doctest::Approx(0.01 * 99.95).scale(0).epsilon(0.03));
    int up = 0, down = 0;
    for (const double off : readings({FailureKind::jumping, 0, 0.5})) {
      up += off > 0.4 ? 1 : 0;
      down += off < -0.4 ? 1 : 0;
    }
    CHECK(up == doctest::Approx(1000).scale(0).epsilon(0.1));
    CHECK(down == doctest::Approx(1000).scale(0).epsilon(0.1));
    const auto spread = [&](const SensorFailure& failure) {
      double squares = 0;
      for (const double off : readings(failure)) squares += off * off / 4000;
      return std::sqrt(squares);
    };
    CHECK(spread({FailureKind::noisy, 0, 10}) / spread({}) == doctest::Approx(10).scale(0).epsilon(0.1));
  }

  TEST_CASE("biases of every axis wander as far in 100 s as they are said to, each by itself") {
    constexpr double rate_unit = 8.5 / 32768, force_unit = 9.81 / 4681;
    double products[6][6] = {};  // of each with each
    constexpr int flights = 400;
    for (std::uint64_t seed = 0; seed < flights; ++seed) {
      HelicopterParameters parameters;
      parameters.noise.rate_drift = 0.1;
      parameters.noise.force_drift = 0.5;
      HelicopterSensors sensors(parameters, seed);
      for (int second = 0; second <= 100; ++second) sensors.sample_imu(second * 1000 * ms, level(0, 0, 0));
      const JaviatorData data = sensors.answer(0);
      const double biases[6] = {data.droll * rate_unit, data.dpitch * rate_unit, data.dyaw * rate_unit,
                                data.ddx * force_unit,  data.ddy * force_unit,   data.ddz * force_unit + 9.81};
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j <= i; ++j) products[i][j] += biases[i] * biases[j] / flights;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      CAPTURE(i);
      CHECK(std::sqrt(products[i][i]) == doctest::Approx(i < 3 ? 0.1 : 0.5).scale(0).epsilon(0.1));
      for (std::size_t j = 0; j < i; ++j) {
        CAPTURE(j);
        CHECK(std::abs(products[i][j]) < 0.2 * std::sqrt(products[i][i] * products[j][j]));
      }
    }
  }

  TEST_CASE("a helicopter that is driven reports what its sensors measure, in SI units") {
    vehicles::Helicopter helicopter(vehicles::HelicopterParameters{});
    const auto& sensors = static_cast<const vehicles::HelicopterOutputs*>(helicopter.outputs())->sensors;
    CHECK(std::isnan(sensors.sonar));  // nobody has asked yet
    const vehicles::HelicopterInputs still{};
    for (int i = 0; i < 40; ++i) {
      helicopter.command(&still);
      helicopter.step();
    }
    CHECK(sensors.ddz == doctest::Approx(-9.81).scale(0).epsilon(0.02));
    CHECK(sensors.pressure == doctest::Approx(101325).scale(0).epsilon(0.001));
    CHECK(sensors.temperature == doctest::Approx(25).scale(0).epsilon(0.01));
    CHECK(sensors.voltage == doctest::Approx(helicopter.voltage()).scale(0).epsilon(0.01));
    CHECK(sensors.x_laser == doctest::Approx(8).scale(0).epsilon(0.05));
    CHECK(std::abs(sensors.roll) < 0.02);
  }
}
