// IMC's maneuvers as legs, and what can't be flown in words.
#include "distributers/lauv/maneuvers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"
#include "graph/math/geometry.h"
#include "graph/text/errors.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv/origin.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;
using jarol::tests::packed;
using tasks::Course;

using tests::origin;

template <class M>
Maneuver made(const M& m) {
  return make_maneuver(packed(m), origin);
}

// At that place, 3 m deep, at 1.2 m/s.
template <class M>
M at(double north, double east) {
  const EarthRadii radii = earth_radii(origin.latitude);
  M m;
  m.lat = origin.latitude + north / radii.north;
  m.lon = origin.longitude + east / radii.east;
  if constexpr (requires { m.z; }) {
    m.z = 3;
    m.z_units = imc::ZUnits::DEPTH;
  }
  m.speed = 1.2F;
  return m;
}

void check(const PlannedLeg& is, Course course, double north, double east) {
  CHECK(is.leg.course == course);
  CHECK(is.leg.north == doctest::Approx(north));
  CHECK(is.leg.east == doctest::Approx(east));
  CHECK(is.leg.surge == doctest::Approx(1.2));
}
}  // namespace

TEST_SUITE("distributers/lauv_maneuvers") {
  TEST_CASE("a goto is a line to its place, at its depth or altitude, at its speed or thrust") {
    auto m = at<imc::Goto>(100, -50);
    m.timeout = 90;
    auto maneuver = made(m);
    CHECK(maneuver.type == 450);
    CHECK(maneuver.timeout == 90);
    REQUIRE(maneuver.legs.size() == 1);
    check(maneuver.legs[0], Course::line, 100, -50);
    CHECK(maneuver.legs[0].leg.level == 3);
    CHECK(maneuver.legs[0].leg.vertical == tasks::Vertical::depth);
    m.z_units = imc::ZUnits::ALTITUDE;
    m.speed = 60;
    m.speed_units = imc::SpeedUnits::PERCENTAGE;
    maneuver = made(m);
    CHECK(maneuver.legs[0].leg.vertical == tasks::Vertical::altitude);
    CHECK(maneuver.legs[0].leg.drive == tasks::Drive::thrust);
    CHECK(maneuver.legs[0].leg.thrust == doctest::Approx(0.6));
  }

  TEST_CASE("a place is where the page of the console has it, which draws plans") {
    std::ifstream file("tools/console/web/tests/places.json");
    const auto places = nlohmann::json::parse(file);
    CHECK(places.size() == 7);
    for (const auto& place : places) {
      tasks::Leg leg;
      set_place(leg, place["lat"], place["lon"], {place["origin"]["lat"], place["origin"]["lon"]});
      // a rounding of the angle is some nanometres
      CHECK(std::abs(leg.north - place["north"].get<double>()) < 1e-8);
      CHECK(std::abs(leg.east - place["east"].get<double>()) < 1e-8);
    }
  }

  TEST_CASE("a path is a line to each of its points, from where it begins") {
    auto m = at<imc::FollowPath>(10, 20);
    m.points.push_back(packed(imc::PathPoint{0, 5, 0}));
    m.points.push_back(packed(imc::PathPoint{30, 5, 1}));
    const auto legs = made(m).legs;
    REQUIRE(legs.size() == 2);
    check(legs[0], Course::line, 10, 25);
    check(legs[1], Course::line, 40, 25);
    CHECK(legs[1].leg.level == 4);
  }

  // By the stages that DUNE's RowsStages goes through.
  TEST_CASE("rows begin before their corner, go to and fro beyond the area, and across as often as it is wide") {
    auto m = at<imc::Rows>(0, 0);
    m.length = 50;
    m.width = 20;
    m.hstep = 10;
    m.coff = 4;
    m.alternation = 100;
    m.flags = imc::Rows::Flags::SQUARE_CURVE | imc::Rows::Flags::CURVE_RIGHT;
    using Places = std::vector<std::pair<double, double>>;  // along and across the bearing
    const auto is = [&](const Places& places, double bearing, double across) {
      m.bearing = bearing;
      const auto legs = made(m).legs;
      REQUIRE(legs.size() == places.size());
      for (std::size_t k = 0; k < legs.size(); ++k) {
        const auto [a, b] = places[k];
        CAPTURE(k);
        CHECK(legs[k].leg.course == Course::line);
        CHECK(std::abs(legs[k].leg.north - (a * std::cos(bearing) + b * std::cos(across))) < 1e-6);
        CHECK(std::abs(legs[k].leg.east - (a * std::sin(bearing) + b * std::sin(across))) < 1e-6);
      }
    };
    is({{-4, 0}, {0, 0}, {54, 0}, {54, 10}, {-4, 10}, {-4, 20}, {54, 20}}, 0, 90 * degree);
    m.flags = 0;
    m.alternation = 50;
    is({{-4, 0}, {0, 0}, {54, 0}, {50, 5}, {-4, 5}, {0, 20}, {54, 20}}, 90 * degree, 0);
    // a third curve has no room as an even one, though a short one had
    m.width = 29;
    is({{-4, 0}, {0, 0}, {54, 0}, {50, 5}, {-4, 5}, {0, 20}, {54, 20}}, 90 * degree, 0);
    // there and back on one row, then two steps across: a row that is not left is no curve
    m.width = 20;
    m.alternation = 0;
    is({{-4, 0},
        {0, 0},
        {54, 0},
        {50, 0},
        {-4, 0},
        {0, 20},
        {54, 20},
        {50, 20},
        {-4, 20},
        {0, 40},
        {54, 40},
        {50, 40},
        {-4, 40}},
       0, -90 * degree);
    m.coff = 0;
    m.width = 10;
    m.alternation = 100;
    m.cross_angle = 30 * degree;
    is({{0, 0}, {50, 0}, {50, 10}, {0, 10}}, 0, -120 * degree);
    m.flags = imc::Rows::Flags::CURVE_RIGHT;
    is({{0, 0}, {50, 0}, {50, 10}, {0, 10}}, 0, 120 * degree);
    m.hstep = 1e-30F;
    CHECK_THROWS_WITH_AS(made(m), "more than 1000 lines", InputError);
  }

  TEST_CASE("a loiter is a circle, clockwise but where it says otherwise") {
    auto m = at<imc::Loiter>(5, 6);
    m.radius = 25;
    m.duration = 100;
    auto maneuver = made(m);
    REQUIRE(maneuver.legs.size() == 1);
    check(maneuver.legs[0], Course::circle, 5, 6);
    CHECK(maneuver.legs[0].leg.radius == 25);
    CHECK(maneuver.legs[0].leg.duration == 100);
    m.direction = imc::Loiter::Direction::CCLOCKW;
    CHECK(made(m).legs[0].leg.radius == -25);
    m.radius = 0;
    CHECK(made(m).legs[0].leg.radius == -10);
    m.radius = 9;  // too small for the vehicle
    CHECK(made(m).legs[0].leg.radius == -10);
    m.type = imc::Loiter::Type::EIGHT;
    CHECK_THROWS_WITH_AS(made(m), "a loiter is flown as a circle, types 0 and 1, not 3", InputError);
  }

  TEST_CASE("a station is kept by drifting at its place, to which the vehicle goes at its depth") {
    auto m = at<imc::StationKeeping>(5, 6);
    m.radius = 12;
    m.duration = 40;
    const auto legs = made(m).legs;
    REQUIRE(legs.size() == 1);
    check(legs[0], Course::station, 5, 6);
    CHECK(legs[0].leg.level == 3);
    CHECK(legs[0].leg.radius == 12);
    CHECK(legs[0].leg.duration == 40);
  }

  TEST_CASE("an elevator goes to its place, then up or down on a spiral there, or where the vehicle is") {
    auto m = at<imc::Elevator>(5, 6);
    m.start_z = 2;
    m.end_z = 8;
    m.start_z_units = m.end_z_units = imc::ZUnits::DEPTH;
    m.radius = 15;
    auto legs = made(m).legs;
    REQUIRE(legs.size() == 2);
    check(legs[0], Course::line, 5, 6);
    CHECK(legs[0].leg.level == 2);
    check(legs[1], Course::circle, 5, 6);
    CHECK(legs[1].leg.level == 8);
    CHECK(legs[1].leg.until_level);
    CHECK_FALSE(legs[1].here);
    m.flags = imc::Elevator::Flags::CURR_POS;
    legs = made(m).legs;
    REQUIRE(legs.size() == 1);
    CHECK(legs[0].here);
  }

  TEST_CASE(
      "a pop-up goes to its place, comes up, stays as long as it says or until GPS has found it, and dives again") {
    auto m = at<imc::PopUp>(5, 6);
    m.duration = 30;
    m.radius = 20;
    auto legs = made(m).legs;
    REQUIRE(legs.size() == 4);
    check(legs[0], Course::line, 5, 6);
    CHECK(legs[0].leg.level == 3);
    check(legs[1], Course::circle, 5, 6);
    CHECK(legs[1].leg.until_level);
    CHECK(legs[1].leg.level == 0);
    CHECK(legs[2].leg.course == Course::fix);
    CHECK(legs[2].leg.duration == 0);
    CHECK(legs[3].leg.course == Course::circle);
    CHECK(legs[3].leg.until_level);
    CHECK(legs[3].leg.level == 3);
    CHECK(legs[3].here);
    const auto flags = {imc::PopUp::Flags::WAIT_AT_SURFACE, imc::PopUp::Flags::STATION_KEEP};
    for (const auto flag : flags) {
      m.flags = static_cast<std::uint8_t>(flag);
      legs = made(m).legs;
      REQUIRE(legs.size() == 4);
      CHECK(legs[2].leg.course == Course::station);
      CHECK(legs[2].leg.duration == 30);
      CHECK(legs[2].leg.radius == 20);
      CHECK(legs[2].leg.level == 0);
      CHECK(legs[2].here);
    }
    m.flags |= imc::PopUp::Flags::CURR_POS;
    m.duration = 0;
    legs = made(m).legs;
    REQUIRE(legs.size() == 2);
    CHECK(legs[0].here);
    CHECK(legs[0].leg.level == 0);
    CHECK(legs[1].leg.level == 3);
  }

  TEST_CASE("rows that would go back across, and a time-out below zero, are refused") {
    auto rows = at<imc::Rows>(0, 0);
    rows.length = 50;
    rows.alternation = 200;
    CHECK_NOTHROW(made(rows));
    rows.alternation = 201;
    CHECK_THROWS_WITH_AS(made(rows), "alternation is 201 %; it is at most 200 %, of hstep", InputError);
    imc::FollowReference follow;
    follow.timeout = -1;
    CHECK_THROWS_WITH_AS(made(follow), "timeout is -1 s; it can't be negative", InputError);
  }

  TEST_CASE("what can't be flown is refused in words") {
    const auto refuses = [](const auto& m, const char* why) { CHECK_THROWS_WITH_AS(made(m), why, InputError); };
    auto m = at<imc::Goto>(1, 2);
    m.z = -1;
    refuses(m, "z is -1 m; depths and altitudes are not negative");
    m.z = 3;
    m.z_units = imc::ZUnits::HEIGHT;
    refuses(m, "z is taken as DEPTH or ALTITUDE, 1 or 2, not 3");
    m.z_units = imc::ZUnits::DEPTH;
    m.speed = 0;
    refuses(m, "speed is 0 m/s; speeds are 0.2 to 2 m/s");
    m.speed = 1000;
    m.speed_units = imc::SpeedUnits::RPM;
    refuses(m, "speed is taken in m/s or %, 0 or 2, not 1");
    m.speed_units = imc::SpeedUnits::METERS_PS;
    m.lat = std::numeric_limits<double>::quiet_NaN();
    refuses(m, "lat is no number");
    m.lat = 0;
    refuses(m, "its place is 4574 km from the origin; places within 100 km are gone to");
    refuses(imc::StopManeuver{}, "StopManeuver is not flown here");
    refuses(at<imc::FollowPath>(0, 0), "a path has at least one point");
    refuses(at<imc::Rows>(0, 0), "rows of 0 m, 30 m apart over 0 m; lengths are positive");
    auto rows = at<imc::Rows>(0, 0);
    rows.length = rows.width = 1e3F;
    rows.hstep = 1e-3F;
    refuses(rows, "more than 1000 lines");
    rows.length = 1e9F;
    refuses(rows, "its place is 1000000 km from the origin; places within 100 km are gone to");
    auto path = at<imc::FollowPath>(0, 0);
    path.points.push_back(packed(imc::PathPoint{0, -2e5F, 0}));
    refuses(path, "its place is 200 km from the origin; places within 100 km are gone to");
    refuses(at<imc::YoYo>(0, 0), "up and down by 0 m at 0 rad; these are positive, and no more than 0.785 rad");
    CHECK_THROWS_WITH_AS(make_maneuver({}, origin), "there is no maneuver in it", InputError);
  }
}
