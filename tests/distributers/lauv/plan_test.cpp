// Plans of IMC: the way from maneuver to maneuver, and what is wrong with one.
#include "distributers/lauv/plan.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "graph/math/geometry.h"
#include "graph/text/errors.h"
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
    const auto refuses = [&](const char* why) { CHECK_THROWS_WITH_AS(make_plan(plan, origin), why, InputError); };
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

  TEST_CASE("a plan of more lines than can be looked through within a period is refused") {
    imc::Rows rows;
    rows.lat = origin.latitude;
    rows.lon = origin.longitude;
    rows.z_units = imc::ZUnits::DEPTH;
    rows.speed = 1;
    rows.length = 10;
    rows.hstep = 10;
    rows.alternation = 100;
    rows.width = 4000;  // 400 curves: twice as many lines, and two
    imc::PlanSpecification plan;
    plan.start_man_id = "0";
    const auto add_up_to = [&](int maneuvers) {
      for (int k = static_cast<int>(plan.maneuvers.size()); k < maneuvers; ++k) {
        imc::PlanManeuver named;
        named.maneuver_id = std::to_string(k);
        named.data = packed(rows);
        plan.maneuvers.push_back(packed(named));
      }
    };
    add_up_to(12);
    CHECK(make_plan(plan, origin).maneuvers.size() == 12);
    add_up_to(13);
    CHECK_THROWS_WITH_AS(make_plan(plan, origin), "the plan has more than 10000 lines, circles and the like",
                         InputError);
  }
}
