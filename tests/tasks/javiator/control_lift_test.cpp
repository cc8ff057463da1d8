// The numbers of the helicopter's law of altitude: each gain, limit and time, at its edge. In one file: all hover or
// stand alike.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tasks/javiator/control.h"
#include "tests/tasks/javiator/every_15_ms.h"
#include "tests/tasks/javiator/hovering_law.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::Altitude;
using tests::dt;
using tests::g_earth;

// Standing with rotors at idle.
struct Grounded : Altitude {
  Grounded() {
    state = {.trim = 0.5};
    out.lift.thrust = 0.5;
    in.estimate.altitude = 0;
  }
};
}  // namespace

TEST_SUITE("tasks/javiator_control/lift") {
  TEST_CASE("an error of altitude is 12/s^2, and 1/s^3 of its integral, an error of climb 7/s") {
    Altitude low;
    low.in.estimate.altitude = 0.99;
    low.state.z.place = low.in.directive.altitude;
    CHECK(low.run() == doctest::Approx(1 + 0.01 * (12 + dt) / g_earth));
    Altitude rising;
    rising.in.estimate.climb = 0.01;
    CHECK(rising.run() == doctest::Approx(1 - 0.07 / g_earth));
  }

  TEST_CASE("a landing that has lasted 8 s gets faster by 5 cm/s each second, up to 40 cm/s") {
    Altitude a;
    a.in.directive = {.state = FlightState::landing};
    a.in.estimate.altitude = 0.4;
    a.in.estimate.altitude_known = true;
    a.in.estimate.altitude_confirmed = true;
    const auto demand_after = [&](double seconds) {
      a.state.landing = seconds - dt;
      a.state.z = {.place = 0.4, .speed = -0.3};
      a.run();
      return a.state.z.demand;
    };
    CHECK(demand_after(7.9) == doctest::Approx(3 * 0.1));
    CHECK(demand_after(9) == doctest::Approx(3 * 0.05));
    CHECK(demand_after(100) == doctest::Approx(-3 * 0.1));
    a.in.directive.state = FlightState::flying;
    a.run();
    CHECK(a.state.landing == 0);
  }

  TEST_CASE("it descends fast only where the pressure confirms that it is high") {
    for (const bool confirmed : {true, false}) {
      Altitude a;
      a.in.directive = {.state = FlightState::landing};
      a.in.estimate.pressure_known = true;
      a.in.estimate.altitude_confirmed = confirmed;
      a.run();
      CHECK(a.state.z.demand == doctest::Approx(-3 * (confirmed ? 0.5 : 0.2)));
    }
  }

  TEST_CASE("a lasting error of altitude is made up for with 1 m/s^2 at most, to either side") {
    for (const double side : {-1.0, 1.0}) {
      Altitude a;
      a.in.estimate.altitude = 1 - 0.1 * side;
      a.run(1000);
      CHECK(a.state.sunk == side);
    }
  }

  TEST_CASE("a climb begins with 15 m/s^3, is felt with a lag of 0.08 s, and near its end it is critically damped") {
    Altitude a;
    a.in.directive.altitude = 100;
    a.run();
    CHECK(a.state.z.demand == doctest::Approx(15 * dt));
    CHECK(a.state.z.felt == doctest::Approx(15 * dt * dt / (0.08 + dt)));
    double greatest = 0;
    for (int i = 0; i < 1000; ++i) {
      a.in.estimate.altitude = a.state.z.place;
      a.run();
      greatest = std::max(greatest, a.state.z.demand);
    }
    CHECK(greatest == 2);
    CHECK(a.state.z.speed == doctest::Approx(1));
    Altitude near;
    near.in.directive.altitude = 1.01;
    near.run();
    CHECK(near.state.z.demand == doctest::Approx(2.2 * 2.2 * 0.01));
  }

  TEST_CASE("thrust is learnt at 10 rad/s from the lift that is felt, between 0.4 and 1.7 of hover") {
    Altitude a;
    a.in.estimate.lift = 0.9 * g_earth;
    a.run();
    CHECK(a.state.trim == doctest::Approx(1 + 10 * dt * 0.1));
    CHECK(a.state.mean_trim == doctest::Approx(1 + 10 * dt * 0.1 * dt));
    a.in.estimate.lift = 0;
    a.run(1000);
    CHECK(a.state.trim == 1.7);
    a.in.estimate.lift = 4 * g_earth;
    a.run(1000);
    CHECK(a.state.trim == 0.4);
  }

  TEST_CASE(
      "landing on one foot, leaning, it does not learn what that carries, but takes thrust back, faster by 0.4/s each "
      "second") {
    const double learnt = 1 + 10 * dt * (1 - 1.5), foot = 0.2 * std::sin(0.2), near = 0.01;
    Altitude landing;
    landing.in.directive = {.state = FlightState::landing};
    landing.in.estimate.roll = -0.2;
    landing.in.estimate.altitude = foot + near - 1e-6;
    landing.in.estimate.lift = 1.5 * g_earth;
    const auto trim_of = [](Altitude a) {
      a.run();
      return a.state.trim;
    };
    CHECK(trim_of(landing) == doctest::Approx(1 - 0.8 * dt * dt));
    Altitude settling = landing, pitched = landing, high = landing, level = landing, unsure = landing;
    settling.in.directive = {.state = FlightState::flying};
    CHECK(trim_of(settling) == doctest::Approx(1 - 0.8 * dt * dt));
    std::swap(pitched.in.estimate.roll, pitched.in.estimate.pitch);
    CHECK(trim_of(pitched) == doctest::Approx(1 - 0.8 * dt * dt));
    pitched.run(66);  // 0.99 s
    CHECK(pitched.state.trim == doctest::Approx(1 - 0.5 * 0.8 * 0.99 * (0.99 + dt)));
    high.in.estimate.altitude += 2e-6;
    CHECK(trim_of(high) == doctest::Approx(learnt));
    level.in.estimate.altitude = 0.2 * 0.049;
    level.in.estimate.roll = 0.049;
    CHECK(trim_of(level) == doctest::Approx(learnt));
    unsure.in.estimate.altitude_known = false;
    CHECK(trim_of(unsure) == doctest::Approx(learnt));
    Altitude flying = landing;
    flying.in.directive = {.state = FlightState::flying, .altitude = 1};
    flying.state.on_foot = 1;
    CHECK(trim_of(flying) == doctest::Approx(learnt));
    flying.run();
    CHECK(flying.state.on_foot == 0);
  }

  TEST_CASE("what is demanded is felt after 0.06 s") {
    Altitude a;
    a.in.estimate.climb = 0.01;
    a.run();
    CHECK(a.state.expected == doctest::Approx(-0.07 / g_earth * dt / (0.06 + dt)));
  }

  TEST_CASE("a lean is made up for until half of the thrust is lost, which is at 60 degrees") {
    for (const double lean : {0.5, 1.0, 1.04, 1.1, 1.5}) {
      CAPTURE(lean);
      Altitude rolled;
      rolled.state.trim = 0.5;
      rolled.in.estimate.lift = g_earth;
      rolled.in.estimate.roll = lean;
      CHECK(rolled.run() == doctest::Approx(0.5 + 1 / std::max(std::cos(lean), 0.5) - 1));
      Altitude both;
      both.state.trim = 0.5;
      both.in.estimate.roll = both.in.estimate.pitch = -lean / 2;
      CHECK(both.run() == doctest::Approx(0.5 + 1 / std::max(std::cos(lean / 2) * std::cos(lean / 2), 0.5) - 1));
    }
  }

  TEST_CASE("thrust is a tenth of that of hover at least, twice it at most") {
    Altitude a;
    a.in.estimate.climb = 10;
    CHECK(a.run() == 0.1);
    a.in.estimate.climb = -10;
    CHECK(a.run() == 2);
  }

  TEST_CASE("to idle it takes a second and a half, and from full thrust to rest as long as it has thrust") {
    Grounded g;
    g.in.directive.state = FlightState::starting;
    g.out.lift.thrust = 0;
    CHECK(g.run() == doctest::Approx(0.5 * dt / 1.5));
    CHECK(g.run(98) < 0.5);
    CHECK(g.run(2) == 0.5);
    g.in.directive.state = FlightState::ground;
    CHECK(g.run() == doctest::Approx(0.5 - dt));
    g.in.directive.state = FlightState::halt;
    CHECK(g.run() == 0);
  }

  TEST_CASE(
      "before it lifts off thrust grows by one and a half each second, to one and a half, and goes back to idle") {
    Grounded g;
    CHECK(g.run() == doctest::Approx(0.5 + 1.5 * dt));
    CHECK(g.run(1000) == 1.5);
    g.in.directive.altitude = 0.02;  // not above the ground
    CHECK(g.run() == doctest::Approx(1.5 - 1.5 * dt));
    CHECK(g.run(1000) == 0.5);
    CHECK_FALSE(g.state.lifted);
  }

  TEST_CASE("it has left the ground at more than 2 cm") {
    Grounded g;
    g.in.estimate.altitude = 0.02;
    g.run();
    CHECK_FALSE(g.state.lifted);
    g.in.estimate.altitude = 0.021;
    g.run();
    CHECK(g.state.lifted);
  }

  TEST_CASE("it is back on the ground below 2 cm and 5 cm/s where it is told to be there") {
    struct Case {
      double goal, altitude, climb;
      bool lifted;
    };
    for (const Case& c : {Case{0.02, 0.019, 0.049, false}, Case{0.021, 0.019, 0.049, true},
                          Case{0.02, 0.02, 0.049, true}, Case{0.02, 0.019, -0.051, true}}) {
      Altitude a;
      a.in.directive.altitude = c.goal;
      a.in.estimate.altitude = c.altitude;
      a.in.estimate.climb = c.climb;
      a.run();
      CHECK(a.state.lifted == c.lifted);
    }
  }

  TEST_CASE(
      "commanded to the ground it goes down at 20 cm/s from 15 cm on, until the ground carries, and stands once "
      "idle") {
    Altitude a;
    a.in.directive.altitude = 0;
    a.in.estimate.altitude = 0.16;
    a.state.z = {.place = 0.1};
    a.run();
    CHECK(a.state.z.demand > -0.5);  // its approach goes on
    a.in.estimate.altitude = 0.14;
    a.state.z = {.place = 0.1};
    a.run();
    CHECK(a.state.z.demand == doctest::Approx(-0.6));
    a.run(200);  // a foot stands, and keeps it from sinking further
    CHECK_FALSE(a.state.lifted);
    CHECK(a.out.lift.stands);
    CHECK(a.out.lift.thrust == 0.5);
    a.in.directive.altitude = 1;
    a.run();
    CHECK_FALSE(a.out.lift.stands);
    Altitude light;
    light.in.directive.altitude = 0;
    light.in.estimate.altitude = 0.1;
    light.state.z.place = 0.1;
    light.state.trim = 0.75;
    light.run();
    CHECK(light.state.lifted);
    light.state.trim = 0.6;
    CHECK(light.run() < 0.6);
    CHECK_FALSE(light.state.lifted);
    CHECK(light.state.trim == light.out.lift.thrust);  // no more than it had
    light.run();
    CHECK(light.out.lift.thrust > 0.5);
    CHECK_FALSE(light.out.lift.stands);
    light.run(10);
    CHECK(light.out.lift.stands);
  }

  TEST_CASE("thrust that is light in the air does not count as carried by the ground") {
    Altitude falls;
    falls.in.directive.altitude = 0;
    falls.in.estimate.altitude = 0.1;
    falls.in.estimate.lift = 0.8 * g_earth;
    falls.state.z.place = 0.1;
    falls.state.trim = 0.6;
    CHECK(falls.run() < 0.6);
    CHECK(falls.state.lifted);
  }

  TEST_CASE("it stands until its thrust is 0.8 of hover's; what rises already when it is to stay comes down again") {
    Grounded g;
    g.in.directive.altitude = 1;
    g.state.trim = 0.77;
    g.run();
    CHECK(g.out.lift.stands);  // 0.7925
    g.run();
    CHECK_FALSE(g.out.lift.stands);
    g.in.directive.altitude = 0;
    g.in.estimate.altitude = 0.03;
    g.in.estimate.climb = 0.09;
    g.run();
    CHECK_FALSE(g.state.lifted);
    g.in.estimate.climb = 0.11;
    g.run();
    CHECK(g.state.lifted);
  }

  TEST_CASE("what stands does not take off to land, whatever its sonar reports") {
    Grounded g;
    g.out.lift.stands = true;
    g.in.directive.state = FlightState::landing;
    g.in.estimate.altitude = 0.6;
    g.in.estimate.climb = 0.2;
    CHECK(g.run(100) == 0.5);
    CHECK_FALSE(g.state.lifted);
    CHECK(g.out.lift.stands);
    g.out.lift.stands = false;
    g.run();
    CHECK(g.state.lifted);
  }

  TEST_CASE("it comes down at half a metre a second, and below half a metre, or what it takes for it, at 20 cm/s") {
    const auto demand_at = [](double altitude, bool known) {
      Altitude a;
      a.in.directive.state = FlightState::landing;
      a.in.estimate.altitude = altitude;
      a.in.estimate.altitude_known = known;
      a.in.estimate.altitude_confirmed = known;
      a.state.z = {.place = altitude};
      a.run();
      CHECK(a.state.z.speed == doctest::Approx(a.state.z.demand * dt));
      return a.state.z.demand;
    };
    CHECK(demand_at(0.501, true) == doctest::Approx(3 * -0.5));
    CHECK(demand_at(0.499, true) == doctest::Approx(3 * -0.2));
    CHECK(demand_at(0.501, false) == doctest::Approx(3 * -0.2));
  }

  TEST_CASE("a landing brakes with 2 m/s^2 at most, and its goal is never more than 15 cm below") {
    Altitude a;
    a.in.directive.state = FlightState::landing;
    a.state.z.speed = -5;
    a.run();
    CHECK(a.state.z.demand == 2);
    CHECK(a.state.z.place == doctest::Approx(1 - (5 - 2 * dt) * dt));
    a.run(3);
    CHECK(a.state.z.place == 0.85);
  }
}
