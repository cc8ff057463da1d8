// What an operator commands beyond the submarine's limits, and at them, in the simulated vehicles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/how_many.h"
#include "tests/tools/lauv_mission.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using test::Mission;

const bool in_full = is_full();

// What was reached.
struct Reached {
  double depth = 0, altitude = 1e9, pitch = 0;
  tasks::Alarm alarm = tasks::Alarm::none;
};

void note(const Session& session, Reached& reached) {
  reached.depth = std::max(reached.depth, session.true_value("depth of dune"));
  reached.altitude = std::min(reached.altitude, session.true_value("altitude of dune"));
  reached.pitch = std::max(reached.pitch, std::abs(session.true_value("pitch of dune")));
  if (reached.alarm == tasks::Alarm::none)
    reached.alarm = session.value<tasks::Condition>("supervisor.condition").alarm;
}

// A channel of the operator's is given that value, for that time.
template <class T>
Reached sail(const std::string& profile, std::vector<std::string> set, const char* channel, const T& value,
             Duration time, std::uint64_t seed = 3) {
  set.emplace_back("distributers.dune.link.parameters.dynamics=rigid");
  set.emplace_back("expect=nothing");
  auto session =
      jarol::open("specs/exolauv.yaml", {.profile = profile, .set = std::move(set), .seed = seed, .fed = {"neptus"}});
  session.run_for(2s);
  session.feed(channel, value);
  Reached reached;
  while (session.now() < time) {
    session.run_for(100ms);
    note(session, reached);
  }
  return reached;
}

std::string floor_at(double depth) {
  return "distributers.dune.link.parameters.sea.floor=" + std::to_string(depth) + " m";
}

// At the origin, 2 m deep.
template <class M>
imc::PlanControl start_at_origin(M m, double speed) {
  m.lat = LauvOperatorParameters{}.latitude;
  m.lon = LauvOperatorParameters{}.longitude;
  m.z = 2;
  m.z_units = imc::ZUnits::DEPTH;
  m.speed = static_cast<float>(speed);
  imc::PlanControl request;
  request.plan_id = "p";
  request.arg = packed(m);
  return request;
}

double top_speed(const std::string& profile) { return profile == "submarine_dune" ? 1.79 : 2; }
}  // namespace

TEST_SUITE("tools/lauv_limits") {
  TEST_CASE("sent to any depth, at any speed, it keeps off the floor and ends at its limit of depth") {
    for (const std::string profile : {"", "at_sea", "submarine_dune"}) {
      for (const double speed : {0.7, 1.0, 1.4, top_speed(profile)}) {
        CAPTURE(profile);
        CAPTURE(speed);
        const tasks::Setpoint down{.depth = 50, .heading = 40 * degree, .speed = speed};
        const auto near_floor =
            sail(profile, {floor_at(4), "tasks.supervisor.parameters.min_altitude=0.5"}, "neptus.setpoint", down, 40s);
        CHECK(near_floor.altitude > 0.35);  // of the lower end of its hull
        CHECK(near_floor.alarm == tasks::Alarm::altitude_limit);
        const auto deep = sail(profile, {}, "neptus.setpoint", down, speed < 1 ? 100s : 60s);
        CHECK(deep.depth > 11.7);
        CHECK(deep.depth < 12.1);
        CHECK(deep.alarm == tasks::Alarm::depth_limit);
      }
    }
  }

  TEST_CASE(
      "at the surface of water that is 40 cm deeper than its limit waves and noise are no alarm, at rest or ahead") {
    for (const double speed : {0.0, 0.5, 0.8, 1.2}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        CAPTURE(speed);
        CAPTURE(seed);
        const tasks::Setpoint ahead{.heading = 40 * degree, .speed = speed};
        CHECK(sail("at_sea", {floor_at(2.4)}, "neptus.setpoint", ahead, 60s, seed).alarm == tasks::Alarm::none);
      }
    }
  }

  TEST_CASE("plans at the limits less their margin have no alarm, level, up and down or in circles, in waves too") {
    using tasks::Course;
    using tasks::Vertical;
    std::vector<tasks::Leg> legs(4);
    legs[0] = {.course = Course::line, .north = 600, .vertical = Vertical::altitude, .level = 2.5};
    legs[1] = {.course = Course::circle, .radius = 10, .level = 11.5};
    legs[2] = {.course = Course::line, .north = 600, .level = 10, .amplitude = 1.5, .slope = 40 * degree};
    legs[3] = legs[2];
    legs[3].vertical = Vertical::altitude;
    legs[3].level = 4;
    for (const std::string profile : {"", "at_sea", "submarine_dune"}) {
      for (const double speed : {0.5, 1.0, top_speed(profile)}) {
        if (speed < 1 && !in_full) continue;
        for (tasks::Leg leg : legs) {
          leg.number = 1;
          leg.surge = speed;
          CAPTURE(profile);
          CAPTURE(speed);
          CAPTURE(leg.level);
          for (const double floor : {4.0, 9.0}) {
            const bool by_depth = leg.vertical == Vertical::depth;
            if (by_depth && floor < 9) continue;
            const auto reached = sail(profile, by_depth ? std::vector<std::string>{} : std::vector{floor_at(floor)},
                                      "neptus.leg", leg, 90s);
            CHECK(reached.alarm == tasks::Alarm::none);
            CHECK(reached.depth > (by_depth ? speed < 1 ? 1.0 : 11.0 : 1.0));
          }
        }
      }
    }
  }

  TEST_CASE("a plan against a current that it can't stem ends as failed, within minutes; in a weaker one it is flown") {
    imc::StationKeeping station;
    station.radius = 15;
    station.duration = 120;
    imc::Loiter loiter;
    loiter.radius = 15;
    loiter.duration = 120;
    for (const auto& request :
         {start_at_origin(station, 1), start_at_origin(loiter, 1), start_at_origin(imc::Goto{}, 1)}) {
      for (const double current : {0.6, 1.5}) {
        CAPTURE(request.arg.id);
        CAPTURE(current);
        Mission mission({"distributers.dune.link.parameters.sea.current_east=" + std::to_string(current) + " m/s"});
        mission.fly(30s);
        mission.say(request);
        CHECK(mission.fly(current > 1 ? 400s : 900s, [&] { return mission.is_over() && mission.now() > 31s; }));
        using Outcome = imc::PlanControlState::LastOutcome;
        CHECK(mission.plan().last_outcome == (current > 1 ? Outcome::FAILURE : Outcome::SUCCESS));
        MESSAGE(seconds(mission.now()) << " s, " << mission.console.to.last<imc::VehicleState>().last_error.view());
      }
    }
  }

  TEST_CASE("a console that sends it deeper or astern has it within its limits, without an alarm") {
    for (const std::string profile : {"", "at_sea", "submarine_dune"}) {
      for (const double percent : {-20.0, -70.0, -100.0}) {
        CAPTURE(profile);
        CAPTURE(percent);
        Mission mission({}, profile);
        Reached reached;
        const auto fly = [&](Duration time) {
          for (const Duration end = mission.now() + time; mission.now() < end;) {
            mission.say(imc::Heartbeat{});
            mission.fly(100ms);
            reached.depth = std::max(reached.depth, mission.truth("depth"));
            reached.pitch = std::max(reached.pitch, std::abs(mission.truth("pitch")));
            if (reached.alarm == tasks::Alarm::none) reached.alarm = mission.alarm();
          }
        };
        mission.say(imc::DesiredZ{50, imc::ZUnits::DEPTH});
        mission.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
        fly(60s);
        CHECK(reached.depth == doctest::Approx(11.55).scale(0).epsilon(0.01));
        mission.say(imc::DesiredSpeed{percent, imc::SpeedUnits::PERCENTAGE});
        fly(300s);  // up, by buoyancy
        mission.say(imc::DesiredZ{0, imc::ZUnits::DEPTH});
        mission.say(imc::DesiredSpeed{percent, imc::SpeedUnits::PERCENTAGE});
        fly(60s);
        CHECK(reached.alarm == tasks::Alarm::none);
        CHECK(reached.depth < 12);
        CHECK(reached.pitch < 50 * degree);
      }
    }
  }
}
