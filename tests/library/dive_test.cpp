#include <doctest/doctest.h>
#include <jarol/session.h>
#include <jarol/tasks/values/lauv.h>

using namespace std::chrono_literals;
using jarol::tasks::Motion, jarol::tasks::Setpoint;

TEST_CASE("the submarine is at three metres after half a minute, and never below 3.2") {
  auto session = jarol::open(SPECS "/exolauv.yaml", {.set = {"tasks.depth.parameters.kp=0.4"}, .seed = 7});
  session.watch("navigation.*");
  session.run_until(30s);
  CHECK(session.true_value("depth of dune") == doctest::Approx(3).epsilon(0.02));
  for (const auto& [instant, depth] : session.samples<double>("navigation.motion.z")) CHECK(depth < 3.2);
}

TEST_CASE("above its depth it noses down, without a vehicle") {
  auto session = jarol::open_text(R"(
    graph: depth_alone
    timing: {period: 50ms}
    communicators: {motion: {type: Motion, direction: in}, setpoint: {type: Setpoint, direction: in}}
    tasks: {depth: {type: DepthControl, wcet: 100us}}
    connections: [motion -> depth.motion, setpoint -> depth.setpoint])",
                                  {.fed = {"*"}});
  session.feed("motion", Motion{.z = 1.0});
  session.feed("setpoint", Setpoint{.depth = 3.0});
  session.run_for(50ms);
  CHECK(session.value<double>("depth.moment.angle") < 0);
}
