// The shipped missions with dynamics: rigid end where they do in Simbody.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tools/library/session.h"

namespace {
using namespace std::chrono_literals;

// The greatest difference of true places, over a mission, second by second.
double apart(const std::string& mission, const std::string& profile) {
  const auto opened = [&](const std::string& dynamics) {
    return jarol::open("specs/exolauv.yaml", {.profile = profile,
                                              .set = {"distributers.neptus.link.file=missions/" + mission,
                                                      "distributers.dune.link.parameters.dynamics=" + dynamics},
                                              .seed = 7});
  };
  jarol::Session simbody = opened("simbody"), rigid = opened("rigid");
  double most = 0;
  while (simbody.now() < simbody.end_of_mission()) {
    simbody.run_for(1s);
    rigid.run_for(1s);
    for (const std::string field : {"x", "y", "depth", "speed", "roll", "pitch"})
      most = std::max(most, std::abs(simbody.true_value(field + " of dune") - rigid.true_value(field + " of dune")));
  }
  return most;
}
}  // namespace

TEST_SUITE("tools/rigid_dynamics") {
  TEST_CASE("every mission of the submarine goes the same way with both dynamics") {
    double most = 0;
    for (const std::string mission : {"deep.csv", "dive.csv", "forward.csv", "late.csv", "lost_operator.csv"})
      for (const std::string profile : {"", "at_sea"}) {
        CAPTURE(mission);
        CAPTURE(profile);
        const double here = apart(mission, profile);
        CHECK(here < 1e-5);  // what sensors tell has 32 bits, and rounds small differences to none or to great ones
        most = std::max(most, here);
      }
    MESSAGE("at most " << most << " m, m/s or rad apart");
  }
}
