// What the operator makes of the vehicle's instruments: its altitude, and where its places are measured from.
#include <doctest/doctest.h>

#include <cmath>

#include "distributers/lauv/vehicle.h"
#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

struct Reports : Conversation {
  imc::EstimatedState state(const tasks::Motion& motion = {}) {
    adapter.hand_over<&LauvOperator::Out::motion>(motion, to);
    return to.last<imc::EstimatedState>();
  }
  void report(const tasks::Instruments& instruments) {
    adapter.hand_over<&LauvOperator::Out::instruments>(instruments, to);
  }
  std::string start(double latitude, double longitude) {
    imc::Goto m;
    m.lat = latitude;
    m.lon = longitude;
    m.speed = 1;
    return start_of(m);
  }
  template <class M>
  std::string start_of(const M& m) {
    imc::PlanControl request;
    request.plan_id = "p";
    request.arg = packed(m);
    say(request);
    pass(50ms);
    return std::string(to.last<imc::PlanControl>().info.view());
  }
};

tasks::Instruments with_altitude(double value, std::int64_t count, std::int64_t fixes = 0) {
  tasks::Instruments i;
  i.place.count = fixes;
  i.latitude = 41.1850 * degree;
  i.longitude = -8.7062 * degree;
  i.altitude = {value, count};
  return i;
}
}  // namespace

TEST_SUITE("distributers/lauv/operator_places") {
  TEST_CASE("the altitude is that above the floor, not along the beam, as long as the altimeter reports it") {
    Reports c;
    CHECK(c.state().alt == -1);
    c.report(with_altitude(0, 0));
    CHECK(c.state().alt == -1);
    c.report(with_altitude(8, 1));
    CHECK(c.state().alt == 8);
    tasks::Motion leaning;
    leaning.theta = 60 * degree;
    leaning.phi = 45 * degree;
    CHECK(c.state(leaning).alt == doctest::Approx(8 * 0.5 * std::sqrt(0.5)));
    c.pass(2500ms);
    c.report(with_altitude(8, 1));
    CHECK(c.state().alt == 8);
    c.pass(50ms);
    c.report(with_altitude(8, 1));
    CHECK(c.state().alt == -1);
    c.report(with_altitude(7, 2));
    CHECK(c.state().alt == 7);
  }

  TEST_CASE("a vehicle that found itself far from the origin is shown where it is, and plans are flown there") {
    constexpr double latitude = 38.43 * degree, longitude = -9.1 * degree;
    distributers::Typed<distributers::LauvVehicle> vehicle;
    imc::GpsFix fix;
    fix.validity = imc::GpsFix::Validity::VALID_POS;
    fix.lat = latitude;
    fix.lon = longitude;
    vehicle.receive(fix);
    tasks::Instruments found;
    REQUIRE(vehicle.take<&distributers::LauvVehicle::In::instruments>(found));
    Reports c;
    tasks::Instruments nearby;  // of another vehicle at this link, before
    nearby.latitude = LauvOperatorParameters{}.latitude;
    nearby.longitude = LauvOperatorParameters{}.longitude;
    nearby.place.count = 1;
    c.report(nearby);
    CHECK(c.state().lat == LauvOperatorParameters{}.latitude);
    CHECK(c.start(latitude, longitude) == "its place is 308 km from the origin; places within 100 km are gone to");
    CHECK(c.start(LauvOperatorParameters{}.latitude, LauvOperatorParameters{}.longitude) == "");
    c.report(found);
    c.pass(50ms);
    CHECK(c.state().lat == latitude);
    CHECK(c.state().lon == longitude);
    const auto lines = c.to.all<imc::LogBookEntry>();
    REQUIRE(lines.size() >= 2);
    CHECK(lines[lines.size() - 2].text ==
          "places are measured from 38.4300 -9.1000 deg, as the vehicle does, not from 41.1850 -8.7062 deg");
    CHECK(lines.back().text == "plan 'p' ends: the vehicle measures its places from elsewhere now");
    CHECK(c.to.last<imc::PlanControlState>().last_outcome == imc::PlanControlState::LastOutcome::FAILURE);
    CHECK(c.start(latitude + 1e-5, longitude) == "");
    tasks::Leg leg;
    CHECK(c.adapter.take<&LauvOperator::In::leg>(leg));
    CHECK(leg.north == doctest::Approx(1e-5 * earth_radii(latitude).north));
    CHECK(leg.east == 0);
  }

  TEST_CASE("without a fix the vehicle's origin is not known, and the operator's counts") {
    Reports c;
    tasks::Instruments other;
    other.latitude = 0.5;
    c.report(other);
    CHECK(c.state().lat == LauvOperatorParameters{}.latitude);
    other.place.count = 1;
    c.report(other);
    CHECK(c.state().lat == 0.5);
  }

  TEST_CASE("without a fix nobody knows where it is: its navigation says so, and no plan begins that goes by places") {
    const auto navigation = [](Reports& c) {
      c.say(imc::QueryEntityState{});
      c.pass(50ms);
      std::vector<imc::EntityState> found;
      for (const imc::EntityState& each : c.to.all<imc::EntityState>())
        if (each.description.view() == "no fix of GPS yet: its place is not known") found.push_back(each);
      return found;
    };
    const double latitude = LauvOperatorParameters{}.latitude, longitude = LauvOperatorParameters{}.longitude;
    constexpr const char* refused = "GPS has given no fix yet: nobody knows where the vehicle is";
    tasks::Instruments none, fixed;
    none.latitude = fixed.latitude = latitude;
    none.longitude = fixed.longitude = longitude;
    fixed.place.count = 1;

    Reports c;
    CHECK(navigation(c).empty());  // nobody has said anything
    c.report(none);
    REQUIRE(navigation(c).size() == 1);
    CHECK(navigation(c).back().state == imc::EntityState::State::BOOT);
    CHECK(c.start(latitude, longitude) == refused);
    CHECK(c.start_of(imc::FollowReference{}) == refused);
    imc::StationKeeping station;
    station.lat = latitude;
    station.lon = longitude;
    station.speed = 1;
    CHECK(c.start_of(station) == refused);
    imc::PopUp up;  // it is how it finds itself
    up.flags = imc::PopUp::Flags::CURR_POS;
    up.speed = 1;
    CHECK(c.start_of(imc::Teleoperation{}) == "");
    CHECK(c.start_of(up) == "");
    up.flags = 0;
    up.lat = latitude;
    up.lon = longitude;
    CHECK(c.start_of(up) == refused);

    // after a maneuver that needs none
    Reports later;
    later.report(none);
    imc::IdleManeuver idle;
    idle.duration = 1;
    imc::Goto there;
    there.lat = latitude;
    there.lon = longitude;
    there.speed = 1;
    imc::PlanControl request;
    request.plan_id = "two";
    imc::PlanSpecification plan;
    plan.start_man_id = "wait";
    imc::PlanManeuver wait, go;
    wait.maneuver_id = "wait";
    wait.data = packed(idle);
    go.maneuver_id = "go";
    go.data = packed(there);
    plan.maneuvers = {packed(wait), packed(go)};
    imc::PlanTransition then;
    then.source_man = "wait";
    then.dest_man = "go";
    then.conditions = "ManeuverIsDone";
    plan.transitions.push_back(packed(then));
    request.arg = packed(plan);
    later.say(request);
    later.pass(500ms);
    CHECK(later.to.last<imc::PlanControl>().info == "");
    CHECK(later.to.last<imc::PlanControlState>().state == imc::PlanControlState::State::EXECUTING);
    tasks::Leg leg;
    REQUIRE(later.adapter.take<&LauvOperator::In::leg>(leg));
    later.adapter.hand_over<&LauvOperator::Out::progress>({.on_leg = leg.number, .done = true}, later.to);
    later.pass(1s);
    CHECK(later.to.last<imc::LogBookEntry>().text.view() == std::string("plan 'two' ends: ") + refused);
    CHECK(later.to.last<imc::PlanControlState>().last_outcome == imc::PlanControlState::LastOutcome::FAILURE);

    Reports unfitted;  // it goes by its way from the origin
    tasks::Instruments without = none;
    without.place.count = -1;
    unfitted.report(without);
    CHECK(navigation(unfitted).empty());
    CHECK(unfitted.start(latitude, longitude) == "");

    Reports found;
    found.report(fixed);
    CHECK(navigation(found).empty());
    CHECK(found.start(latitude, longitude) == "");
  }

  TEST_CASE("where there is no altimeter altitudes are refused, in plans and in references") {
    Reports c;
    imc::Goto m;
    m.lat = 41.1850 * degree;
    m.lon = -8.7062 * degree;
    m.speed = 1;
    m.z = 5;
    m.z_units = imc::ZUnits::ALTITUDE;
    c.report(with_altitude(0, 0, 1));
    CHECK(c.start_of(m) == "");
    c.report(with_altitude(0, -1, 1));
    CHECK(c.start_of(m) == "the vehicle has no altimeter: no altitude can be kept");
    imc::PlanManeuver named;
    named.maneuver_id = "low";
    named.data = packed(m);
    imc::PlanSpecification plan;
    plan.start_man_id = "low";
    plan.maneuvers.push_back(packed(named));
    imc::PlanDB store;
    store.plan_id = "p";
    store.arg = packed(plan);
    c.say(store);
    c.pass(50ms);
    CHECK(c.to.last<imc::PlanDB>().info == "maneuver 'low': the vehicle has no altimeter: no altitude can be kept");
    imc::FollowReference follow;
    follow.control_src = 0xffff;
    follow.control_ent = 0xff;
    CHECK(c.start_of(follow) == "");
    imc::Reference reference;
    reference.flags = imc::Reference::Flags::Z;
    REQUIRE(messages::put_inline(messages::refer_to(imc::DesiredZ{5, imc::ZUnits::ALTITUDE}), reference.z));
    c.say(reference);
    c.pass(50ms);
    CHECK(c.to.last<imc::LogBookEntry>().text ==
          "a reference is left out: the vehicle has no altimeter: no altitude can be kept");
    // those of a system that does not steer it are nothing to it
    follow.control_src = 0x4444;
    CHECK(c.start_of(follow) == "");
    const std::size_t lines = c.to.all<imc::LogBookEntry>().size();
    c.say(reference);
    c.pass(50ms);
    CHECK(c.to.all<imc::LogBookEntry>().size() == lines);
    m.z_units = imc::ZUnits::DEPTH;
    CHECK(c.start_of(m) == "");
    c.report(with_altitude(9, 1, 2));
    m.z_units = imc::ZUnits::ALTITUDE;
    CHECK(c.start_of(m) == "");
  }
}
