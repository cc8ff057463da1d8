// The command as people use it: what it prints, where, and how it exits.
// In one file: a list of what people type.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::json_of;

using command::Result;
using command::run_jarol;
using command::TemporaryFolder;

std::string digest_of(const std::string& arguments) { return json_of("run " + arguments + " --json")["digest"]; }

}  // namespace

TEST_SUITE("tools/command") {
  TEST_CASE("run reports schema, digest, counts and last outputs") {
    const auto run = json_of("run specs/counting.yaml --for 1s --json");
    CHECK(run["schema"] == "jarol.run/2");
    CHECK(run["graph"] == "counting");
    CHECK(run["simulated_ns"] == 1'000'000'000);
    CHECK(run["activations"] == 270);
    CHECK(run["instants"] == 150);
    CHECK(run["faults"] == nlohmann::json::array());
    CHECK(run["fault_count"] == 0);
    CHECK(run["outputs"].size() == 1);
    CHECK(run["outputs"]["total"].is_number());
    CHECK(run["wall_ns"].is_number());
    CHECK(run["real_time_factor"].is_number());
  }

  TEST_CASE("the digest is the same every time, with and without trace and plot, and however much time is told apart") {
    const TemporaryFolder folder;
    const std::string digest = digest_of("specs/counting.yaml --for 3s");
    for (int i = 0; i < 9; ++i) CHECK(digest_of("specs/counting.yaml --for 3s") == digest);
    CHECK(digest_of("specs/counting.yaml --for 3000ms --trace " + (folder / "t.csv")) == digest);
    CHECK(digest_of("specs/counting.yaml --for 3s --plot " + (folder / "p.svg")) == digest);
    CHECK(run_jarol("run specs/counting.yaml --for 3s").output.find(digest) != std::string::npos);
    CHECK(digest_of("specs/counting.yaml --for 3s --workers 4") == digest);
    CHECK(digest_of("specs/counting.yaml --for 3.1s") != digest);
  }

  TEST_CASE("another order of declaration gives the same digest") {
    const TemporaryFolder folder;
    const std::string one = folder.write("one.yaml", R"(graph: t
tasks:
  a: {type: Counter, period: 10ms}
  b: {type: Relay, period: 20ms, let: 5ms}
  c: {type: Sum, period: 10ms}
connections: [a.out -> b.in, a.out -> c.a, b.out -> c.b]
)");
    const std::string two = folder.write("two.yaml", R"(graph: t
connections: [b.out -> c.b, a.out -> c.a, a.out -> b.in]
tasks:
  c: {period: 10ms, type: Sum}
  b: {let: 5ms, type: Relay, period: 20ms}
  a: {type: Counter, period: 10ms}
)");
    CHECK(digest_of(one + " --for 2s") == digest_of(two + " --for 2s"));
  }

  TEST_CASE("of a graph with a weakly isolated task nothing is claimed, and that is said") {
    CHECK(run_jarol("run specs/counting.yaml --for 1s --set tasks.sum.isolation=weak")
              .output.find("nothing is claimed of the digest: task 'sum' is weakly isolated\n") != std::string::npos);
    CHECK(run_jarol("run specs/counting.yaml --for 1s").output.find("claimed") == std::string::npos);
    CHECK(json_of("run specs/counting.yaml --for 1s --json --set tasks.sum.isolation=weak")["digest_claimed"] == false);
    CHECK(json_of("run specs/counting.yaml --for 1s --json")["digest_claimed"] == true);
    CHECK(json_of("run specs/counting.yaml --for 10ms --json --clock real --concurrency threads 2>/dev/null")
              ["digest_claimed"] == false);
  }

#ifndef JAROL_SANITIZED  // they need memory of their own
  TEST_CASE("what a machine has no memory for is reported in words") {
    const Result run = run_jarol("schema > /dev/null; ulimit -v 1000000; " JAROL_COMMAND
                                 " run specs/window.yaml --for 1s --set tasks.window.heap=1GiB");
    CHECK(run.exit_code == 3);
    CHECK(run.output == "error: there is not enough memory for this\n");
  }
#endif

  TEST_CASE("a stack that is too small is reported in words") {
    const Result refused = run_jarol("run specs/exolauv.yaml", "2>&1", "ulimit -s 64; " JAROL_COMMAND);
    CHECK(refused.exit_code == 3);
    CHECK(refused.output == "error: the stack is limited to 64 KiB; it needs 256 KiB, as 'ulimit -s 256' gives it\n");
  }

  TEST_CASE("run reports how much of each private heap was in use at most, and a trace holds sequences whole") {
    const TemporaryFolder folder;
    const auto run = json_of("run specs/window.yaml --for 1s --json --trace " + (folder / "t.csv"));
    CHECK(run["heaps"] == nlohmann::json{{"window", {{"size", 1024}, {"max_used", 896}}},
                                         {"mean", {{"size", 65536}, {"max_used", 160}}}});
    CHECK(run_jarol("run specs/window.yaml --for 1s")
              .output.find("  heap        window: at most 896 of 1024 bytes in use\n") != std::string::npos);
    std::ifstream file(folder / "t.csv");
    const std::string trace{std::istreambuf_iterator<char>(file), {}};
    CHECK(trace.find("time,count.out,mean.out,window.out\n0,0,,\"[0]\"\n0.005,,0,\n0.01,1,,\"[0,1]\"\n") == 0);
  }

  TEST_CASE("a graph names plugins beside itself, and runs their tasks") {
    const TemporaryFolder folder;
    std::filesystem::copy_file(JAROL_PLUGIN_FOLDER "/twice.so", folder / "twice.so",
                               std::filesystem::copy_options::overwrite_existing);
    const std::string graph = folder.write("g.yaml", R"(graph: t
timing: {period: 10ms}
plugins: [twice.so]
communicators:
  o: {type: double, direction: out}
tasks:
  c: {type: Counter}
  t: {type: Twice}
  w: {type: Window, parameters: {length: 5}}
  r: {type: Reverse}
connections: [c.out -> t.in, t.out -> o, c.out -> w.in, w.out -> r.in]
)");
    const auto run = json_of("run " + graph + " --for 100ms --json");
    CHECK(run["faults"].size() == 1);
    CHECK(run["faults"][0]["cause"] == "threw: more than three");
    CHECK(run["outputs"]["o"] == 4);
    CHECK(run.at("non_finite_inputs") == 0);
    CHECK(run_jarol("tasks Twice --plugin " JAROL_PLUGIN_FOLDER "/twice.so").output ==
          "Twice: doubles its input\n\ninputs\n  in  double\n\noutputs\n  out  double  twice the input\n");
    CHECK(run_jarol("tasks --plugin nowhere.so").output == "error: there is no file 'nowhere.so'\n");
  }

  TEST_CASE("a known digest stays what it was") {
    // a change here breaks every recorded run of every user
    CHECK(digest_of("specs/counting.yaml --for 10s") == "0xef44f03bd732a5ab");
  }

  TEST_CASE("a fault stops the run, is reported with task, activation, instant and cause, and exits with 3") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
timing: {period: 10ms}
communicators:
  i: {type: double, direction: in, init: 1e308}
tasks:
  sum: {type: Accumulate}
connections: [i -> sum.in]
)");
    const Result result = run_jarol("run " + file + " --for 1s");
    CHECK(result.exit_code == 3);
    CHECK(result.output.find("fault: task 'sum' activation 1 at 0.01 s: output 'out' is inf\n") != std::string::npos);
    const auto run = nlohmann::json::parse(run_jarol("run " + file + " --for 1s --json").output);
    CHECK(run["faults"] ==
          nlohmann::json::parse(
              R"([{"task": "sum", "activation": 1, "instant_ns": 10000000, "cause": "output 'out' is inf"}])"));
    const Result held = run_jarol("run " + file + " --for 1s --set tasks.sum.on_fault=hold");
    CHECK(held.exit_code == 1);
    CHECK(held.output.find("fault: task 'sum' 99 times, from activation 1 at 0.01 s to activation 99 at 0.99 s: output "
                           "'out' is inf\nerror: task 'sum' gave nothing in 99 of 100 activations, 99.0 %, above the "
                           "fault limit of 10 %\n") != std::string::npos);
    CHECK(run_jarol("run " + file + " --for 1s --set tasks.sum.on_fault=hold --set fault_limit=99%").exit_code == 0);
    CHECK(run_jarol("run " + file + " --for 1s --set tasks.sum.on_fault=hold --set fault_limit=98.9%").exit_code == 1);
    const auto summary =
        nlohmann::json::parse(run_jarol("run " + file + " --for 1s --set tasks.sum.on_fault=hold --json", "2>/dev/null")
                                  .output)["fault_summary"];
    CHECK(summary == nlohmann::json::parse(R"([{"task": "sum", "cause": "output 'out' is inf", "count": 99,
      "first_instant_ns": 10000000, "last_instant_ns": 990000000}])"));
  }

  TEST_CASE("a single fault is no share of a short run, two are, and so is all that there was") {
    const TemporaryFolder folder;
    const std::string file = folder.write("g.yaml", R"(graph: g
timing: {period: 10ms}
communicators:
  i: {type: double, direction: in, init: 5e307}
tasks:
  sum: {type: Accumulate, on_fault: hold}
connections: [i -> sum.in]
)");
    // the third sum is the last that is finite
    const auto end_of = [&](const std::string& options) { return run_jarol("run " + file + " " + options).exit_code; };
    CHECK(end_of("--for 30ms") == 0);
    CHECK(end_of("--for 40ms") == 0);  // 1 of 4
    CHECK(end_of("--for 40ms --set fault_limit=0%") == 1);
    CHECK(end_of("--for 50ms") == 1);  // 2 of 5
    CHECK(end_of("--for 50ms --set fault_limit=40%") == 0);
    CHECK(end_of("--for 50ms --set fault_limit=39%") == 1);
    const std::string skip = "--set tasks.sum.on_fault=skip ";
    CHECK(end_of(skip + "--for 50ms") == 0);  // a fault and the release that it skips
    CHECK(end_of(skip + "--for 60ms") == 1);
    const std::string always =
        "--set tasks.sum.type=Sum --set 'connections=[i -> sum.a, i -> sum.b]' "
        "--set communicators.i.init=1e308 ";
    CHECK(end_of(always + "--for 10ms") == 1);  // 1 of 1
    CHECK(end_of(always + skip + "--for 20ms") == 1);
    // on threads, too, where a machine that is busy leaves rounds out
    const std::string on_threads = " --clock real --concurrency threads";
    CHECK(end_of("--for 40ms" + on_threads) == 0);
    CHECK(end_of(skip + "--for 2s --set fault_limit=1%" + on_threads) == 1);  // few rounds do
  }

  TEST_CASE("usage errors and unreadable files exit with 2 and a sentence") {
    const Result command = run_jarol("chek x");
    CHECK(command.exit_code == 2);
    CHECK(command.output ==
          "error: there is no command 'chek'; did you mean 'check'?; there are: bench, campaign, check, console, "
          "doctor, edit, graph, "
          "help, isolation, log, messages, new, replay, run, schema, tasks, vehicle\n");
    const Result missing = run_jarol("run no/such.yaml");
    CHECK(missing.exit_code == 2);
    CHECK(missing.output == "error: can't read 'no/such.yaml': No such file or directory\n1 error\n");
    CHECK(run_jarol("run specs/exoluav.yaml").output ==
          "error: can't read 'specs/exoluav.yaml': No such file or directory; did you mean 'exolauv.yaml'?\n1 error\n");
    const Result endless = run_jarol("run specs/counting.yaml");
    CHECK(endless.exit_code == 2);
    CHECK(endless.output ==
          "error: 'specs/counting.yaml' has no mission that ends; say how long to run, as in --for 10s\n");
    // where it ends is not asked of a run that can't begin
    const Result linked = run_jarol(
        "run specs/counting.yaml --set 'distributers={out: {type: LauvVehicle, link: {type: udp, peer: "
        "\"127.0.0.1:9\"}}}'");
    CHECK(linked.exit_code == 2);
    CHECK(linked.output == "error: distributer 'out' has a link to what goes on by itself; run it with --clock real\n");
    const Result duration = run_jarol("run specs/counting.yaml --for 10");
    CHECK(duration.exit_code == 2);
    CHECK(duration.output == "error: --for: '10' has no unit; write one of h, min, s, ms, us or ns, as in 10ms\n");
    CHECK(run_jarol("run specs/counting.yaml --for 1s --trace /no/such/x.csv").output ==
          "error: can't write '/no/such/x.csv': No such file or directory\n");
  }

  TEST_CASE("every command helps, by --help and after the word help") {
    for (const std::string command : {"", "bench", "campaign", "check", "console", "doctor", "graph", "isolation",
                                      "log", "messages", "new", "replay", "run", "schema", "tasks", "vehicle"}) {
      CAPTURE(command);
      const Result help = run_jarol(command + " --help");
      CHECK(help.exit_code == 0);
      CHECK(help.output.find("Usage") != std::string::npos);
      CHECK(run_jarol("help " + command).output == help.output);
      CHECK(run_jarol("help " + command).exit_code == 0);
    }
    CHECK(run_jarol("help chek").output ==
          "error: there is no command 'chek'; did you mean 'check'?; there are: bench, campaign, check, console, "
          "doctor, edit, graph, "
          "help, isolation, log, messages, new, replay, run, schema, tasks, vehicle\n");
  }

  TEST_CASE("a figure that is unknown says what there is, and one that runs the tree's own graphs where it does") {
    const std::string elsewhere = "cd / && " + std::filesystem::absolute(JAROL_COMMAND).string();
    const Result unknown = run_jarol("bench chain_1", "2>&1", elsewhere);
    CHECK(unknown.exit_code == 2);
    CHECK(unknown.output.starts_with(
        "error: there is no figure 'chain_1'; did you mean 'chain_10'?; there are: chain_10, chain_100, "));
#ifdef JAROL_VEHICLES
    const Result away = run_jarol("bench dive", "2>&1", elsewhere);
    CHECK(away.exit_code == 2);
    CHECK(
        away.output ==
        "error: 'dive' runs graphs of Jarol's source tree, which are not here: start 'jarol bench dive' at its root\n");
#endif
  }

  TEST_CASE("without a word it shows its help, and that nothing was done") {
    CHECK(run_jarol("").output == run_jarol("--help").output);
    CHECK(run_jarol("").exit_code == 2);
  }

  TEST_CASE("the version says of which commit, by which compiler and with which libraries") {
    const std::string version = run_jarol("-V").output;
    CHECK(version == run_jarol("--version").output);
    const std::regex form(
        "jarol \\d+\\.\\d+\\.\\d+(, commit [0-9a-f]{7,}\\+?)?\n"
        "(g\\+\\+|clang) .*, Eigen [\\d.]+, fmt [\\d.]+, CLI11 [\\d.]+, JSON [\\d.]+(, Simbody "
        "[\\d.]+)?,\nlibyaml 0[\\d.]+, oneTBB 2[\\d.]+, lz4 1[\\d.]+, zstd 1[\\d.]+, "
        "xxHash 0[\\d.]+, "
        "sodium 1[\\d.]+, Capstone \\d+\\.\\d+, elfutils \\d+, Boost 1[\\d.]+, SQLite 3[\\d.]+, Graphviz [\\d.]+\n");
    CHECK_MESSAGE(std::regex_match(version, form), version);
  }

  TEST_CASE("graph prints the order of tasks and a drawing") {
    CHECK(run_jarol("graph specs/counting.yaml").output.find("count (Counter): every 10ms, deadline 10ms\n") !=
          std::string::npos);
    // of one instant the shorter deadline goes first, whatever the names
    const TemporaryFolder folder;
    const std::string two = folder.write("two.yaml",
                                         "graph: two\ntasks:\n  a: {type: Counter, period: 12ms}\n"
                                         "  b: {type: Counter, period: 12ms, let: 9ms}\n");
    const std::string listed = run_jarol("graph " + two).output;
    CHECK(listed.find("  b (Counter)") < listed.find("  a (Counter)"));
    CHECK(nlohmann::json::parse(run_jarol("graph --json " + two).output)["tasks"][0]["name"] == "b");
    CHECK(run_jarol("graph specs/counting.yaml --dot").output.starts_with("digraph \"counting\" {\n"));
    CHECK(run_jarol("graph specs/counting.yaml --dot --json").exit_code == 2);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("a drawing shows the core within its boundary, and distributers outside") {
    const std::string dot = run_jarol("graph specs/exolauv.yaml --dot").output;
    const std::size_t boundary = dot.find("subgraph cluster_core {"), end = dot.find("\n  }\n");
    REQUIRE(boundary < end);
    CHECK(dot.find("\n    \"fins\" [style=\"rounded,filled\"") < end);
    CHECK(dot.find("\n    \"depth\" -> \"fins\" [label=\"moment > pitch\"];\n") < end);
    CHECK(dot.find("\n    \"navigation\" -> \"depth\" [label=\"motion\"];\n") < end);
    const std::string outside = dot.substr(end);
    CHECK(outside.find("\n  \"distributer dune\" [style=\"filled,dashed\", fillcolor=\"#eeeeee\", "
                       "label=\"dune\\nLauvVehicle\\nsimulation vehicles/submarine.yaml\"];\n") != std::string::npos);
    CHECK(outside.find("\n  \"distributer dune\" -> \"from_dune\" [label=\"instruments\", style=dashed];\n") !=
          std::string::npos);
    CHECK(outside.find("\n  \"to_dune\" -> \"distributer dune\" [label=\"actuation\", style=dashed];\n") !=
          std::string::npos);
  }
#endif

  TEST_CASE("graph --json gives the structure as one object") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
timing: {period: 10ms}
communicators:
  i: {type: double, direction: in}
  o: {type: double, direction: out, offset: 2ms}
tasks:
  b: {type: Relay, let: 5ms}
  a: {type: Relay, period: 5ms, offset: 1ms, wcet: 20us}
connections: [i -> a.in, a.out -> b.in, b.out -> o]
)");
    CHECK(json_of("graph --json " + file) == nlohmann::json::parse(R"({"schema": "jarol.graph/1", "graph": "t",
      "communicators": [
        {"name": "i", "direction": "in", "type": "double", "period_ns": 10000000, "offset_ns": 0},
        {"name": "o", "direction": "out", "type": "double", "period_ns": 10000000, "offset_ns": 2000000}],
      "tasks": [
        {"name": "a", "type": "Relay", "period_ns": 5000000, "offset_ns": 1000000, "deadline_ns": 4000000, "wcet_ns": 20000},
        {"name": "b", "type": "Relay", "period_ns": 10000000, "offset_ns": 0, "let_ns": 5000000, "deadline_ns": 5000000}],
      "connections": [
        {"from": "i", "to": "a.in", "type": "double"},
        {"from": "a.out", "to": "b.in", "type": "double"},
        {"from": "b.out", "to": "o", "type": "double"}]})"));
  }

  TEST_CASE("graph --json reports channels, and what is handed over while nothing comes") {
    const auto communicators = json_of("graph --json specs/exolauv_bare.yaml --profile dune")["communicators"];
    CHECK(communicators[0]["channel"] == "dune.motion");
    CHECK(communicators[0]["timeout_ns"] == 1'000'000'000);
    CHECK(communicators[2]["safe"] == nlohmann::json{{"thruster", 0}, {"fins", {0, 0, 0, 0}}});
  }
}
