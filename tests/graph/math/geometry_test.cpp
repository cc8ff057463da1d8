#include "graph/math/geometry.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol;
using namespace std::chrono_literals;

TEST_SUITE("graph/math/geometry") {
  TEST_CASE("an angle is wrapped from -pi to pi, a value limited to both sides") {
    CHECK(wrapped(3 * pi / 2) == doctest::Approx(-pi / 2));
    CHECK(wrapped(-3 * pi / 2) == doctest::Approx(pi / 2));
    CHECK(wrapped(0.5 + 200 * pi) == doctest::Approx(0.5));
    CHECK(std::abs(wrapped(pi)) == pi);
    CHECK(limited(3, 2) == 2);
    CHECK(limited(-3, 2) == -2);
    CHECK(limited(-1.5, 2) == -1.5);
    CHECK(seconds(1500ms) == 1.5);
    CHECK(180 * degree == pi);
  }

  // as tables of degrees of WGS-84 have them, in km
  TEST_CASE("a degree of latitude and of longitude is as long as on the ellipsoid") {
    struct Row {
      double latitude, north, east;
    };
    const Row rows[] = {{0, 110.574, 111.320}, {15, 110.649, 107.550}, {30, 110.852, 96.486}, {45, 111.132, 78.847},
                        {60, 111.412, 55.800}, {75, 111.618, 28.902},  {90, 111.694, 0}};
    for (const Row& row : rows) {
      const EarthRadii radii = earth_radii(row.latitude * degree);
      CHECK(std::abs(radii.north * degree / 1000 - row.north) < 6e-4);
      CHECK(std::abs(radii.east * degree / 1000 - row.east) < 6e-4);
    }
  }
}
}  // namespace
