#include "distributers/messages/limits.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/payload.h"

using namespace jarol;
using namespace jarol::messages;
using Found = std::vector<std::string>;

TEST_SUITE("distributers/messages/limits") {
  TEST_CASE("what lies outside a field's limits is found, and where") {
    CHECK(find_outside(refer_to(imc::SetThrusterActuation{0, 1.0F})) == Found{});
    CHECK(find_outside(refer_to(imc::SetThrusterActuation{0, 1.5F})) == Found{"value: 1.5 is above 1"});
    CHECK(find_outside(refer_to(imc::SetThrusterActuation{0, -1.25F})) == Found{"value: -1.25 is below -1"});
    CHECK(find_outside(refer_to(javiator::MotorSignals{0, -1, 16001, 16000, 7})) ==
          Found{"right: -1 is below 0", "rear: 16001 is above 16000"});
  }

  TEST_CASE("what is no number lies nowhere, infinity outside") {
    CHECK(find_outside(refer_to(imc::SetThrusterActuation{0, std::numeric_limits<float>::quiet_NaN()})) == Found{});
    CHECK(find_outside(refer_to(imc::SetThrusterActuation{0, std::numeric_limits<float>::infinity()})) ==
          Found{"value: inf is above 1"});
  }

  TEST_CASE("a limit is as exact as the field: half a turn in 32 bits is within pi") {
    imc::SimulatedState state;
    state.psi = static_cast<float>(3.141592653589793);
    CHECK(static_cast<double>(state.psi) > 3.141592653589793);
    CHECK(find_outside(refer_to(state)) == Found{});
    state.psi = std::nextafter(state.psi, 4.0F);
    CHECK(find_outside(refer_to(state)) == Found{"psi: 3.141593 is above 3.141592653589793"});
  }

  TEST_CASE("messages within messages and lists are looked into") {
    imc::Goto goto_pole;
    goto_pole.lat = 2;
    imc::PlanManeuver maneuver;
    REQUIRE(put_inline(refer_to(goto_pole), maneuver.data));
    CHECK(find_outside(refer_to(maneuver)) == Found{"data.lat: 2 is above 1.5707963267948966"});
    imc::PlanSpecification plan;
    CHECK(find_outside(refer_to(plan)) == Found{});
    plan.maneuvers.resize(2);
    REQUIRE(put_inline(refer_to(imc::PlanManeuver{}), plan.maneuvers[0]));
    REQUIRE(put_inline(refer_to(maneuver), plan.maneuvers[1]));
    CHECK(find_outside(refer_to(plan)) == Found{"maneuvers[1].data.lat: 2 is above 1.5707963267948966"});
  }
}
