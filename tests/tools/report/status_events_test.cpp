// What a run's report says of a vehicle's own decisions.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tasks/values/lauv.h"
#include "tests/tools/run_command.h"
#include "tools/report/noted_report.h"

namespace {
using namespace jarol;
using tasks::Alarm;

// An operator's side, with an `out` communicator for its reports and one for a bare alarm.
Graph operator_graph(DistributerClass& its) {
  its.channels.push_back({"report", Direction::out, &type_of<tasks::VehicleReport>(), ""});
  its.channels.push_back({"alarm", Direction::out, &type_of<Alarm>(), ""});
  Graph graph;
  graph.distributers.resize(1);
  graph.distributers[0].distributer_class = &its;
  for (std::size_t i = 0; i < 2; ++i) {
    graph.communicators.emplace_back();
    graph.communicators[i].name = i == 0 ? "to_neptus" : "to_siren";
    graph.communicators[i].direction = Direction::out;
    graph.communicators[i].type = its.channels[i].type;
    graph.communicators[i].distributer = 0;
    graph.communicators[i].channel = i;
  }
  return graph;
}

// What is told of a run that publishes one alarm a second, on both channels.
struct Reported {
  explicit Reported(const std::vector<Alarm>& alarms) {
    for (std::size_t i = 0; i < alarms.size(); ++i) {
      const tasks::VehicleReport report{.alarm = alarms[i]};
      changes.take(std::chrono::seconds(i), 0, &report);
      changes.take(std::chrono::seconds(i), 1, &alarms[i]);
    }
  }
  std::string to_text() const { return tools::to_text(changes.kept()); }
  nlohmann::ordered_json to_json() const { return tools::to_json(changes.kept()); }
  DistributerClass its;
  Graph graph = operator_graph(its);
  StatusEvents changes{graph};
};

#ifdef JAROL_VEHICLES

std::vector<std::string> reported_in(const std::string& report) {
  std::vector<std::string> lines;
  const std::string begin = "  event       ";
  for (std::size_t at = 0; (at = report.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    lines.push_back(report.substr(at, report.find('\n', at) - at));
  }
  return lines;
}

const std::string sonar = " --set distributers.robostix.link.parameters.failures.sonar.";
const std::string leak = " --set 'distributers.dune.link.parameters={leak_at: 500ms}'";
#endif
}  // namespace

TEST_SUITE("tools/status_events") {
  TEST_CASE("what has a meaning is reported when it comes, changes and goes") {
    const std::vector<Alarm> alarms{Alarm::none, Alarm::none, Alarm::gps, Alarm::gps, Alarm::speed, Alarm::none};
    const Reported reported(alarms);
    CHECK(reported.changes.can_be_any());
    CHECK((reported.changes.wants(0) && reported.changes.wants(1) && !reported.changes.wants(2)));
    CHECK(
        reported.to_text() ==
        "  event       to_neptus at 2 s: alarm gps, fins checked: it stays at the surface, as GPS is silent\n"
        "  event       to_siren at 2 s: gps: it stays at the surface, as GPS is silent\n"
        "  event       to_neptus at 4 s: alarm speed: it comes up, as the speed log or the propeller's speed is silent "
        "or wrong\n"
        "  event       to_siren at 4 s: speed: it comes up, as the speed log or the propeller's speed is silent or "
        "wrong\n"
        "  event       to_neptus at 5 s: alarm none\n"
        "  event       to_siren at 5 s: none\n");
    CHECK(reported.to_json()[1].dump() ==
          R"({"communicator":"to_siren","instant_ns":2000000000,"values":{"value":"gps"},)"
          R"("meanings":["it stays at the surface, as GPS is silent"]})");
  }

  TEST_CASE("what holds from the first value on is reported, and no change without a meaning") {
    CHECK(Reported({Alarm::leak, Alarm::leak}).to_text() ==
          "  event       to_neptus at 0 s: alarm leak, fins checked: it comes up, as there is water at the first leak "
          "sensor, or that is silent\n"
          "  event       to_siren at 0 s: leak: it comes up, as there is water at the first leak sensor, or that is "
          "silent\n");
    CHECK(Reported({Alarm::none, Alarm::none}).to_text() == "");
  }

  TEST_CASE("of very many changes the first are reported, and how many more there were") {
    std::vector<Alarm> alarms;
    for (int i = 0; i < 150; ++i) alarms.push_back(i % 2 == 0 ? Alarm::heading : Alarm::none);
    const std::string text = Reported(alarms).to_text();
    CHECK(std::count(text.begin(), text.end(), '\n') == 2 * (100 + 1));
    CHECK(
        text.ends_with("  event       to_neptus: and 50 changes more\n  event       to_siren: and 50 changes more\n"));
    CHECK(Reported(alarms).to_json().size() == 200);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("of a flight or a dive without an event nothing is reported") {
    CHECK(reported_in(command::run_jarol("run specs/javiator.yaml").output).empty());
    CHECK(reported_in(command::run_jarol("run specs/exolauv.yaml").output).empty());
    CHECK(nlohmann::json::parse(command::run_jarol("run specs/exolauv.yaml --for 2s --json").output)["events"] ==
          nlohmann::json::array());
  }

  TEST_CASE("a landing that nobody wanted is reported with its instant and its cause, and how it ended") {
    const std::string run = "run specs/javiator.yaml" + sonar + "kind=lost" + sonar + "at=12s";
    CHECK(reported_in(command::run_jarol(run).output) ==
          std::vector<std::string>{
              "to_terminal at 12.28 s: state landing, cause sonar_lost: the sonar reports nothing credible",
              "to_terminal at 18.25 s: state ground", "to_terminal at 28.03 s: cause none"});
    CHECK(nlohmann::json::parse(command::run_jarol(run + " --json", "2>/dev/null").output)["events"][0] ==
          nlohmann::json{{"communicator", "to_terminal"},
                         {"instant_ns", 12'280'000'000},
                         {"values", {{"state", "landing"}, {"cause", "sonar_lost"}}},
                         {"meanings", {"the sonar reports nothing credible"}}});
  }

  TEST_CASE("servos that report nothing are reported 2.5 s after the vehicle was heard, as fins that are not checked") {
    const std::string run =
        "run specs/exolauv.yaml --for 4s --set distributers.dune.link.parameters.sensors.servos.failure=";
    CHECK(reported_in(command::run_jarol(run + "'{kind: lost}'").output) ==
          std::vector<std::string>{
              "to_neptus at 2.52 s: alarm none, fins unchecked: no fin is checked, as no servo reports where it is"});
    CHECK(reported_in(command::run_jarol(run + "'{kind: lost, lasts: 3 s}'").output) ==
          std::vector<std::string>{
              "to_neptus at 2.52 s: alarm none, fins unchecked: no fin is checked, as no servo reports where it is",
              "to_neptus at 3.02 s: fins checked"});
  }

  TEST_CASE("a fin that has failed and ends no dive is an event of the run") {
    const std::string run =
        "run specs/exolauv.yaml --for 8s --set tasks.supervisor.parameters.fins_end_dive=false "
        "--set 'distributers.dune.link.parameters={dynamics: rigid, failures: {fin3: {kind: hardover, at: 5, to: 1}}}'";
    CHECK(reported_in(command::run_jarol(run).output) ==
          std::vector<std::string>{
              "to_neptus at 6.02 s: alarm none, fins top_failed: the top rudder is stuck or its servo silent"});
  }

  TEST_CASE("water in the hull is reported, on any clock and by threads too") {
    const std::string line =
        "alarm leak, fins checked: it comes up, as there is water at the first leak sensor, or that is silent";
    const std::string run = "run specs/exolauv.yaml" + leak + " --for ";
    CHECK(reported_in(command::run_jarol(run + "1200ms").output) ==
          std::vector<std::string>{"to_neptus at 1.02 s: " + line});
    for (const std::string concurrency : {"exotasks", "threads"}) {
      // longer where the machine was late
      std::vector<std::string> reported;
      for (int ms = 1200; reported.empty() && ms < 60'000; ms *= 2)
        reported = reported_in(
            command::run_jarol(run + std::to_string(ms) + "ms --clock real --concurrency " + concurrency).output);
      REQUIRE(reported.size() == 1);
      CHECK(reported[0].ends_with(" s: " + line));
    }
  }

  TEST_CASE("an alarm that is over is reported, too") {
    const auto reported =
        reported_in(command::run_jarol("run specs/exolauv.yaml --for 110s --set "
                                       "distributers.neptus.link.file=../tests/data/lauv-recovered.csv")
                        .output);
    CHECK(reported ==
          std::vector<std::string>{
              "to_neptus at 36.02 s: alarm operator_lost, fins checked: it comes up, as the operator is silent",
              "to_neptus at 70.02 s: alarm none"});
  }
#endif
}
