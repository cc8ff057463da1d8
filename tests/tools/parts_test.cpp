// What graphs can be made of, as `jarol tasks` lists it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
