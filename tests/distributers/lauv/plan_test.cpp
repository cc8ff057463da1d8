// Plans of IMC: the way from maneuver to maneuver, and what is wrong with one.
#include "distributers/lauv/plan.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;
using jarol::tests::packed;

using tests::origin;

imc::Goto go_there() {
  imc::Goto m;
  m.lat = origin.latitude;
  m.lon = origin.longitude;
  m.z = 3;
  m.z_units = imc::ZUnits::DEPTH;
  m.speed = 1.2F;
  return m;
}
}  // namespace

TEST_SUITE("distributers/lauv_plan") {
  TEST_CASE("a plan goes from maneuver to maneuver by its transitions, and names what is wrong with it") {
    imc::PlanSpecification plan;
    plan.plan_id = "p";
    plan.start_man_id = "b";
    const auto add = [&](const char* name) {
      imc::PlanManeuver named;
      named.maneuver_id = name;
      named.data = packed(go_there());
      plan.maneuvers.push_back(packed(named));
    };
    const auto join = [&](const char* from, const char* to, const char* when = "ManeuverIsDone") {
      imc::PlanTransition transition;
      transition.source_man = from;
      transition.dest_man = to;
      transition.conditions = when;
      plan.transitions.clear();
      plan.transitions.push_back(packed(transition));
    };
    const auto refuses = [&](const char* why) {
      CHECK_THROWS_WITH_AS(make_plan(plan, origin), why, std::invalid_argument);
    };
    refuses("the plan has no maneuver");
    add("a");
    refuses("the start 'b' is none of its maneuvers: a");
    add("b");
    join("b", "a");
    const Plan good = make_plan(plan, origin);
    CHECK(good.start == 1);
    CHECK(good.next[1] == 0);
    CHECK_FALSE(good.next[0].has_value());
    join("a,b", "_done_");
    CHECK_FALSE(make_plan(plan, origin).next[1].has_value());
    join("c", "a");
    refuses("source of a transition 'c' is none of its maneuvers: a, b");
    join("a", "c");
    refuses("destination of a transition 'c' is none of its maneuvers: a, b");
    join("a", "b", "BatteryIsLow");
    refuses("the condition of a transition is ManeuverIsDone, not 'BatteryIsLow'");
    add("a");
    refuses("two maneuvers are named 'a'");
    plan.maneuvers.clear();
    imc::PlanManeuver named;
    named.maneuver_id = "x";
    plan.maneuvers.push_back(packed(named));
    refuses("maneuver 'x': there is no maneuver in it");
    plan.maneuvers[0].payload.resize(1);
    refuses("maneuver 1 can't be read: field 'maneuver_id' of PlanManeuver needs 2 bytes where 1 are left");
  }
}
