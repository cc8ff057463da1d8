#include <doctest/doctest.h>
#include <jarol/session.h>

using namespace std::chrono_literals;

TEST_CASE("the submarine is at three metres after half a minute, and never below 3.2") {
  auto session = jarol::open(SPECS "/exolauv.yaml", {.set = {"tasks.depth.parameters.kp=0.4"}, .seed = 7});
  session.watch("navigation.*");
  session.run_until(30s);
  CHECK(session.true_value("depth of dune") == doctest::Approx(3).epsilon(0.02));
  for (const auto& [instant, depth] : session.samples<double>("navigation.motion.z")) CHECK(depth < 3.2);
}
