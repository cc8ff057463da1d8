// Ranges of lasers that are fixed to a turning body, in a room that is not.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "vehicles/helicopter/sensors.h"

namespace {
using namespace jarol::vehicles;

HelicopterSensors::Scene turned(double north, double east, double roll, double yaw) {
  HelicopterSensors::Scene scene;
  scene.motion.p_n = {north, east, -0.7};
  const double cr = std::cos(roll), sr = std::sin(roll), cy = std::cos(yaw), sy = std::sin(yaw);
  scene.motion.R_nb = {{{cy, -sy * cr, sy * sr}, {sy, cy * cr, -cy * sr}, {0, sr, cr}}};
  return scene;
}

// mm ahead and to the right
std::pair<int, int> ranges(const HelicopterSensors::Scene& scene, const HelicopterParameters& parameters = {}) {
  HelicopterSensors sensors(parameters, 1);
  sensors.sample(0, scene);
  const auto data = sensors.answer(0);
  const auto number = [](const auto& digits) { return std::stoi(std::string(digits.begin(), digits.end() - 1)); };
  return {number(data.x_pos), number(data.y_pos)};
}

// As far as one can go in small steps without leaving the room.
double march(const SensorParameters& room, fossen::Vector3 at, const fossen::Vector3& direction) {
  double way = 0;
  const auto inside = [&] {
    return at[0] <= room.wall_north && at[0] >= -room.wall_south && at[1] <= room.wall_east && at[1] >= -room.wall_west;
  };
  for (; inside() && way < 200; way += 1e-3)
    for (std::size_t i = 0; i < 3; ++i) at[i] += 1e-3 * direction[i];
  return way;
}
}  // namespace

TEST_SUITE("vehicles/helicopter_lasers") {
  TEST_CASE("where the recorded vehicle was it reads what that reported: turned by 314 and 145 mrad, rolled by 75") {
    const auto [ahead, right] = ranges(turned(-0.003, 4.618, 0, -0.3141));
    CHECK(std::abs(ahead - 8461) <= 3);
    CHECK(std::abs(right - 3649) <= 3);
    CHECK(std::abs(ranges(turned(-0.004, 4.618, 0, -0.1451)).first - 8148) <= 3);
    CHECK(std::abs(ranges(turned(0, 0.4325, 0.0751, 0)).second - 7669) <= 3);
  }

  TEST_CASE("a ray ends where one that goes step by step leaves the room") {
    const SensorParameters room{.wall_north = 7, .wall_east = 5, .wall_south = 11, .wall_west = 9};
    for (int i = 0; i < 300; ++i) {
      const double yaw = 0.7 * i, down = 0.8 * std::sin(1.3 * i), level = std::cos(down);
      const fossen::Vector3 from = {6 * std::sin(2.1 * i), 4 * std::cos(3.7 * i), -1};
      const fossen::Vector3 direction = {level * std::cos(yaw), level * std::sin(yaw), std::sin(down)};
      CHECK(cast_ray(room, from, direction) == doctest::Approx(march(room, from, direction)).scale(0).epsilon(1e-3));
    }
  }

  TEST_CASE("at each quarter of a turn the other wall is seen") {
    constexpr double quarter = 1.5707963267948966;
    CHECK(ranges(turned(0, 0, 0, 0)) == std::pair(8070, 8077));
    CHECK(ranges(turned(0, 0, 0, quarter)) == std::pair(8070, 12077));
    CHECK(ranges(turned(0, 0, 0, 2 * quarter)) == std::pair(12070, 12077));
    CHECK(ranges(turned(0, 0, 0, -quarter)) == std::pair(12070, 8077));
  }

  TEST_CASE("beyond its reach, and outside of the room, a laser reads 0") {
    HelicopterParameters parameters;
    parameters.sensors.laser_reach = 8.075;
    CHECK(ranges(turned(0, 0, 0, 0), parameters) == std::pair(8070, 0));
    CHECK(ranges(turned(8.1, 0, 0, 0)).first == 0);
    parameters.failures.laser_east = {FailureKind::biased, 0, 1};
    CHECK(ranges(turned(0, 0, 0, 0), parameters).second == 0);
  }

  TEST_CASE("each laser has noise of its own, which the other's failure does not change") {
    const auto right_of = [](FailureKind kind) {
      HelicopterParameters parameters;
      parameters.noise.laser = 0.05;
      parameters.failures.laser_north.kind = kind;
      HelicopterSensors sensors(parameters, 1);
      std::vector<std::string> all;
      for (int i = 0; i < 20; ++i) {
        sensors.sample(40'000'000LL * i, turned(0, 0, 0, 0));
        const auto data = sensors.answer(0);
        all.emplace_back(data.y_pos.begin(), data.y_pos.end() - 1);
      }
      return all;
    };
    CHECK(right_of(FailureKind::none) == right_of(FailureKind::lost));
  }
}
