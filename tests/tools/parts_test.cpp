// What graphs can be made of, as `jarol tasks` lists it.
#include <doctest/doctest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "graph/values/bind.h"
#include "graph/values/value.h"
#include "tests/tools/reports.h"
#include "tools/library/built_in.h"

namespace {
using command::has;
using command::json_of;
using command::run_jarol;

std::vector<std::string> names_in(const nlohmann::json& parts) {
  std::vector<std::string> names;
  for (const auto& part : parts) names.push_back(part["name"]);
  return names;
}

nlohmann::json named(const nlohmann::json& list, const std::string& name) {
  for (const auto& each : list)
    if (each["name"] == name) return each;
  return {};
}

// Each parameter takes the default that is shown.
void check_defaults(const jarol::Type& type, const nlohmann::json& part) {
  CHECK(part["parameters"].size() == type.fields.size());
  for (const nlohmann::json& parameter : part["parameters"]) {
    const std::string name = parameter["name"];
    const jarol::TypeField& field = *jarol::find_field(type, name);
    jarol::Problems problems;
    const auto source = std::make_shared<jarol::Source>(jarol::Source{part["name"], parameter["default"]});
    jarol::Value value(*field.type);
    jarol::bind_value(jarol::read_yaml(source, problems), *field.type, field.unit, value.data(), name, problems);
    CHECK_NOTHROW(problems.throw_if_any());
  }
}
}  // namespace

TEST_SUITE("tools/parts") {
  TEST_CASE("tasks reports all about one") {
    CHECK(run_jarol("tasks Accumulate").output ==
          "Accumulate: gives the running sum of its input\n\ninputs\n  in  double\n\noutputs\n  out  double  sum of "
          "all inputs so far\n");
    CHECK(run_jarol("tasks Acumulate").exit_code == 2);
    CHECK(names_in(json_of("tasks --json")["tasks"]) == jarol::names_of(jarol::built_in().graph.tasks()));
    CHECK(names_in(json_of("tasks --json")["distributers"]) == jarol::names_of(jarol::built_in().graph.distributers()));
    CHECK(json_of("tasks LauvVehicle --json")["distributers"][0]["channels"][0] ==
          nlohmann::json{{"name", "motion"},
                         {"direction", "in"},
                         {"type", "Motion"},
                         {"text", "position, attitude and velocities"}});
  }

  TEST_CASE("tasks shows the members of parameters at every depth, each with type, unit, range, text and default") {
    const std::string supervisor = run_jarol("tasks LauvSupervisor").output;
    CHECK(has(
        supervisor,
        "\n  reckoning            Reckoning                                  what instruments are compared with\n"));
    CHECK(
        has(supervisor,
            "\n    reckoning.water.density       double [kg/m^3] from 500 to 2000  of the water; of the sea some 1025, "
            "default 1000\n"));
    const nlohmann::json reckoning =
        named(json_of("tasks LauvSupervisor --json")["tasks"][0]["parameters"], "reckoning");
    CHECK(reckoning["default"] ==
          "{angle_time: 2, floor_time: 30, drag_growth: 1, water: {density: 1000, air_pressure: 1013.25}}");
    CHECK(named(reckoning["members"], "reckoning.water.density") ==
          nlohmann::json{{"name", "reckoning.water.density"},
                         {"type", "double"},
                         {"unit", "kg/m^3"},
                         {"text", "of the water; of the sea some 1025"},
                         {"default", "1000"},
                         {"minimum", 500},
                         {"maximum", 2000}});
  }

  TEST_CASE("tasks shows durations in structs with their unit") {
    CHECK(has(run_jarol("tasks LauvOperator").output,
              "\n    headway.period   duration from 1s to 3600s  from one look at what is left of a leg to the next, "
              "default 30s\n"));
    const nlohmann::json headway =
        named(json_of("tasks LauvOperator --json")["distributers"][0]["parameters"], "headway");
    CHECK(headway["default"] == "{period: 30s, misses: 3, way: 1.5, level: 0.3, circle: 15, station: 2.5}");
    CHECK(named(headway["members"], "headway.period") ==
          nlohmann::json{{"name", "headway.period"},
                         {"type", "duration"},
                         {"unit", ""},
                         {"text", "from one look at what is left of a leg to the next"},
                         {"default", "30s"},
                         {"minimum", "1s"},
                         {"maximum", "3600s"}});
  }

  TEST_CASE("tasks shows the members of inputs and outputs, arrays of numbers and words as one") {
    const std::string supervisor = run_jarol("tasks LauvSupervisor").output;
    CHECK(has(supervisor, "\n    instruments.beacons.1.range          double [m]        from the vehicle\n"));
    CHECK(has(supervisor,
              "\n    fins.states     FinState[4]      of bottom, port, starboard, top\n"
              "      unknown  it has not reported yet, or never does\n"));
    CHECK(has(supervisor, "\n    fins.angles     double[4] [rad]  at which those that are stuck are held\n"));
  }

  TEST_CASE("a default is shown as a graph may say it") {
    const nlohmann::json all = json_of("tasks --json");
    for (const jarol::TaskClass& task : jarol::built_in().graph.tasks())
      check_defaults(*task.parameters, named(all["tasks"], task.name));
    for (const jarol::DistributerClass& distributer : jarol::built_in().graph.distributers())
      if (distributer.parameters != nullptr)
        check_defaults(*distributer.parameters, named(all["distributers"], distributer.name));
  }

  TEST_CASE("tasks lists vehicles, links, policies and grammars, too") {
    const std::string all = run_jarol("tasks").output;
    CHECK(has(all, "\nlinks\n"));
    CHECK(has(all, "\n  lockstep "));
    CHECK(has(all, " a vehicle in another process, on the logical clock, of vehicles\n"));
    CHECK(has(all, "\npolicies\n  table "));
    const auto json = json_of("tasks --json");
    CHECK(has(all, "\ngrammars\n  let "));
    CHECK(json["grammars"].size() == 1);
    CHECK(names_in(json["policies"]) == jarol::names_of(jarol::built_in().graph.policies()));
    CHECK(json["policies"][0]["name"] == "table");
    CHECK(json["policies"][0]["executed_on_real_clock"] == true);
#ifdef JAROL_VEHICLES
    CHECK(has(all, "\nvehicles\n"));
    CHECK(json["vehicles"].size() > 1);
    CHECK(run_jarol("tasks submarine").output ==
          "vehicle submarine: torpedo-shaped AUV with four fins and one propeller (LAUV)\n\njarol vehicle submarine "
          "--describe has its state, inputs and parameters\n");
#endif
  }

  TEST_CASE("tasks shows the keys of a link, and what distinguishes a policy") {
    CHECK(run_jarol("tasks lockstep").output ==
          "link lockstep: a vehicle in another process, on the logical clock, of vehicles\n\nkeys\n"
          "  peer  address and port where it listens; required\n"
          "  key   file of the key that both ends have; default: none\n");
    CHECK(json_of("tasks lockstep --json")["links"][0]["keys"][1]["name"] == "peer");
    CHECK(run_jarol("tasks edf_nonpreemptive").output ==
          "policy edf_nonpreemptive: the task with the earliest deadline starts, and runs to its end\n\n"
          "  a task that runs ends before a more urgent one\n  a task keeps its core\n"
          "  jarol run does not execute it on the real clock\n");
    CHECK(json_of("tasks edf --json")["policies"][0]["interrupts"] == true);
    const auto wrong = run_jarol("tasks edff");
    CHECK(wrong.exit_code == 2);
    CHECK(
        wrong.output.starts_with("error: there is no task, distributer, vehicle, link, policy or grammar 'edff'; did "
                                 "you mean 'edf'?; there are: "));
  }
}
