#include <doctest/doctest.h>
#include <jarol/session.h>
#include <jarol/tasks/values/lauv.h>

using namespace std::chrono_literals;
using jarol::tasks::Motion, jarol::tasks::Setpoint;

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
