#include "vehicles/sea/waves.h"
#include "graph/text/errors.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace {
using jarol::vehicles::Water;
using jarol::vehicles::Waves;
}  // namespace

TEST_SUITE("vehicles/waves") {
  TEST_CASE("the surface rises and falls by half the height, once a period") {
    const Waves waves(0.6, 4, 0);
    CHECK(waves.at({0, 0, 0}, 0).surface == doctest::Approx(-0.3));
    CHECK(waves.at({0, 0, 0}, 2).surface == doctest::Approx(0.3));
    CHECK(waves.at({0, 0, 0}, 4).surface == doctest::Approx(-0.3));
  }

  TEST_CASE("crests run where they are said to run, at the speed of deep water") {
    const Waves waves(0.6, 4, 1.5707963267948966);
    const double speed = 9.81 * 4 / (2 * 3.14159265358979);
    CHECK(waves.at({0, speed * 1.3, 0}, 1.3).surface == doctest::Approx(-0.3));
    CHECK(waves.at({5, speed * 1.3, 0}, 1.3).surface == doctest::Approx(-0.3));
  }

  TEST_CASE("the surface moves with the water in it") {
    const Waves waves(0.01, 4, 0.7);
    const double rate = (waves.at({1, 2, 0}, 3.0001).surface - waves.at({1, 2, 0}, 2.9999).surface) / 0.0002;
    CHECK(waves.at({1, 2, 0}, 3).velocity_n[2] == doctest::Approx(rate).scale(0).epsilon(0.01));
  }

  TEST_CASE("half a wave length down the motion is 4 % of that at the surface") {
    const Waves waves(0.2, 4, 0);
    const double length = 9.81 * 16 / (2 * 3.14159265358979);
    const double above = waves.at({0, 0, 0}, 0).velocity_n[0], below = waves.at({0, 0, length / 2}, 0).velocity_n[0];
    CHECK(below / above == doctest::Approx(std::exp(-3.14159265358979)));
  }

  TEST_CASE("the acceleration is that of the water on its way") {
    const Waves waves(1, 6, 0.4);
    const Water now = waves.at({1, 2, 0.5}, 3);
    const auto& v = now.velocity_n;
    const double h = 1e-5;
    const Water later = waves.at({1 + h * v[0], 2 + h * v[1], 0.5 + h * v[2]}, 3 + h);
    const Water before = waves.at({1 - h * v[0], 2 - h * v[1], 0.5 - h * v[2]}, 3 - h);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(now.acceleration_n[i] ==
            doctest::Approx((later.velocity_n[i] - before.velocity_n[i]) / (2 * h)).scale(0).epsilon(1e-6));
  }

  TEST_CASE("waves that would break are refused") {
    CHECK_THROWS_WITH_AS(Waves(2, 2, 0),
                         "waves of this sea.wave_height and sea.wave_period would break; they are steeper than 1 in 7",
                         jarol::InputError);
    CHECK_THROWS_WITH_AS(Waves(-1, 5, 0), "sea.wave_height must not be below zero", jarol::InputError);
    CHECK_THROWS_WITH_AS(Waves(1, 0, 0), "sea.wave_period must be above zero", jarol::InputError);
  }
}
