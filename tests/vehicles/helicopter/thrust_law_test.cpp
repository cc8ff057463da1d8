#include "vehicles/helicopter/thrust_law.h"

#include <doctest/doctest.h>

#include <cmath>

using jarol::vehicles::ThrustLaw;

TEST_SUITE("vehicles/thrust_law") {
  TEST_CASE("a setting has the same thrust whatever was asked for before, to the bit") {
    const ThrustLaw law(1.415);
    const double settings[] = {0.5, 0.25, 0.5, 1.0, 0.0, 0.75, 0.5, 0.25, 0.75, 0.1, 0.2, 0.3, 0.4, 0.5, 0.1};
    for (int round = 0; round < 3; ++round)
      for (const double setting : settings) CHECK(law.part(setting) == std::pow(setting, 1.415));
    CHECK(law.part(1.0) == 1.0);
    CHECK(law.part(0.0) == 0.0);
    CHECK(std::isnan(law.part(std::nan(""))));
    CHECK(law.part(0.5) == std::pow(0.5, 1.415));
  }

  TEST_CASE("a copy goes on by itself") {
    const ThrustLaw law(2.0);
    CHECK(law.part(0.5) == 0.25);
    ThrustLaw other = law;
    CHECK(other.part(0.5) == 0.25);
    other = ThrustLaw(1.0);
    CHECK(other.part(0.5) == 0.5);
    CHECK(law.part(0.5) == 0.25);
  }
}
