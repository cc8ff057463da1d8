// Wind: shear, one gust, and Dryden's gusts against the spectra of MIL-F-8785C (1980), section 3.7.
#include "vehicles/air/wind.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/how_many.h"

namespace {
using namespace jarol::vehicles;
namespace tests = jarol::tests;

constexpr double T = 1.0;      // s, scale length over airspeed
constexpr double sigma = 0.8;  // m/s
constexpr double dt = 0.02;    // s

struct Gusts {
  std::vector<double> along, across, down;
};

// Along and across the mean wind.
Gusts blow(std::size_t samples, double north, double east) {
  AirParameters air;
  air.north = north;
  air.east = east;
  air.gusts = sigma;
  air.gust_time = T;
  air.dryden = true;
  Wind wind(air, 3);
  Gusts gusts;
  for (std::size_t i = 0; i < samples; ++i) {
    wind.step(dt);
    const fossen::Vector3 now = wind.now(1);
    const double speed = std::hypot(north, east);
    gusts.along.push_back((north * now[0] + east * now[1]) / speed - speed);
    gusts.across.push_back((north * now[1] - east * now[0]) / speed);
    gusts.down.push_back(now[2]);
  }
  return gusts;
}

constexpr std::size_t segment = 2500;  // samples, 50 s

// Two-sided density at omega = 2 pi bin / (segment dt), so that its integral over omega / (2 pi) is the variance: the
// mean over Hann-windowed segments (Welch, 1967).
double density(const std::vector<double>& x, std::size_t bin) {
  std::vector<std::complex<double>> weights;
  for (std::size_t i = 0; i < segment; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(segment);
    weights.push_back(0.5 * (1 - std::cos(turn)) * std::polar(1.0, -turn * static_cast<double>(bin)));
  }
  double sum = 0;
  std::size_t segments = 0;
  for (std::size_t from = 0; from + segment <= x.size(); from += segment, ++segments) {
    std::complex<double> part = 0;
    for (std::size_t i = 0; i < segment; ++i) part += x[from + i] * weights[i];
    sum += std::norm(part) * dt / (0.375 * static_cast<double>(segment));
  }
  return sum / static_cast<double>(segments);
}

double mean_square(const std::vector<double>& x) {
  double sum = 0;
  for (const double each : x) sum += each * each;
  return sum / static_cast<double>(x.size());
}
}  // namespace

TEST_SUITE("vehicles/wind") {
  TEST_CASE("a wind over rough ground grows with the logarithm of the height, a gust comes and goes") {
    AirParameters air;
    air.north = 10;
    air.roughness = 0.1;
    air.wind_height = 10;
    air.gust = {.east = 4, .at = 1, .time = 2};
    Wind wind(air, 1);
    CHECK(wind.now(10)[0] == doctest::Approx(10));
    CHECK(wind.now(1)[0] == doctest::Approx(5));
    CHECK(wind.now(0.05)[0] == 0);
    wind.step(1.5);
    CHECK(wind.now(10)[1] == doctest::Approx(2));
    wind.step(0.5);
    CHECK(wind.now(10)[1] == doctest::Approx(4));
    wind.step(1.1);
    CHECK(wind.now(10)[1] == 0);
  }

  TEST_CASE(
      "gusts of Dryden's model have its deviation and spectra wherever the wind blows: of first order along the wind, "
      "of second order with a zero across it and vertically") {
    std::vector<std::pair<double, double>> winds{{-2, 2}};
    if (!tests::tries_less) winds.insert(winds.end(), {{3, 0}, {0, 3}});
    for (const auto& [north, east] : winds) {
      CAPTURE(north);
      CAPTURE(east);
      const Gusts gusts = blow(tests::how_many<std::size_t>(1'000'000, 1'000'000, 500'000), north, east);
      for (const auto* axis : {&gusts.along, &gusts.across, &gusts.down})
        CHECK(std::sqrt(mean_square(*axis)) == doctest::Approx(sigma).scale(0).epsilon(0.03));
      for (const std::size_t bin : {3, 8, 16, 40}) {
        CAPTURE(bin);
        const double wT = 2 * std::numbers::pi * static_cast<double>(bin) / (segment * dt) * T, square = wT * wT;
        const double first = 2 * sigma * sigma * T / (1 + square);
        const double second = sigma * sigma * T * (1 + 3 * square) / ((1 + square) * (1 + square));
        // 400 segments: 5 % of standard error; 200: 7 %
        CHECK(density(gusts.along, bin) == doctest::Approx(first).scale(0).epsilon(0.2));
        CHECK(density(gusts.across, bin) == doctest::Approx(second).scale(0).epsilon(0.2));
        CHECK(density(gusts.down, bin) == doctest::Approx(second).scale(0).epsilon(0.2));
      }
    }
  }

  TEST_CASE("a gust by chance begins after a time that is drawn at its rate, not before it may, and blows once") {
    constexpr int winds = 1000;
    double sum = 0, squares = 0;
    for (int seed = 0; seed < winds; ++seed) {
      AirParameters air;
      air.gust = {.east = 4, .at = 2, .chance = 0.5, .time = 1};
      Wind wind(air, static_cast<std::uint64_t>(seed));
      double begin = 0;
      while (wind.now(1)[1] == 0 && begin < 100) {
        wind.step(dt);
        begin += dt;
      }
      CHECK(begin > 2);
      sum += begin - 2;
      squares += (begin - 2) * (begin - 2);
      double max = 0;
      for (double time = 0; time < 1.1; time += dt) {
        max = std::max(max, wind.now(1)[1]);
        wind.step(dt);
      }
      CHECK(max == doctest::Approx(4).scale(0).epsilon(0.01));
      double again = 0;
      for (double time = 0; time < 20; time += 0.1) {
        again = std::max(again, wind.now(1)[1]);
        wind.step(0.1);
      }
      CHECK(again == 0);
    }
    // an exponential distribution has its mean as deviation
    CHECK(sum / winds == doctest::Approx(2).scale(0).epsilon(0.1));
    CHECK(std::sqrt(squares / winds - sum / winds * sum / winds) == doctest::Approx(2).scale(0).epsilon(0.15));
  }
}
