// The submarine with the numbers of DUNE's simulator: under the shipped graph's tasks, and under DUNE's own law of
// roll.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle_file.h"
#include "graph/math/geometry.h"
#include "tasks/values/alarm.h"
#include "tasks/values/lauv.h"
#include "tools/library/built_in.h"
#include "tools/library/session.h"
#include "vehicles/submarine/submarine.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
using namespace std::chrono_literals;

// The depth that it is at in the end, and how long the fins were at their limit.
struct Dive {
  double depth = 0, at_limit = 0;
};
Dive dive(std::vector<std::string> set) {
  set.insert(set.begin(), "distributers.dune.link.parameters.dynamics=rigid");
  auto session = jarol::open("specs/exolauv.yaml", {.profile = "submarine_dune", .set = set});
  Dive done;
  while (session.now() < session.end_of_mission()) {
    session.run_for(50ms);
    if (std::abs(session.value<tasks::Moment>("depth.moment").angle) > 24.9 * degree) done.at_limit += 0.05;
  }
  done.depth = session.true_value("depth of dune");
  return done;
}

// The alarm of a dive at that speed that turns, up and down, by 90 to 180 degrees at a time and then in circles.
tasks::Alarm alarm_of_turns(const std::string& profile, double speed) {
  auto session = jarol::open("specs/exolauv.yaml", {.profile = profile, .fed = {"neptus"}});
  const auto sail = [&](Duration time, double depth, double heading, tasks::Turn turn, double rate) {
    session.feed("neptus.setpoint", tasks::Setpoint{depth, heading * degree, speed, turn, rate * degree});
    session.run_for(time);
  };
  sail(15s, 3, 90, tasks::Turn::heading, 0);
  sail(10s, 6, 180, tasks::Turn::heading, 0);
  sail(10s, 2, 0, tasks::Turn::heading, 0);
  sail(15s, 8, 0, tasks::Turn::rate, 20);
  sail(15s, 2, 0, tasks::Turn::rate, -20);
  return session.value<tasks::Condition>("supervisor.condition").alarm;
}

// DUNE's laws of roll and pitch (P 2.1, D 0.4 s; 1.5, 1.1 s; at 20 Hz, a period behind, as over a link) hold it upright
// and level; how far it rolls 10 s after a turn of 10 s.
double roll_under_dune(double radius) {
  Problems problems;
  const auto file =
      distributers::read_vehicle_file(read_source("specs/vehicles/submarine_dune.yaml"), built_in().vehicles, problems);
  problems.throw_if_any();
  SubmarineParameters parameters = *static_cast<const SubmarineParameters*>(file->parameters.data());
  parameters.fins.radius = radius;
  parameters.start.depth = 10;
  parameters.start.surge = 1.2;
  Submarine submarine(parameters);
  double worst = 0;
  SubmarineInputs next{};
  for (int i = 0; i < 4000; ++i) {
    if (i % 5 == 0) {
      submarine.command(&next);
      const auto s = submarine.state();
      const double theta_dot = s.q * std::cos(s.phi) - s.r * std::sin(s.phi);
      const double m = limited(-1.5 * s.theta - 1.1 * theta_dot, 25 * degree);
      const double k = limited(-2.1 * s.phi - 0.4 * s.p, 25 * degree - std::abs(m));
      const double n = i < 1000 ? 5 * degree : 0;
      next = {0.5, -n - k, -m + k, -m - k, -n + k};
    }
    submarine.step();
    if (i > 2000) worst = std::max(worst, std::abs(submarine.state().phi));
  }
  return worst;
}
}  // namespace

TEST_SUITE("tools/dune_vehicle") {
  TEST_CASE("it dives to 3 m and holds them, as in DUNE's simulator; with a hull of 2 m it can't get its nose under") {
    const Dive done = dive({});
    CHECK(done.depth == doctest::Approx(3).scale(0).epsilon(0.01));
    CHECK(done.at_limit < 10);
    const Dive stuck = dive({"distributers.dune.link.parameters.hull={length: 2, diameter: 0.11}"});
    CHECK(stuck.depth < 0.1);
    CHECK(stuck.at_limit > 80);
  }

  TEST_CASE("its speed log and its propeller fit each other at any speed, in turns and dives, too") {
    for (const char* profile : {"submarine_dune", "submarine_vsim"})
      for (const double speed : {0.5, 1.2, 1.79}) {
        CAPTURE(profile);
        CAPTURE(speed);
        CHECK(alarm_of_turns(profile, speed) == tasks::Alarm::none);
      }
  }

  TEST_CASE("DUNE's law of roll leaves it upright; with fins that roll it as they stand it never comes to rest") {
    CHECK(roll_under_dune(0) < 1 * degree);
    CHECK(roll_under_dune(0.08) > 20 * degree);
  }
}
