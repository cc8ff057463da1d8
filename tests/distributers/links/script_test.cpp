#include "distributers/links/script.h"

#include <doctest/doctest.h>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/operator.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;

const DistributerClass& operator_class() {
  static const DistributerClass made = distributer_class<LauvOperator>();
  return made;
}

std::string report_on_script(const std::string& text) {
  Problems problems;
  ScriptSystem(std::make_shared<Source>(Source{"m.csv", text}), operator_class(), problems);
  try {
    problems.throw_if_any();
  } catch (const SpecError& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("distributers/links/script") {
  TEST_CASE("a row holds from its time until the next, an empty cell keeps what was") {
    Problems problems;
    ScriptSystem script(
        std::make_shared<Source>(Source{"m.csv",
                                        "# a mission\ntime,setpoint.depth, setpoint.heading\n0,1,90deg\n\n"
                                        "0.5,,-1\r\n2,3,0\n"}),
        operator_class(), problems);
    CHECK(problems.empty());
    tasks::Setpoint setpoint;
    script.reach(0ms);
    CHECK(script.take(0, &setpoint));
    CHECK(setpoint.depth == 1);
    CHECK(setpoint.heading == doctest::Approx(1.5707963267948966));
    CHECK_FALSE(script.take(0, &setpoint));
    script.reach(499ms);
    CHECK_FALSE(script.take(0, &setpoint));
    script.reach(500ms);
    CHECK(script.take(0, &setpoint));
    CHECK(setpoint.depth == 1);
    CHECK(setpoint.heading == -1);
    CHECK_FALSE(script.take(1, &setpoint));
  }

  TEST_CASE("times are taken as programs write them, to the nanosecond") {
    Problems problems;
    const ScriptSystem script(
        std::make_shared<Source>(Source{"m.csv", "time,setpoint.depth\n0,1\n0.30000000000000004,1\n1.25e1,2\n"}),
        operator_class(), problems);
    CHECK(problems.empty());
    CHECK(script.end() == 12500ms);
  }

  TEST_CASE("the mission ends at the time of its last row") {
    Problems problems;
    const ScriptSystem script(std::make_shared<Source>(Source{"m.csv", "time,setpoint.depth\n0,1\n12.5,1\n"}),
                              operator_class(), problems);
    CHECK(script.end() == 12500ms);
  }

  TEST_CASE("of rows that pass between two looks the last counts") {
    Problems problems;
    ScriptSystem script(std::make_shared<Source>(Source{"m.csv", "time,setpoint.depth\n0,1\n1,2\n2,3\n9,9\n"}),
                        operator_class(), problems);
    script.reach(5s);
    tasks::Setpoint setpoint;
    CHECK(script.take(0, &setpoint));
    CHECK(setpoint.depth == 3);
  }

  TEST_CASE("everything wrong with a script is reported with its place") {
    CHECK(report_on_script("time,setpoint.deep\n0,1\n") ==
          "m.csv:1:6: error: column 'setpoint.deep' is no field of an 'in' channel of LauvOperator; did you mean "
          "'setpoint.depth'?; "
          "there are: setpoint.depth, setpoint.heading, setpoint.speed, setpoint.turn, setpoint.rate, "
          "setpoint.drive, setpoint.thrust, actuation.thruster, actuation.fins.0, "
          "actuation.fins.1, "
          "actuation.fins.2, actuation.fins.3, leg.number, leg.course, leg.north, leg.east, leg.turn, leg.radius, "
          "leg.duration, leg.until_level, leg.vertical, leg.level, leg.amplitude, leg.slope, leg.drive, leg.surge, "
          "leg.thrust, contact.silence, contact.stops\n"
          "  time,setpoint.deep\n"
          "       ^");
    CHECK(report_on_script("t,setpoint.depth\n0,x\n0,1\n1,1,1\n-1,2\n") ==
          "m.csv:1:1: error: the first column is 't'; it has to be 'time'\n"
          "  t,setpoint.depth\n"
          "  ^\n"
          "m.csv:2:3: error: column 'setpoint.depth': 'x' is not a number\n"
          "  0,x\n"
          "    ^\n"
          "m.csv:3:1: error: time 0 is not after that of the row before\n"
          "  0,1\n"
          "  ^\n"
          "m.csv:4:1: error: the row has 3 cells; the title row has 2\n"
          "  1,1,1\n"
          "  ^\n"
          "m.csv:5:1: error: time '-1' is no number of seconds from 0 on\n"
          "  -1,2\n"
          "  ^");
    CHECK(report_on_script("") ==
          "m.csv:1:1: error: a script needs a title row and at least one row with a time\n"
          "  \n"
          "  ^");
  }

  TEST_CASE("what a mission is to reach stands above its titles, each condition with its place") {
    Problems problems;
    const ScriptSystem script(
        std::make_shared<Source>(Source{"m.csv",
                                        "# a mission\nexpect: depth of dune within 0.1 of 3 # and no deeper\r\n\n"
                                        "  expect:  max(a.b) < 3,2\ntime,setpoint.depth\n0,1\n"}),
        operator_class(), problems);
    CHECK(problems.empty());
    const std::span<const Yaml> expected = script.expectations();
    REQUIRE(expected.size() == 2);
    CHECK(expected[0].kind == Yaml::Kind::scalar);
    CHECK(expected[0].text == "depth of dune within 0.1 of 3");
    CHECK(expected[0].where.line == 2);
    CHECK(expected[0].where.column == 9);
    CHECK(expected[1].text == "max(a.b) < 3,2");
    CHECK(expected[1].where.line == 4);
    CHECK(expected[1].where.column == 12);
    CHECK(report_on_script("expect: # nothing\ntime,setpoint.depth\nexpect: a < 1\n0,1\n") ==
          "m.csv:1:1: error: 'expect' needs a condition, as in 'expect: depth of dune within 0.1 of 3'\n"
          "  expect: # nothing\n"
          "  ^\n"
          "m.csv:3:1: error: 'expect' stands below the title row; it has to stand above\n"
          "  expect: a < 1\n"
          "  ^");
  }

  TEST_CASE("a table of more cells than anyone drives by is an error") {
    CHECK(report_on_script(std::string(1'000'001, ','))
              .starts_with("m.csv:1:1: error: the table has more than 1000000 cells; leave rows out\n"));
  }
}
