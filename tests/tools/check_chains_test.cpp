// jarol check of chains and of what leaves a graph.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::json_of;

using command::Result;
using command::run_jarol;
using command::TemporaryFolder;

}  // namespace

TEST_SUITE("tools/check_chains") {
  TEST_CASE("an `out` that reads at the very instant at which its producer runs gets a note") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
timing: {period: 10ms}
communicators:
  late: {type: double, direction: out}
  soon: {type: double, direction: out, offset: 1ms}
tasks: {a: {type: Counter, wcet: 1us}}
connections: [a.out -> late, a.out -> soon]
)");
    const std::string output = run_jarol("check " + file).output;
    CHECK(output.find("  note: 'late' reads at the very instant at which 'a' runs, and so one period late; give it an "
                      "'offset'\n") != std::string::npos);
    CHECK(output.find("'soon' reads") == std::string::npos);
  }

  TEST_CASE("a chain that breaks its limit is a negative verdict") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
timing: {period: 10ms}
communicators:
  out: {type: double, direction: out, offset: 2ms}
tasks:
  a: {type: Counter, wcet: 1ms}
connections: [a.out -> out]
chains:
  c: {path: [a, out], reaction: 12ms, crossover: 2Hz}
)");
    const Result good = run_jarol("check " + file);
    CHECK(good.exit_code == 0);
    CHECK(good.output.find("  chain c: reaction 2ms to 12ms, data age at most 12ms, jitter 0ns\n"
                           "    slowest way from 30ms: a 0ns, out 2ms\n"
                           "    at 12.57 rad/s: delay 2ms, jitter 0ns, held for 10ms: 5.0 deg of phase lost\n") !=
          std::string::npos);
    const Result bad = run_jarol("check " + file + " --set chains.c.reaction=11ms");
    CHECK(bad.exit_code == 1);
    CHECK(bad.output.starts_with(file +
                                 ": SCHEDULABLE on one core (table), proof, BUT A LIMIT IS BROKEN by chain 'c': "));
    CHECK(bad.output.find("    LIMIT BROKEN: reaction 12ms over 11ms\n") != std::string::npos);
    const auto json = json_of("check --json " + file + " --set chains.c.reaction=11ms");
    CHECK(json["verdict"] == "schedulable");
    CHECK(json["limits_hold"] == false);
    CHECK(json["chains"][0]["reaction_limit_ns"] == 11'000'000);
    CHECK(json["chains"][0]["age_limit_ns"] == nullptr);
    CHECK(json["chains"][0]["holds"] == false);
    CHECK(json_of("check --json " + file)["limits_hold"] == true);
    CHECK(good.output.find("BROKEN") == std::string::npos);
  }
}
