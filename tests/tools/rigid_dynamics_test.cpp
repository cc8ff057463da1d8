// The shipped missions with dynamics: rigid end where they do in Simbody.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tools/library/session.h"

namespace {
using namespace std::chrono_literals;

// The greatest difference of true values, over a mission, second by second.
double apart(jarol::Session simbody, jarol::Session rigid, const std::vector<std::string>& values) {
  double max = 0;
  while (simbody.now() < simbody.end_of_mission()) {
    simbody.run_for(1s);
    rigid.run_for(1s);
    for (const std::string& value : values)
      max = std::max(max, std::abs(simbody.true_value(value) - rigid.true_value(value)));
  }
  return max;
}

double dives_apart(const std::string& mission, const std::string& profile) {
  const auto opened = [&](const std::string& dynamics) {
    return jarol::open("specs/exolauv.yaml", {.profile = profile,
                                              .set = {"distributers.neptus.link.file=missions/" + mission,
                                                      "distributers.dune.link.parameters.dynamics=" + dynamics},
                                              .seed = 7});
  };
  return apart(opened("simbody"), opened("rigid"),
               {"x of dune", "y of dune", "depth of dune", "speed of dune", "roll of dune", "pitch of dune"});
}

double flights_apart(const std::string& mission, const std::string& profile) {
  const auto opened = [&](const std::string& dynamics) {
    std::vector<std::string> set{"distributers.robostix.link.parameters.dynamics=" + dynamics};
    if (!mission.empty()) set.push_back("distributers.terminal.link.file=missions/" + mission);
    return jarol::open("specs/javiator.yaml", {.profile = profile, .set = set, .seed = 7});
  };
  return apart(opened("simbody"), opened("rigid"),
               {"x of robostix", "y of robostix", "altitude of robostix", "climb of robostix", "roll of robostix",
                "pitch of robostix", "yaw of robostix"});
}
}  // namespace

TEST_SUITE("tools/rigid_dynamics") {
  TEST_CASE("every mission of the submarine goes the same way with both dynamics") {
    double max = 0;
    for (const std::string mission : {"deep.csv", "dive.csv", "forward.csv", "late.csv", "lost_operator.csv"})
      for (const std::string profile : {"", "at_sea"}) {
        CAPTURE(mission);
        CAPTURE(profile);
        const double here = dives_apart(mission, profile);
        CHECK(here < 1e-5);  // what sensors report has 32 bits, and rounds small differences to none or to great ones
        max = std::max(max, here);
      }
    MESSAGE("at most " << max << " m, m/s or rad apart");
  }

  TEST_CASE("every flight of the helicopter goes the same way with both dynamics") {
    double max = 0;
    const auto check = [&](const std::string& mission, const std::string& profile) {
      CAPTURE(mission);
      CAPTURE(profile);
      const double here = flights_apart(mission, profile);
      // what sensors measure is counted, and what falls between two counts goes to either
      CHECK(here < 1e-3);
      max = std::max(max, here);
    };
    for (const std::string profile : {"", "wind", "v2"})
      for (const std::string mission : {"hover.csv", "failing.csv"}) check(mission, profile);
    check("", "original");
    MESSAGE("at most " << max << " m, m/s or rad apart");
  }
}
