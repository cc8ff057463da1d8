// The determinism contract as the command keeps it: what the outcome depends on, and what it does not.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/run_command.h"

namespace {
using command::run_jarol;
using command::TemporaryFolder;

nlohmann::json report_in(const std::string& arguments) {
  return nlohmann::json::parse(run_jarol("run " + arguments + " --json", "2>/dev/null").output);
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

// Periods and offsets that meet now and then, names whose order is not that of their letters.
constexpr const char* mixed = R"(graph: t
communicators:
  b: {type: double, direction: out, period: 6ms, offset: 1ms}
  a_: {type: double, direction: in, init: 0.5, period: 4ms}
tasks:
  a: {type: Counter, period: 3ms}
  a0: {type: Accumulate, period: 2ms, let: 2ms}
  B: {type: Relay, period: 12ms, offset: 5ms, let: 1ms}
  _: {type: Relay, period: 4ms}
connections: [a.out -> b, a_ -> _.in, _.out -> a0.in, a0.out -> B.in]
)";

#ifdef JAROL_VEHICLES
// A submarine with noise in every sensor for each name; more tasks beside them as asked.
std::string submarines(const std::vector<std::string>& names, const std::string& tasks = "") {
  const std::string vehicle = std::filesystem::absolute("specs/vehicles/submarine_at_sea.yaml").string();
  std::string distributers, communicators, connections;
  for (const std::string& name : names) {
    distributers += "  " + name + ": {type: LauvVehicle, link: {type: simulation, vehicle: " + vehicle + "}}\n";
    communicators += "  from_" + name + ": {channel: " + name + ".instruments}\n  " + name +
                     "_told: {type: Instruments, direction: out}\n";
    connections += "  - from_" + name + " -> " + name + "_told\n";
  }
  return "graph: t\ntiming: {period: 50ms}\ndistributers:\n" + distributers + "communicators:\n" + communicators +
         "tasks:\n" + tasks + "connections:\n" + connections;
}
#endif
}  // namespace

TEST_SUITE("tools/contract") {
  TEST_CASE("a trace has a row for each instant before the end, in their order, and outputs by name, bytewise") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", mixed), trace = folder / "t.csv";
    for (const char* const workers : {"1", "4"}) {
      const auto run = report_in(graph + " --for 12ms --trace " + trace + " --workers " + workers);
      CHECK(run["simulated_ns"] == 12'000'000);
      CHECK(lines_of(trace) == std::vector<std::string>{"time,B.out,_.out,a.out,a0.out,a_,b",  //
                                                        "0,,0.5,0,,0.5,",                      //
                                                        "0.001,,,,,,0",                        //
                                                        "0.002,,,,0.5,,",                      //
                                                        "0.003,,,1,,,",                        //
                                                        "0.004,,0.5,,1,0.5,",                  //
                                                        "0.006,1,,2,1.5,,",                    //
                                                        "0.007,,,,,,2",                        //
                                                        "0.008,,0.5,,2,0.5,",                  //
                                                        "0.009,,,3,,,",                        //
                                                        "0.01,,,,2.5,,"});
    }
    // a nanosecond more, and what is due at 12 ms is there too
    report_in(graph + " --for 12000001ns --trace " + trace);
    CHECK(lines_of(trace).back() == "0.012,,0.5,4,3,0.5,");
  }

  TEST_CASE("tasks have no seed: without vehicles every seed gives the same") {
    const std::string digest = report_in("specs/counting.yaml --for 1s")["digest"];
    for (const char* const seed : {"0", "1", "18446744073709551615"})
      CHECK(report_in(std::string("specs/counting.yaml --for 1s --seed ") + seed)["digest"] == digest);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("--seed is spread by name: nobody's numbers depend on who else is there, and two of a kind have others") {
    const TemporaryFolder folder;
    const auto reported = [&](const std::string& graph, const std::string& name, const std::string& seed) {
      const auto run = report_in(folder.write("g.yaml", graph) + " --for 500ms --seed " + seed);
      CHECK(run["outputs"].contains(name + "_told"));
      return run["outputs"][name + "_told"].dump();
    };
    const std::string of_m = reported(submarines({"m"}), "m", "1");
    CHECK(of_m.find("depth") != std::string::npos);
    CHECK(reported(submarines({"m"}), "m", "1") == of_m);
    // another distributer, before it or after it in any order, or another task
    CHECK(reported(submarines({"a", "m", "z"}), "m", "1") == of_m);
    CHECK(reported(submarines({"z", "m"}), "m", "1") == of_m);
    CHECK(reported(submarines({"m"}, "  c: {type: Counter, period: 10ms}\n"), "m", "1") == of_m);
    // another name, another seed
    CHECK(reported(submarines({"m", "n"}), "n", "1") != of_m);
    CHECK(reported(submarines({"m"}), "m", "2") != of_m);
    CHECK(reported(submarines({"m"}), "m", "0") != of_m);
  }
#endif
}
