// Where the submarine believes it is, by what it has on board, against where it truly is.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tasks/values/guidance.h"
#include "tasks/values/lauv.h"
#include "tests/how_many.h"
#include "tools/library/session.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// What of the place and the current it does not know after 100 s.
struct Lost {
  double place = 0, current = 0, deviation = 0;
};

Lost after_100_s(const std::string& profile, double north, double east, std::uint64_t seed,
                 std::vector<std::string> set = {}) {
  const std::string vehicle = "distributers.dune.link.parameters.";
  set.push_back("expect=nothing");
  set.push_back(vehicle + "dynamics=rigid");
  set.push_back(vehicle + "sea.current_north=" + std::to_string(north));
  set.push_back(vehicle + "sea.current_east=" + std::to_string(east));
  auto session = jarol::open("specs/exolauv.yaml", {.profile = profile, .set = set, .seed = seed});
  session.run_until(102s);  // under water from 2 s on
  const auto motion = session.value<tasks::Motion>("navigation.motion");
  const auto stream = session.value<tasks::Stream>("navigation.stream");
  return {std::hypot(motion.x - session.true_value("x of dune"), motion.y - session.true_value("y of dune")),
          std::hypot(stream.north - north, stream.east - east),
          session.value<tasks::PlaceAccuracy>("navigation.accuracy").deviation};
}
}  // namespace

TEST_SUITE("tools/lauv_navigation") {
  TEST_CASE("after 100 s in 0.3 m/s of current it knows its place within 3 m, by two transponders") {
    for (const auto& [north, east] : {std::pair{0.3, 0.0}, {-0.3, 0.0}, {0.0, 0.3}, {0.0, -0.3}}) {
      CAPTURE(north);
      CAPTURE(east);
      const Lost calm = after_100_s("", north, east, 0);
      CHECK(calm.place < 0.5);
      CHECK(calm.current < 0.02);
      const std::uint64_t seeds = tests::how_many(5, 100);
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        CAPTURE(seed);
        const Lost at_sea = after_100_s("at_sea", north, east, seed);
        CHECK(at_sea.place < 3);
        CHECK(at_sea.current < 0.1);
        CHECK(at_sea.deviation < 2);
      }
    }
  }

  TEST_CASE("without transponders it drifts off with the current, and says how little it knows") {
    const Lost lost = after_100_s("", 0.3, 0, 0, {"distributers.dune.link.parameters.sea.beacons.reach=0 m"});
    CHECK(lost.place > 5);
    CHECK(lost.deviation > 5);
  }

  TEST_CASE("a transponder that jumps is left out") {
    const std::string failure = "distributers.dune.link.parameters.sensors.range.failure.";
    const Lost jumps =
        after_100_s("at_sea", 0, 0.3, 1, {failure + "kind=jumping", failure + "at=20s", failure + "by=30"});
    CHECK(jumps.place < 4);
  }

  TEST_CASE("a start elsewhere is no other origin: the place is that of plans") {
    const std::string start = "distributers.dune.link.parameters.start.";
    const Lost lost = after_100_s("", 0, 0.3, 0, {start + "north=40 m", start + "east=-25 m"});
    CHECK(lost.place < 0.5);
  }
}
