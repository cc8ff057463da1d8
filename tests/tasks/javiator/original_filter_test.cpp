// When the JAviator's own filter takes what it hears for that of a vehicle that stands.
#include "tasks/javiator/original_filter.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;
}  // namespace

TEST_SUITE("tasks/original_filter") {
  TEST_CASE("locked in the air it does not count as standing until its rotors have run down") {
    for (const FlightState locked : {FlightState::halt, FlightState::ground}) {
      OriginalFilter::State state;
      OriginalFilter::Out out;
      OriginalFilter::In in{.sensors = {.a_z = -9.81, .sonar = 0.1, .new_sonar = true},
                            .directive = {.state = FlightState::ground}};
      const auto run = [&](int periods) {
        for (int i = 0; i < periods; ++i) {
          ++in.sensors.answers;
          OriginalFilter::run({}, {.period = 15ms}, in, state, out);
        }
        return out.estimate.altitude;
      };
      CHECK(run(10) == 0);
      in.directive.state = FlightState::flying;
      for (int i = 1; i <= 100; ++i) {
        in.sensors.sonar = 0.1 + 0.01 * i;
        run(1);
      }
      CHECK(run(100) == doctest::Approx(1).scale(0).epsilon(0.01));
      in.directive.state = locked;
      CHECK(run(159) == doctest::Approx(1).scale(0).epsilon(0.01));
      CHECK(run(2) == 0);
    }
  }
}
