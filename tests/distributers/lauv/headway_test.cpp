// Legs of a plan that do not come on.
#include "distributers/lauv/headway.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/beyond_range.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using distributers::Headway;
using distributers::HeadwayLimits;
using tasks::Course;
using tasks::Leg;
using tasks::Motion;
using tasks::Progress;

// Until it is given up, ten times a second; seconds, and why. 0: not within ten minutes.
template <class Where>
std::pair<double, std::string> given_up(const Leg& leg, Where where, const HeadwayLimits& limits = {}) {
  Headway headway;
  for (Duration now{}; now < 600s; now += 100ms) {
    Progress progress;
    Motion motion;
    where(seconds(now), progress, motion);
    if (std::string why = headway.note(limits, leg, progress, motion, now); !why.empty()) return {seconds(now), why};
  }
  return {0, ""};
}

// At a distance that changes by that much per s, from 40 m on.
auto drifting(double rate) {
  return [rate](double t, Progress& progress, Motion&) { progress.distance = 40 + rate * t; };
}

// Has a plan keep a station of which the vehicle stays 60 m off, until it is given up; the leg then.
tasks::Leg stay_in_vain(Conversation& c) {
  imc::StationKeeping keep;
  keep.lat = origin.latitude;
  keep.lon = origin.longitude;
  keep.z_units = imc::ZUnits::DEPTH;
  keep.speed = 1;
  keep.duration = 60;
  imc::PlanControl request;
  request.plan_id = "p";
  request.arg = packed(keep);
  c.say(request);
  c.pass(50ms);
  tasks::Leg leg;
  for (int k = 0; k < 1000 && c.adapter.take<&LauvOperator::In::leg>(leg) | (leg.course != Course::none); ++k) {
    c.adapter.hand_over<&LauvOperator::Out::progress>({.on_leg = leg.number, .distance = 60, .left = 60}, c.to);
    c.pass(100ms);
  }
  return leg;
}

// The time of one that is not given up.
const double never = 0;
}  // namespace

TEST_SUITE("distributers/lauv/headway") {
  TEST_CASE("a line to whose end it comes by less than 5 cm/s is given up after 90 s, whichever way it goes") {
    const Leg leg{.course = Course::line};
    CHECK(given_up(leg, drifting(0)) == std::pair(90.0, std::string("no headway in 90 s, 40 m from its place")));
    CHECK(given_up(leg, drifting(0.5)) == std::pair(90.0, std::string("no headway in 90 s, 85 m from its place")));
    CHECK(given_up(leg, drifting(-0.049)).first == 90);
    CHECK(given_up(leg, drifting(-0.051)).first == never);
  }

  TEST_CASE("a leap of its place, and a turn back to an end that was missed, are headway in the end") {
    const auto leaps = [](double t, Progress& p, Motion&) { p.distance = (t < 35 ? 500 : 900) - t; };
    CHECK(given_up(Leg{.course = Course::line}, leaps).first == never);
    const auto turns = [](double t, Progress& p, Motion&) { p.distance = t < 50 ? 20 + t : std::max(120 - t, 0.0); };
    CHECK(given_up(Leg{.course = Course::line}, turns).first == never);
    // held up each two minutes
    const auto waits = [](double t, Progress& p, Motion&) {
      p.distance = 1000 - 75 * std::floor(t / 120) - std::max(std::fmod(t, 120) - 45, 0.0);
    };
    CHECK(given_up(Leg{.course = Course::line}, waits).first == never);
    const auto stays = [](double, Progress& p, Motion&) { p.distance = 40, p.near = true; };
    CHECK(given_up(Leg{.course = Course::line}, stays).first == never);
  }

  TEST_CASE("a station that is kept within 2.5 radii, and a circle within 15 m, have headway for ever") {
    const auto at = [](double distance, double cross_track) {
      return [=](double, Progress& p, Motion&) { p.distance = distance, p.cross_track = cross_track; };
    };
    const Leg station{.course = Course::station, .radius = 10}, circle{.course = Course::circle, .radius = -20};
    CHECK(given_up(station, at(24.9, 0)).first == never);
    CHECK(given_up(station, at(26, 0)) == std::pair(90.0, std::string("no headway in 90 s, 1 m from its place")));
    CHECK(given_up(circle, at(35, -14.9)).first == never);
    CHECK(given_up(circle, at(36, -16)).first == 90);
    CHECK(given_up(Leg{.course = Course::rest}, drifting(1)).first == never);
    CHECK(given_up(Leg{.course = Course::fix}, drifting(1)).first == never);
  }

  TEST_CASE("a leg up or down is given up that changes its depth by less than 1 cm/s") {
    const Leg down{.course = Course::circle, .until_level = true, .level = 8};
    const auto at = [](double rate, bool levelled = false) {
      return [=](double t, Progress& p, Motion& m) { m.z = rate * t, p.cross_track = 50, p.levelled = levelled; };
    };
    CHECK(given_up(down, at(0)) == std::pair(90.0, std::string("no headway in 90 s, 8 m from its depth")));
    CHECK(given_up(down, at(0.009)).first == 90);
    CHECK(given_up(down, at(0.012)).first == never);
    CHECK(given_up(down, at(0, true)).first == never);
    Leg low = down;
    low.vertical = tasks::Vertical::altitude;
    CHECK(given_up(low, at(0)) == std::pair(90.0, std::string("no headway in 90 s, its altitude is not reached")));
    CHECK(given_up(low, at(-0.012)).first == never);
  }

  TEST_CASE("how often it looks, how often in vain, and what counts as headway is as it is given") {
    const Leg line{.course = Course::line};
    const std::string lost = "no headway in 20 s, 40 m from its place";
    CHECK(given_up(line, drifting(0), {.period = 10s, .misses = 2}) == std::pair(20.0, lost));
    CHECK(given_up(line, drifting(-0.06), {.way = 2}).first == 90);
    CHECK(given_up(line, drifting(-0.06), {.way = 1}).first == never);
    const auto sinks = [](double t, Progress&, Motion& m) { m.z = 0.015 * t; };
    const Leg down{.course = Course::circle, .until_level = true, .level = 8};
    CHECK(given_up(down, sinks, {.level = 0.5}).first == 90);
    CHECK(given_up(down, sinks, {.level = 0.4}).first == never);
    const auto off = [](double, Progress& p, Motion&) { p.distance = 26, p.cross_track = 16; };
    const Leg station{.course = Course::station, .radius = 10}, circle{.course = Course::circle, .radius = 20};
    CHECK(given_up(station, off, {.station = 3}).first == never);
    CHECK(given_up(circle, off, {.circle = 20}).first == never);
  }

  TEST_CASE("a period below 1 s, misses below 1, way, level and circle below 0 and a station below 1 are refused") {
    check_refused<HeadwayLimits>({
        {{"period"}, "a duration from 1s to 3600s", "10ms"},
        {{"misses"}, "a uint32 from 1 to 1000", "0"},
        {{"way"}, "a double [m] from 0 to 1000", "-1"},
        {{"level"}, "a double [m] from 0 to 1000", "-1"},
        {{"circle"}, "a double [m] from 0 to 1000", "-1"},
        {{"station"}, "a double from 1 to 1000", "0.5"},
    });
  }

  TEST_CASE("a plan without headway has failed, the log book says where, and the propeller stops") {
    Conversation c;
    const tasks::Leg leg = stay_in_vain(c);
    CHECK(c.now < 95s);
    CHECK(leg.course == Course::none);
    CHECK(c.setpoint().speed == 0);
    CHECK(c.op_mode() == OpMode::SERVICE);
    const auto state = c.to.last<imc::PlanControlState>();
    CHECK(state.state == imc::PlanControlState::State::READY);
    CHECK(state.last_outcome == imc::PlanControlState::LastOutcome::FAILURE);
    const char* const why = "maneuver '1': no headway in 90 s, 35 m from its place";
    CHECK(c.to.last<imc::LogBookEntry>().text.view() == std::string("plan 'p' has failed: ") + why);
    CHECK(c.to.last<imc::LogBookEntry>().type == imc::LogBookEntry::Type::ERROR);
    CHECK(c.to.last<imc::VehicleState>().last_error == why);
  }

  TEST_CASE("the operator gives a plan up by the headway of its own parameters") {
    Conversation c({.headway = {.period = 10s, .misses = 1}});
    CHECK(stay_in_vain(c).course == Course::none);
    CHECK(c.now > 10s);
    CHECK(c.now < 11s);
    CHECK(c.to.last<imc::VehicleState>().last_error == "maneuver '1': no headway in 10 s, 35 m from its place");
  }
}
