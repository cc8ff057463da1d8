// When a maneuver began, how long it and its plan still take, and when something went wrong last, as a console gets it.
#include <doctest/doctest.h>

#include <chrono>
#include <functional>

#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

// As of the messages.
double clock_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// At the origin, or so many m from it, 3 m deep.
template <class M>
M placed(double north = 0, double east = 0, float speed = 1) {
  const EarthRadii radii = earth_radii(origin.latitude);
  M m;
  m.lat = origin.latitude + north / radii.north;
  m.lon = origin.longitude + east / radii.east;
  m.z = 3;
  m.z_units = imc::ZUnits::DEPTH;
  m.speed = speed;
  return m;
}

// A plan of some maneuvers, and a vehicle that reports of it.
struct Flown : Conversation {
  template <class... M>
  void fly(const M&... maneuvers) {
    imc::PlanSpecification plan;
    plan.plan_id = "p";
    plan.start_man_id = "0";
    std::size_t count = 0;
    const auto add = [&](const auto& maneuver) {
      imc::PlanManeuver named;
      named.maneuver_id = std::to_string(count++);
      named.data = packed(maneuver);
      plan.maneuvers.push_back(packed(named));
      imc::PlanTransition transition;
      transition.source_man = std::to_string(count - 1);
      transition.dest_man = std::to_string(count);
      transition.conditions = "ManeuverIsDone";
      if (count < sizeof...(M)) plan.transitions.push_back(packed(transition));
    };
    (add(maneuvers), ...);
    imc::PlanControl start;
    start.plan_id = "p";
    start.arg = packed(plan);
    say(start);
    pass(1s);
    REQUIRE(to.last<imc::PlanControl>().info == "");
  }
  // Of the leg that it has, or of another.
  void note(double left, bool done = false, std::uint32_t other = 0) {
    adapter.take<&LauvOperator::In::leg>(leg);
    adapter.hand_over<&LauvOperator::Out::progress>({.on_leg = leg.number + other, .done = done, .left = left}, to);
    pass(1s);
  }
  void check_times(int maneuver, int plan) const {
    const auto state = to.last<imc::PlanControlState>();
    CHECK(state.man_eta == maneuver);
    CHECK(state.plan_eta == plan);
    CHECK(to.last<imc::VehicleState>().maneuver_eta == (maneuver < 0 ? 0xffff : maneuver));
  }
  tasks::Leg leg;
};
}  // namespace

TEST_SUITE("distributers/lauv_plan_times") {
  TEST_CASE("a maneuver takes as long as all its legs that are left, and a plan as long as what follows, too") {
    // by 40 m and 30 m at 2 m/s, then 40 m at 1 m/s
    auto path = placed<imc::FollowPath>(0, 0, 2);
    for (const auto& [x, y] : {std::pair{30.0F, 0.0F}, {30.0F, 40.0F}, {0.0F, 40.0F}})
      path.points.push_back(packed(imc::PathPoint{x, y, 0}));
    auto last = placed<imc::StationKeeping>();
    last.radius = 15;
    last.duration = 50;
    Flown c;
    c.fly(path, placed<imc::Goto>(), last);
    c.check_times(-1, -1);
    c.note(12.5);
    c.check_times(12 + 20 + 15, 47 + 40 + 50);
    c.note(5.5, false, 1);  // of no leg of this plan
    c.check_times(47, 137);
    c.note(0, true);
    c.check_times(-1, -1);
    c.note(20.5);
    c.check_times(35, 125);
    c.note(0, true);
    c.note(3.5);
    c.check_times(3, 93);
    c.note(0, true);
    c.note(38.5);
    CHECK(c.to.last<imc::PlanControlState>().man_id == "1");
    c.check_times(38, 88);
    c.note(0, true);
    c.note(49.5);
    c.check_times(49, 49);
    c.note(0, true);
    CHECK(c.to.last<imc::PlanControlState>().last_outcome == imc::PlanControlState::LastOutcome::SUCCESS);
    c.check_times(-1, -1);
  }

  TEST_CASE("a plan that ends in a maneuver without end takes nobody knows how long, and so does that maneuver") {
    auto loiter = placed<imc::Loiter>();
    loiter.radius = 15;
    Flown c;
    c.fly(placed<imc::Goto>(100), loiter);
    c.note(99.5);
    c.check_times(99, -1);
    c.note(0, true);
    c.note(-1);
    CHECK(c.to.last<imc::PlanControlState>().man_id == "1");
    c.check_times(-1, -1);
  }

  TEST_CASE(
      "how long it still takes to a reference is unknown when the next wants it elsewhere, until it is reported") {
    imc::FollowReference follow;
    follow.control_src = 0xffff;
    follow.control_ent = 0xff;
    const auto lead = [](double north, double speed) {
      const auto there = placed<imc::Goto>(north);
      imc::Reference reference;
      reference.lat = there.lat;
      reference.lon = there.lon;
      reference.flags = imc::Reference::Flags::LOCATION | imc::Reference::Flags::SPEED;
      reference.speed = packed(imc::DesiredSpeed{speed, imc::SpeedUnits::METERS_PS});
      return reference;
    };
    Flown c;
    c.fly(follow);
    c.check_times(-1, -1);
    c.say(lead(100, 1));
    c.note(99.5);
    c.check_times(99, -1);
    c.say(lead(100, 1.2));  // the same way, faster
    c.pass(1s);
    c.check_times(99, -1);
    c.say(lead(20, 1.2));
    c.pass(1s);
    c.check_times(-1, -1);
    c.note(16.5);
    c.check_times(16, -1);
    c.note(0, true);  // it circles there
    c.check_times(-1, -1);
    c.note(0.5);
    c.check_times(0, -1);
    c.say(lead(100, 1));
    c.pass(1s);
    c.check_times(-1, -1);
  }

  TEST_CASE("a time that its field can't hold is the longest that it can") {
    Flown c;
    c.fly(placed<imc::Goto>(100));
    c.note(3e9);
    CHECK(c.to.last<imc::PlanControlState>().man_eta == 2'000'000'000);
    CHECK(c.to.last<imc::PlanControlState>().plan_eta == 2'000'000'000);
    CHECK(c.to.last<imc::VehicleState>().maneuver_eta == 65534);
  }

  TEST_CASE("a maneuver has begun when it was started, the next when the one before was over") {
    Flown c;
    const auto began = [&] { return c.to.last<imc::VehicleState>().maneuver_stime; };
    const double before = clock_time();
    c.fly(placed<imc::Goto>(100), placed<imc::Goto>());
    const double first = began(), between = clock_time();
    CHECK(first >= before);
    CHECK(first <= between);
    c.note(5);
    CHECK(began() == first);
    c.note(0, true);
    CHECK(c.to.last<imc::PlanControlState>().man_id == "1");
    CHECK(began() >= between);
    CHECK(began() <= clock_time());
    c.note(0, true);
    CHECK(began() == 0);  // none is flown
  }

  TEST_CASE("what went wrong last has the time when it did: an abort, an alarm, a plan that failed or was cut short") {
    struct Case {
      const char* error;
      std::function<void(Flown&)> happens;
    };
    const Case cases[] = {{"abort", [](Flown& c) { c.say(imc::Abort{}); }},
                          {"leak", [](Flown& c) { c.report({.alarm = tasks::Alarm::leak}); }},
                          {"maneuver '0' took longer than 20 s", [](Flown& c) { c.pass(21s); }},
                          {"the run is ending: the vehicle is brought to rest", [](Flown& c) { c.adapter.ending(); }}};
    for (const Case& each : cases) {
      CAPTURE(each.error);
      Flown c;
      auto there = placed<imc::Goto>(100);
      there.timeout = 20;
      c.fly(there);
      CHECK(c.to.last<imc::VehicleState>().last_error == "");
      CHECK(c.to.last<imc::VehicleState>().last_error_time == 0);
      const double before = clock_time();
      each.happens(c);
      const double after = clock_time();
      c.pass(2s);
      const auto state = c.to.last<imc::VehicleState>();
      CHECK(state.last_error == each.error);
      CHECK(state.last_error_time >= before);
      CHECK(state.last_error_time <= after);
    }
  }
}
