// Plans as a console of DUNE's sends them, flown by the shipped graph in the simulated vehicle.
// In one file: all cases fly one mission with one console.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"
#include "tests/distributers/lauv_console.h"
#include "tests/how_many.h"
#include "tests/tools/lauv_mission.h"
#include "tests/tools/lauv_plan.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using test::Mission;

template <class M>
imc::PlanControl start(const char* name, const M& m) {
  imc::PlanControl control;
  control.plan_id = name;
  control.arg = packed(m);
  return control;
}

std::vector<std::string> current(double north, double east) {
  const std::string sea = "distributers.dune.link.parameters.sea.current_";
  return {sea + "north=" + std::to_string(north) + " m/s", sea + "east=" + std::to_string(east) + " m/s"};
}

// Each is whole plans; the first alone where tries_less.
std::vector<std::vector<std::string>> currents(std::vector<std::vector<std::string>> all) {
  if (tries_less) all.resize(1);
  return all;
}

void fly_square(const std::vector<std::string>& set, double settled_after, double widest, double widest_turn) {
  Mission mission(set);
  const double corners[][2] = {{60, 0}, {60, 60}, {0, 60}, {0, 0}};
  PlanOf plan("square");
  const char* names[] = {"Goto1", "Goto2", "Goto3", "Goto4"};
  for (int k = 0; k < 4; ++k) plan.then(names[k], maneuver<imc::Goto>(corners[k][0], corners[k][1]));
  mission.say(plan.start());
  mission.fly(100ms);
  const auto reply = mission.console.to.last<imc::PlanControl>();
  CHECK(reply.info == "");
  CHECK(reply.type == imc::PlanControl::Type::SUCCESS);
  CHECK(reply.request_id == 21);
  std::map<std::string, double> worst;
  std::string leg;
  double since = 0, outside = 0, depth_error = 0;
  const bool done = mission.fly(400s, [&] {
    const auto state = mission.plan();
    if (mission.is_over()) return true;
    if (std::string(state.man_id.view()) != leg) since = 0, leg = state.man_id.view();
    since += 0.1;
    // the true distance from the side of the square, and out of the square
    const double x = mission.truth("x"), y = mission.truth("y");
    const double off = leg == "Goto1" ? y : leg == "Goto2" ? x - 60 : leg == "Goto3" ? y - 60 : x;
    if (since > settled_after) worst[leg] = std::max(worst[leg], std::abs(off));
    outside = std::max({outside, -x, x - 60, -y, y - 60});
    if (mission.now() > 40s) depth_error = std::max(depth_error, std::abs(mission.truth("depth") - 3));
    return false;
  });
  CHECK(done);
  CHECK(mission.plan().last_outcome == imc::PlanControlState::LastOutcome::SUCCESS);
  CHECK(worst.size() == 4);
  for (const auto& each : worst) {
    CAPTURE(each.first);
    CHECK(each.second < widest);
    MESSAGE(each.second << " m off its side, from " << settled_after << " s after the turn began");
  }
  MESSAGE("out of the square by " << outside << " m, depth within " << depth_error << " m, " << seconds(mission.now())
                                  << " s");
  CHECK(outside < widest_turn);
  CHECK(depth_error < 0.1);
  CHECK(std::hypot(mission.truth("x"), mission.truth("y")) < 3);
}

// Its station has a radius of 10 m, beyond which it drifts before it comes back.
void fly_five(const std::vector<std::string>& set, double farthest) {
  Mission mission(set);
  imc::Rows rows = maneuver<imc::Rows>(30, 0);
  rows.length = 40;
  rows.width = 20;
  rows.hstep = 20;
  rows.coff = 5;
  rows.alternation = 100;
  rows.flags = imc::Rows::Flags::SQUARE_CURVE | imc::Rows::Flags::CURVE_RIGHT;
  auto yoyo = maneuver<imc::YoYo>(0, 20);
  yoyo.z = 4;
  yoyo.amplitude = 1.5F;
  yoyo.pitch = static_cast<float>(15 * degree);
  auto elevator = maneuver<imc::Elevator>(0, 0);
  elevator.start_z = 2;
  elevator.end_z = 6;
  elevator.start_z_units = elevator.end_z_units = imc::ZUnits::DEPTH;
  elevator.radius = 8;
  auto station = maneuver<imc::StationKeeping>(0, 0, 0);
  station.radius = 10;
  station.duration = 30;
  mission.say(PlanOf("five")
                  .then("Goto1", maneuver<imc::Goto>(30, 0))
                  .then("Rows2", rows)
                  .then("YoYo3", yoyo)
                  .then("Elevator4", elevator)
                  .then("StationKeeping5", station)
                  .start());
  std::vector<std::string> flown;
  std::map<std::string, std::pair<double, double>> depths;  // min and max
  std::map<std::string, std::pair<double, double>> ends;    // true places
  double progress = 0, rows_east = 0;
  const bool done = mission.fly(900s, [&] {
    const auto state = mission.plan();
    if (mission.is_over() && mission.now() > 1s) return true;
    const std::string name(state.man_id.view());
    if (flown.empty() || flown.back() != name) {
      if (!name.empty()) flown.push_back(name);
      depths[name] = {1e9, -1e9};
    }
    if (name.empty()) return false;
    ends[name] = {mission.truth("x"), mission.truth("y")};
    CHECK(name.starts_with(imc::message_set().find(state.man_type, 0)->name));
    CHECK(state.plan_progress >= static_cast<float>(progress));
    progress = static_cast<double>(state.plan_progress);
    const double depth = mission.truth("depth");
    auto& [min, max] = depths[name];
    if (mission.progress().distance < 45) min = std::min(min, depth), max = std::max(max, depth);
    if (name == "Rows2") rows_east = std::max(rows_east, mission.truth("y"));
    return false;
  });
  CHECK(done);
  CHECK(flown == std::vector<std::string>{"Goto1", "Rows2", "YoYo3", "Elevator4", "StationKeeping5"});
  CHECK(mission.plan().last_outcome == imc::PlanControlState::LastOutcome::SUCCESS);
  CHECK(rows_east == doctest::Approx(20).scale(0).epsilon(0.15));
  CHECK(depths["YoYo3"].first == doctest::Approx(2.5).scale(0).epsilon(0.2));
  CHECK(depths["YoYo3"].second == doctest::Approx(5.5).scale(0).epsilon(0.1));
  CHECK(depths["Elevator4"].second == doctest::Approx(6).scale(0).epsilon(0.1));
  // where it truly was when the next one began: on the line to its place, on its last row, on its circle
  CHECK(std::abs(ends["Goto1"].second) < 0.1);
  CHECK(std::abs(ends["Rows2"].second - 20) < 0.1);
  CHECK(std::abs(ends["YoYo3"].second - 20) < 0.1);
  CHECK(std::hypot(ends["Elevator4"].first, ends["Elevator4"].second) == doctest::Approx(10).scale(0).epsilon(0.3));
  CHECK(mission.truth("depth") < 0.2);
  CHECK(std::hypot(mission.truth("x"), mission.truth("y")) < farthest);
}
}  // namespace

TEST_SUITE("tools/dune_plans") {
  TEST_CASE("on a square of 60 m it is within 1 m of each side from 15 s after a turn began") {
    fly_square({}, 15, 1, 2);
  }

  // which carries it out of its turns
  TEST_CASE("in a current of 0.3 m/s it is within 0.5 m of each side from 25 s after a turn began") {
    for (const auto& set : currents({current(0, 0.3), current(-0.21, 0.21)})) {
      CAPTURE(set[0]);
      CAPTURE(set[1]);
      fly_square(set, 25, 0.5, 4);
    }
  }

  TEST_CASE("a path of three points is flown from line to line, and ends at the last") {
    for (const bool drifts : {false, true}) {
      if (tries_less && drifts) break;
      CAPTURE(drifts);
      Mission mission(current(0, drifts ? 0.3 : 0));
      auto path = maneuver<imc::FollowPath>(0, 0);
      for (const auto& [x, y, z] : {std::array{60.0F, 0.0F, 0.0F}, {60.0F, 50.0F, 1.0F}, {10.0F, 50.0F, 2.0F}})
        path.points.push_back(packed(imc::PathPoint{x, y, z}));
      mission.say(start("path", path));
      std::vector<std::uint32_t> legs;
      std::array<double, 3> worst{}, depths{};
      double since = 0, end = 0;
      CHECK(mission.fly(300s, [&] {
        if (mission.is_over() && mission.now() > 1s) return true;
        const std::uint32_t leg = mission.progress().on_leg;
        if (leg == 0) return false;
        if (legs.empty() || legs.back() != leg) legs.push_back(leg), since = 0;
        since += 0.1;
        REQUIRE(legs.size() <= 3);
        const std::size_t k = legs.size() - 1;
        const double x = mission.truth("x"), y = mission.truth("y");
        const double off = k == 0 ? y : k == 1 ? x - 60 : y - 50;
        if (since > (drifts ? 25 : 15)) worst[k] = std::max(worst[k], std::abs(off));
        depths[k] = mission.truth("depth");
        end = std::hypot(x - 10, y - 50);
        return false;
      }));
      CHECK(mission.plan().last_outcome == imc::PlanControlState::LastOutcome::SUCCESS);
      CHECK(legs.size() == 3);
      for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        MESSAGE("off its line by " << worst[k] << " m, at its end " << depths[k] << " m deep");
        CHECK(worst[k] < (drifts ? 0.5 : 1));
        CHECK(depths[k] == doctest::Approx(3 + static_cast<double>(k)).scale(0).epsilon(0.05));
      }
      MESSAGE("ends " << end << " m from its end");
      CHECK(end < 2.5);
    }
  }

  TEST_CASE("a loiter holds its radius, both ways round, and ends after its time") {
    for (const std::uint8_t way : {imc::Loiter::Direction::CLOCKW, imc::Loiter::Direction::CCLOCKW}) {
      CAPTURE(int(way));
      Mission mission;
      auto loiter = maneuver<imc::Loiter>(40, 0);
      loiter.radius = 15;
      loiter.duration = 150;
      loiter.direction = way;
      mission.say(start("round", loiter));
      CHECK(mission.fly(120s, [&] { return mission.progress().near; }));
      mission.fly(60s);
      double worst = 0, turned = 0, last = mission.truth("heading");
      CHECK(mission.fly(200s, [&] {
        if (mission.is_over()) return true;
        worst = std::max(worst, std::abs(std::hypot(mission.truth("x") - 40, mission.truth("y")) - 15));
        turned += wrapped(mission.truth("heading") - last);
        last = mission.truth("heading");
        return false;
      }));
      MESSAGE("radius within " << worst << " m");
      CHECK(worst < 0.5);
      CHECK((way == imc::Loiter::Direction::CLOCKW ? turned : -turned) > 2 * pi);
      CHECK(mission.plan().last_outcome == imc::PlanControlState::LastOutcome::SUCCESS);
    }
  }

  TEST_CASE("a plan of five maneuvers is flown in their order, each reported by its name and type") {
    fly_five({}, 12);
  }

  TEST_CASE("in a current of 0.3 m/s the plan of five maneuvers is flown, too, and each ends where it is to") {
    for (const auto& set : currents({current(0, 0.3), current(-0.3, 0)})) {
      CAPTURE(set[0]);
      CAPTURE(set[1]);
      fly_five(set, 15);
    }
  }

  TEST_CASE("it comes up where a pop-up says, stays there for its time or until GPS has found it, dives and goes on") {
    for (const bool stays : {true, false}) {
      CAPTURE(stays);
      Mission mission;
      auto up = maneuver<imc::PopUp>(40, 10);
      up.flags = stays ? imc::PopUp::Flags::WAIT_AT_SURFACE : 0;
      up.duration = 20;
      mission.say(PlanOf("look").then("PopUp1", up).then("Goto2", maneuver<imc::Goto>(0, 0)).start());
      double deepest = 0, at_surface = 0, again = 0;
      CHECK(mission.fly(400s, [&] {
        const double depth = mission.truth("depth");
        deepest = std::max(deepest, depth);
        if (deepest > 2.5 && depth < 0.3) at_surface += 0.1;
        if (at_surface > 0) again = depth;
        return mission.plan().man_id == "Goto2";
      }));
      CHECK(deepest > 2.5);
      CHECK(again > 2.5);
      CHECK((at_surface > 18) == stays);
      CHECK(std::hypot(mission.truth("x") - 40, mission.truth("y") - 10) < 35);
    }
  }

  TEST_CASE("it follows references while they come, circles where they end, and fails when they do") {
    Mission mission;
    imc::FollowReference follow;
    follow.control_src = 0xffff;
    follow.control_ent = 0xff;
    follow.timeout = 10;
    follow.loiter_radius = 12;
    mission.say(start("lead", follow));
    mission.fly(100ms);
    CHECK(mission.console.to.last<imc::FollowRefState>().state == imc::FollowRefState::State::WAIT);
    imc::Reference reference = at<imc::Reference>(40, 20);
    reference.flags = imc::Reference::Flags::LOCATION | imc::Reference::Flags::SPEED | imc::Reference::Flags::Z;
    reference.speed = packed(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
    reference.z = packed(imc::DesiredZ{2, imc::ZUnits::DEPTH});
    const auto state = [&] { return mission.console.to.last<imc::FollowRefState>().state; };
    for (int k = 0; k < 20; ++k) {
      mission.say(reference);
      mission.fly(5s);
      if (k == 1) CHECK(state() == imc::FollowRefState::State::GOTO);
    }
    CHECK(state() == imc::FollowRefState::State::LOITER);
    CHECK(mission.truth("depth") == doctest::Approx(2).scale(0).epsilon(0.05));
    CHECK(std::hypot(mission.truth("x") - 40, mission.truth("y") - 20) == doctest::Approx(12).scale(0).epsilon(0.05));
    CHECK(mission.fly(12s, [&] { return mission.is_over(); }));
    CHECK(mission.plan().last_outcome == imc::PlanControlState::LastOutcome::FAILURE);
    CHECK(mission.console.to.last<imc::VehicleState>().last_error == "maneuver '1': no reference for 10 s");
    mission.fly(60s);
    CHECK(mission.truth("depth") < 0.3);  // it has come up
  }
}
