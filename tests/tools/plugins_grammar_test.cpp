// Timing grammars from shared libraries.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "graph/plugins/plugins.h"
#include "tests/tools/plugin_library.h"
#include "tests/tools/run_command.h"
#include "tools/commands/edit/catalogue.h"
#include "tools/commands/edit/verdict.h"
#include "tools/commands/run/known_with.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using command::TemporaryFolder;
using jarol::tests::library;

std::string plugin_line(const std::string& name) {
  return "plugins: [" + std::filesystem::absolute(library(name)).string() + "]\n";
}

std::string in_rates(const std::string& plugins) {
  return "graph: g\n" + plugins + R"(timing: {grammar: rates, period: 40ms}
tasks:
  fast: {type: Counter, runs: 4, wcet: 2ms}
  slow: {type: Counter, runs: 1, wcet: 5ms}
  own: {type: Counter, period: 20ms, let: 10ms}
)";
}

const std::string in_let = R"(graph: g
timing: {grammar: let, period: 40ms}
tasks:
  fast: {type: Counter, period: 10ms, let: 10ms, wcet: 2ms}
  slow: {type: Counter, period: 40ms, let: 40ms, wcet: 5ms}
  own: {type: Counter, period: 20ms, let: 10ms}
)";

// Without the folder of the file.
std::string refusal(const std::string& arguments, const TemporaryFolder& folder) {
  const auto result = command::run_jarol(arguments, "2>&1 >/dev/null");
  CHECK(result.exit_code == 2);
  std::string said = result.output;
  const std::string path = folder / "";
  for (std::size_t at; (at = said.find(path)) != std::string::npos;) said.erase(at, path.size());
  return said;
}

std::string said_of_plugin(const std::string& name) {
  return "note: loads plugin '" + std::filesystem::absolute(library(name)).string() + "'\n";
}
}  // namespace

TEST_SUITE("tools/plugins_grammar") {
  TEST_CASE("a graph in the words of a plugin's grammar is the one that it stands for") {
    const TemporaryFolder folder;
    const std::string rates = folder.write("rates.yaml", in_rates(plugin_line("rates"))),
                      let = folder.write("let.yaml", in_let);
    const auto same = [&](const std::string& command, const std::string& more) {
      const auto one = command::run_jarol(command + " " + rates + more, "2>/dev/null"),
                 other = command::run_jarol(command + " " + let + more, "2>/dev/null");
      CHECK(one.exit_code == 0);
      CHECK(one.output.size() > 10);
      std::string said = other.output;
      for (std::size_t at; (at = said.find("let.yaml")) != std::string::npos;) said.replace(at, 8, "rates.yaml");
      CHECK(one.output == said);
    };
    same("check", " --set tasks.own.wcet=1ms");
    same("graph", " --dot");
    same("run", " --for 1s --trace -");
  }

  TEST_CASE("single changes and campaigns speak its words, too") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", in_rates(plugin_line("rates")) +
                                                         "campaign: {vary: {tasks.fast.runs: [1, 2, 8]}, for: "
                                                         "1s, metrics: {last: max(fast.out)}}\n");
    const auto run = command::run_jarol("run " + graph + " --for 1s --set tasks.fast.runs=2 --trace -", "2>/dev/null");
    CHECK(run.exit_code == 0);
    CHECK(run.output.find("\n0.02,") != std::string::npos);
    CHECK(run.output.find("\n0.005,") == std::string::npos);
    const auto campaign = command::run_jarol("campaign " + graph + " --results " + (folder / "r.sqlite"), "2>&1");
    CAPTURE(campaign.output);
    CHECK(campaign.exit_code == 0);
  }

  TEST_CASE("errors point at its words, and at what they stand for") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", in_rates(plugin_line("rates")));
    const auto wrong = [&](const std::string& set) {
      const std::string said = refusal("check " + graph + " --set " + set, folder), note = said_of_plugin("rates");
      CHECK(said.starts_with(note));
      return said.substr(std::min(said.size(), note.size()));
    };
    CHECK(wrong("tasks.fast.runs=3") ==
          "--set:1:17: error: task 'fast' key 'runs' is no whole share of the graph's period of 40ms\n"
          "  tasks.fast.runs=3\n                  ^\ng.yaml: 1 error\n");
    CHECK(wrong("timing.period=null") ==
          "g.yaml:3:9: error: the grammar 'rates' needs the graph's period, as in "
          "'period: 100ms'\n"
          "  timing: {grammar: rates, period: 40ms}\n          ^\ng.yaml: 1 error\n");
    CHECK(wrong("tasks.fast.deadline=20ms") ==
          "--set:1:21: error: task 'fast' has deadline 20ms later than 10ms, which follows from its LET; lower it or "
          "leave it out\n  tasks.fast.deadline=20ms\n                      ^\ng.yaml: 1 error\n");
    CHECK(wrong("timing.grammar=rate") ==
          "--set:1:16: error: 'timing' key 'grammar' can't be 'rate'; did you mean 'rates'?; it is one of let, "
          "rates\n  timing.grammar=rate\n                 ^\ng.yaml: 1 error\n");
    const std::string keys =
        "it has: type, period, offset, let, deadline, wcet, jitter, blocking, priority, core, heap, on_fault, "
        "fault_limit, isolation, parameters, init\n";
    CHECK(wrong("timing.grammar=let") ==
          "g.yaml:5:25: error: task 'fast' has no key 'runs'; " + keys +
              "    fast: {type: Counter, runs: 4, wcet: 2ms}\n                          ^\n"
              "g.yaml:6:25: error: task 'slow' has no key 'runs'; " +
              keys +
              "    slow: {type: Counter, runs: 1, wcet: 5ms}\n                          ^\n"
              "g.yaml: 2 errors\n");
  }

  TEST_CASE("without the plugin its name is not known, and nothing else is said of the graph") {
    const TemporaryFolder folder;
    const std::string without = folder.write("without.yaml", in_rates("")),
                      none = folder.write("none.yaml", in_rates("plugins: [none.so]\n"));
    CHECK(refusal("check " + without, folder) ==
          "without.yaml:2:19: error: 'timing' key 'grammar' can't be 'rates'; it is one of let\n"
          "  timing: {grammar: rates, period: 40ms}\n                    ^\nwithout.yaml: 1 error\n");
    CHECK(refusal("check " + none, folder) ==
          "none.yaml:2:11: error: there is no file 'none.so'\n"
          "  plugins: [none.so]\n            ^\nnone.yaml: 1 error\n");
  }

  TEST_CASE("a grammar that throws is named where the graph states it") {
    const TemporaryFolder folder;
    const std::string graph =
        folder.write("g.yaml", "graph: g\n" + plugin_line("lost_grammar") +
                                   "timing: {grammar: lost, period: 40ms}\ntasks:\n  a: {type: Counter}\n");
    CHECK(refusal("check " + graph, folder) ==
          said_of_plugin("lost_grammar") +
              "g.yaml:3:19: error: timing grammar 'lost' can't read this graph: it has no tasks that it knows\n"
              "  timing: {grammar: lost, period: 40ms}\n                    ^\ng.yaml: 1 error\n");
  }

  TEST_CASE("a plugin with a grammar that there is already is refused") {
    PluginParts known{built_in().graph, {}};
    const IsThere nothing = [](const Extension&) { return false; };
    CHECK(load_plugin(library("clash_of_grammars"), known, nothing) ==
          "'" + library("clash_of_grammars") + "' brings a grammar 'let', which there is already");
    CHECK(known.graph.grammars().size() == 1);
    CHECK(load_plugin(library("rates"), known, nothing) == "");
    CHECK(known.graph.grammars().size() == 2);
  }

  TEST_CASE("jarol tasks shows what it adds") {
    CHECK(command::run_jarol("tasks rates --plugin " + library("rates")).output ==
          "grammar rates: tasks state how often they run in the graph's period\n\n"
          "  runs of 'tasks': so often in the graph's period, as in 4; the period follows, and the LET is all of it\n");
    CHECK(command::run_jarol("tasks let").output ==
          "grammar let: periods, offsets and logical execution times are stated\n\n"
          "  the keys of specs/graphs.md, and no others\n");
    const auto json =
        nlohmann::json::parse(command::run_jarol("tasks rates --json --plugin " + library("rates")).output);
    CHECK(json["grammars"][0]["keys"][0]["name"] == "runs");
    CHECK(json["grammars"][0]["keys"][0]["section"] == "tasks");
  }

  TEST_CASE("the schema of a plugin has its keys, and without it they are unknown") {
    const auto tasks_of = [](const std::string& arguments) {
      const auto schema = nlohmann::json::parse(command::run_jarol("schema" + arguments).output);
      return schema["properties"]["tasks"]["patternProperties"]["^[A-Za-z_][A-Za-z0-9_]*$"]["properties"];
    };
    CHECK(tasks_of("")["period"].contains("pattern"));
    CHECK(!tasks_of("").contains("runs"));
    CHECK(tasks_of(" --plugin " + library("rates"))["runs"]["description"] ==
          "so often in the graph's period, as in 4; the period follows, and the LET is all of it");
    CHECK(tasks_of(" --plugin " + library("twice"))["type"]["anyOf"].dump().find("Twice") != std::string::npos);
  }

  TEST_CASE("the editor draws and judges a graph in its words, and offers it") {
    const auto source = std::make_shared<Source>(Source{"g.yaml", in_rates(plugin_line("rates"))});
    const auto drawing = tools::edit::draw({source, {}});
    CHECK(drawing.contains("drawing"));
    CHECK(tools::edit::judge({source, {}})["problems"].empty());
    const auto catalogue = tools::edit::catalogue_of(tools::known_with({library("rates")}));
    for (const auto& key : catalogue["keys"]["timing"])
      if (key["name"] == "grammar") CHECK(key["choices"].dump() == R"(["let","rates"])");
  }

  TEST_CASE("what would help is suggested, too") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", in_rates(plugin_line("rates")));
    const auto report =
        command::run_jarol("check " + graph + " --set tasks.slow.wcet=28ms --set tasks.own.wcet=1ms", "2>/dev/null");
    CAPTURE(report.output);
    CHECK(report.exit_code == 1);
    CHECK(report.output.find("  it would hold with ") != std::string::npos);
  }

  TEST_CASE("measured WCETs are written beside its words") {
    const TemporaryFolder folder;
    const std::string text = in_rates(plugin_line("rates")), graph = folder.write("g.yaml", text);
    const auto measured = command::run_jarol("check " + graph + " --measure --write", "2>&1");
    CAPTURE(measured.output);
    CHECK(measured.exit_code == 0);
    const std::string written = read_source(graph)->text;
    CHECK(written.find("  fast: {type: Counter, runs: 4, wcet: 2ms}\n") != std::string::npos);
    const std::size_t own = written.find("\n  own: {");
    REQUIRE(own != std::string::npos);
    const std::string line = written.substr(own + 1, written.find('\n', own + 1) - own);
    CAPTURE(line);
    CHECK(line.find("wcet: ") != std::string::npos);
    CHECK(line.find("period: 20ms, let: 10ms") != std::string::npos);
  }
}
