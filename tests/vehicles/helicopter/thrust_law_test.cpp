#include "vehicles/helicopter/thrust_law.h"

#include <doctest/doctest.h>

#include <cmath>

using jarol::vehicles::ThrustLaw;

TEST_SUITE("vehicles/thrust_law") {
  TEST_CASE("settings have the same thrusts whatever was asked for before, to the bit") {
    const ThrustLaw law(1.415);
    const double settings[] = {0.5, 0.25, 0.5, 1.0, 0.0, 0.75, 0.5, 0.25, 0.75, 0.1, 0.2, 0.3, 0.4, 0.5, 0.1};
    for (int round = 0; round < 3; ++round)
      for (const double setting : settings) {
        const ThrustLaw::Rotors all{setting, 0.5, 0.25, 0.125 * round}, parts = law.parts(all);
        for (std::size_t i = 0; i < 4; ++i) CHECK(parts[i] == std::pow(all[i], 1.415));
      }
    const ThrustLaw::Rotors ends = law.parts({1.0, 0.0, std::nan(""), 0.5});
    CHECK(ends[0] == 1.0);
    CHECK(ends[1] == 0.0);
    CHECK(std::isnan(ends[2]));
    CHECK(ends[3] == std::pow(0.5, 1.415));
    CHECK(law.parts({0.5, 0.5, 0.5, 0.5}) == ThrustLaw::Rotors{ends[3], ends[3], ends[3], ends[3]});
  }

  TEST_CASE("a copy goes on by itself") {
    const ThrustLaw::Rotors halves{0.5, 0.5, 0.5, 0.5}, quarters{0.25, 0.25, 0.25, 0.25};
    const ThrustLaw law(2.0);
    CHECK(law.parts(halves) == quarters);
    ThrustLaw other = law;
    CHECK(other.parts(halves) == quarters);
    other = ThrustLaw(1.0);
    CHECK(other.parts(halves) == halves);
    CHECK(law.parts(halves) == quarters);
  }
}
