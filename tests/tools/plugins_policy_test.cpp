// Scheduling policies from shared libraries.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "graph/plugins/plugins.h"
#include "tests/tools/plugin_library.h"
#include "tests/tools/run_command.h"
#include "tools/commands/edit/catalogue.h"
#include "tools/commands/run/known_with.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using command::TemporaryFolder;
using jarol::tests::library;

std::string refusal(const std::string& arguments) {
  const auto result = command::run_jarol(arguments, "2>&1 >/dev/null");
  CHECK(result.exit_code == 2);
  const std::size_t begin = result.output.find("error: ");
  return begin == std::string::npos ? result.output
                                    : result.output.substr(begin, result.output.find('\n', begin) - begin);
}

// In a table `fast` waits too long for `slow`.
std::string graph_with(const std::string& plugins) {
  return "graph: g\n" + plugins + R"(platform: {policy: rate_monotonic}
tasks:
  fast: {type: Counter, period: 10ms, let: 10ms, wcet: 2ms}
  slow: {type: Counter, period: 40ms, let: 40ms, wcet: 20ms}
)";
}

std::string with_plugin() {
  return graph_with("plugins: [" + std::filesystem::absolute(library("rate_monotonic")).string() + "]\n");
}

// The first line on what is wrong, without its place.
std::string names() { return list_of(names_of(built_in().graph.policies())); }
}  // namespace

TEST_SUITE("tools/plugins_policy") {
  TEST_CASE("a plugin brings a policy, and a graph with it is judged by it") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", with_plugin());
    const auto good = command::run_jarol("check " + graph, "2>/dev/null");
    CHECK(good.output.starts_with(
        graph + ": SCHEDULABLE on one core (rate_monotonic), safe: the hyperbolic bound holds (Bini, Buttazzo)\n"));
    CHECK(good.output.find("assumed: the task with the shortest period runs, interrupting others; 'run' does not "
                           "execute this, without overhead\n") != std::string::npos);
    CHECK(good.exit_code == 0);
    const auto json = [&](const std::string& more) {
      return nlohmann::json::parse(command::run_jarol("check --json " + graph + more, "2>/dev/null").output);
    };
    CHECK(json("")["policy"] == "rate_monotonic");
    CHECK(json("")["tasks"][0]["response_ns"].is_null());
    CHECK(json(" --set tasks.slow.wcet=30ms")["verdict"] == "unknown");
    CHECK(json(" --set tasks.slow.wcet=39ms")["evidence"] == "proof");
    CHECK(json(" --set tasks.slow.wcet=39ms")["verdict"] == "not_schedulable");
    CHECK(json(" --set platform.policy=table")["verdict"] == "not_schedulable");
  }

  TEST_CASE("it is suggested where it holds and another does not") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", with_plugin());
    // on a given core, where a second one does not help
    const auto report = command::run_jarol("check " + graph +
                                               " --set platform.policy=edf_nonpreemptive --set tasks.fast.core=0 --set "
                                               "tasks.slow.core=0",
                                           "2>/dev/null");
    CAPTURE(report.output);
    CHECK(report.output.find("'policy: rate_monotonic', which 'run' does not execute\n") != std::string::npos);
    CHECK(report.exit_code == 1);
  }

  TEST_CASE("what runs when follows from its urgency, on the virtual clock and not on the real one") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", with_plugin());
    const auto ran = command::run_jarol("run " + graph + " --for 1s --execution wcet", "2>/dev/null");
    CAPTURE(ran.output);
    CHECK(ran.output.find("  execution   wcet, by rate_monotonic on one core\n") != std::string::npos);
    CHECK(ran.output.find("late") == std::string::npos);
    CHECK(ran.exit_code == 0);
    CHECK(refusal("run " + graph + " --clock real --for 200ms") ==
          "error: '" + graph +
              "' has the policy 'rate_monotonic'; the real clock executes 'table' and 'fixed_priority'; choose one by "
              "--set platform.policy=table");
  }

  TEST_CASE("its name is known with the plugin alone") {
    const TemporaryFolder folder;
    const std::string with = folder.write("with.yaml", with_plugin()),
                      without = folder.write("without.yaml", graph_with("")),
                      lost = folder.write("lost.yaml", graph_with("plugins: [lost.so]\n"));
    CHECK(refusal("check " + without) ==
          "error: 'platform' key 'policy' can't be 'rate_monotonic'; it is one of " + names());
    CHECK(refusal("check " + with + " --set platform.policy=rate_monotone") ==
          "error: 'platform' key 'policy' can't be 'rate_monotone'; did you mean 'rate_monotonic'?; it is one of " +
              names() + ", rate_monotonic");
    // one that is not there may have had it
    CHECK(refusal("check " + lost) == "error: there is no file '" + (folder / "lost.so") + "'");
    CHECK(command::run_jarol("check " + lost).output.find("key 'policy'") == std::string::npos);
    const auto catalogue = tools::edit::catalogue_of(tools::known_with({library("rate_monotonic")}));
    for (const auto& key : catalogue["keys"]["platform"])
      if (key["name"] == "policy") CHECK(key["choices"].back() == "rate_monotonic");
  }

  TEST_CASE("a plugin with a policy that there is already is refused, and nothing of it is added") {
    PluginParts known{built_in().graph, {}};
    const IsThere none = [](const Extension&) { return false; };
    const auto report = [&](const std::string& name) {
      const std::string said = load_plugin(library(name), known, none), start = "'" + library(name) + "' ";
      return said.starts_with(start) ? said.substr(start.size()) : said;
    };
    CHECK(report("clash_of_policies") == "brings a policy 'edf', which there is already");
    CHECK(known.graph.policies() == built_in().graph.policies());
    CHECK(report("rate_monotonic") == "");
    CHECK(report("rate_monotonic_again") == "brings a policy 'rate_monotonic', which there is already");
    CHECK(known.graph.policies().size() == built_in().graph.policies().size() + 1);
    REQUIRE(known.graph.find_policy("rate_monotonic") != nullptr);
    const Policy& policy = *known.graph.find_policy("rate_monotonic");
    CHECK(policy.urgency == Urgency::priority);
    CHECK((policy.interrupts && policy.keeps_core && !policy.executed));
  }
}
