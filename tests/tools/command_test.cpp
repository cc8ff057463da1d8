// The command as people use it: what it prints, where, and how it exits.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/run_command.h"

namespace {

using command::jarol;
using command::Result;
using command::TemporaryFolder;

nlohmann::json json_of(const std::string& arguments) { return nlohmann::json::parse(jarol(arguments).output); }

std::string digest_of(const std::string& arguments) { return json_of("run " + arguments + " --json")["digest"]; }

}  // namespace

TEST_SUITE("tools/command") {
  TEST_CASE("run tells schema, digest, counts and last outputs") {
    const auto run = json_of("run specs/counting.yaml --for 1s --json");
    CHECK(run["schema"] == "jarol.run/1");
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
    CHECK(jarol("run specs/counting.yaml --for 3s").output.find(digest) != std::string::npos);
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
    CHECK(jarol("run specs/counting.yaml --for 1s --set tasks.sum.isolation=weak")
              .output.find("nothing is claimed of the digest: task 'sum' is weakly isolated\n") != std::string::npos);
    CHECK(jarol("run specs/counting.yaml --for 1s").output.find("claimed") == std::string::npos);
    CHECK(json_of("run specs/counting.yaml --for 1s --json --set tasks.sum.isolation=weak")["digest_claimed"] == false);
    CHECK(json_of("run specs/counting.yaml --for 1s --json")["digest_claimed"] == true);
    CHECK(json_of("run specs/counting.yaml --for 10ms --json --clock real --concurrency threads 2>/dev/null")
              ["digest_claimed"] == false);
  }

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need memory of their own
  TEST_CASE("what a machine has no memory for is told in words") {
    const Result run = jarol("schema > /dev/null; ulimit -v 1000000; " JAROL_COMMAND
                             " run specs/window.yaml --for 1s --set tasks.window.heap=1GiB");
    CHECK(run.exit_code == 3);
    CHECK(run.output == "error: there is not enough memory for this\n");
  }
#endif

  TEST_CASE("run tells how much of each private heap was in use at most, and a trace holds sequences whole") {
    const TemporaryFolder folder;
    const auto run = json_of("run specs/window.yaml --for 1s --json --trace " + (folder / "t.csv"));
    CHECK(run["heaps"] == nlohmann::json{{"window", {{"size", 1024}, {"most_used", 896}}},
                                         {"mean", {{"size", 65536}, {"most_used", 160}}}});
    CHECK(jarol("run specs/window.yaml --for 1s")
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
    CHECK(jarol("tasks Twice --plugin " JAROL_PLUGIN_FOLDER "/twice.so").output ==
          "Twice: doubles its input\n\ninputs\n  in  double\n\noutputs\n  out  double  twice the input\n");
    CHECK(jarol("tasks --plugin nowhere.so").output == "error: there is no file 'nowhere.so'\n");
  }

  TEST_CASE("a known digest stays what it was") {
    // a change here breaks every recorded run of every user
    CHECK(digest_of("specs/counting.yaml --for 10s") == "0xef44f03bd732a5ab");
  }

  TEST_CASE("check says what is schedulable and exits by the verdict") {
    CHECK(jarol("check specs/counting.yaml").exit_code == 0);
    const Result no = jarol("check specs/counting.yaml --set tasks.slow.wcet=19ms");
    CHECK(no.exit_code == 1);
    CHECK(no.output.starts_with(
        "specs/counting.yaml: NOT SCHEDULABLE core 0: task 'slow' activation 0 (released 0.000 ms) "
        "finishes 19.050 ms, deadline 15.000 ms (late 4.050 ms)\n"));
  }

  TEST_CASE("check --json gives one object per file and line") {
    const Result result = jarol("check --json specs/counting.yaml");
    const auto check = nlohmann::json::parse(result.output);
    CHECK(check["schema"] == "jarol.check/1");
    CHECK(check["file"] == "specs/counting.yaml");
    CHECK(check["verdict"] == "schedulable");
    CHECK(check["tasks"][0] == nlohmann::json{{"name", "add"},
                                              {"period_ns", 20'000'000},
                                              {"offset_ns", 10'000'000},
                                              {"deadline_ns", 10'000'000},
                                              {"wcet_ns", 50'000},
                                              {"core", 0},
                                              {"response_ns", 100'000},
                                              {"slack_ns", 9'900'000},
                                              {"max_wcet_ns", 9'850'000},
                                              {"min_deadline_ns", 100'000}});
    CHECK(check["standing"] == "proof");
    CHECK(check["witness"] == nullptr);
    CHECK(check["alpha"] == doctest::Approx(6.153845));
    CHECK(check["chains"] == nlohmann::json::array());
    CHECK(check["utilisation"] == doctest::Approx(0.1325));
  }

  TEST_CASE("check --json tells the platform and what is assumed of it") {
    const auto check = json_of("check --json specs/counting.yaml");
    CHECK(check["cores"] == 1);
    CHECK(check["policy"] == "table");
    CHECK(check["assumptions"] ==
          nlohmann::json{{"text", "tasks run one after the other as released, never interrupted, without overhead"},
                         {"phasing", "given"},
                         {"dispatch_ns", 0},
                         {"copy_ns_per_byte", 0}});
    const auto other = json_of(
        "check --json specs/counting.yaml --set 'platform={cores: 2, policy: edf, phasing: any, dispatch: 1us, copy: "
        "2ns}'");
    CHECK(other["cores"] == 2);
    CHECK(other["policy"] == "edf");
    CHECK(other["assumptions"] ==
          nlohmann::json{{"text",
                          "the task with the earliest deadline runs, interrupting others; 'run' does not execute this, "
                          "with 1us for each activation and 2ns for each byte handed on; whatever the offsets"},
                         {"phasing", "any"},
                         {"dispatch_ns", 1000},
                         {"copy_ns_per_byte", 2}});
  }

  TEST_CASE("where tasks belong to no core, their utilisation is told of all cores together") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: global_edf, cores: 2, phasing: any}
tasks:
  a: {type: Work, period: 10ms, wcet: 10ms}
  b: {type: Work, period: 10ms, wcet: 5ms}
  c: {type: Work, period: 10ms, wcet: 5ms}
)");
    const Result bound = jarol("check " + file);
    CHECK(bound.exit_code == 3);
    CHECK(bound.output ==
          file +
              R"(: UNKNOWN on 2 cores (global_edf): the tests of global_edf are sufficient only, and none of them holds
  task     period     offset   deadline       wcet     use   response      slack  core
  a          10ms        0ns       10ms       10ms  100.00%          -          -     -
  b          10ms        0ns       10ms        5ms  50.00%       10ms        0ns     -
  c          10ms        0ns       10ms        5ms  50.00%       10ms        0ns     -
  all 2 cores: utilisation 200.00% of 200%
  utilisation 200.00%; a task's response is its longest time from release to end when each takes its wcet;
  assumed: the earliest deadlines run, on any core; 'run' does not execute this, without overhead; whatever the offsets
  all WCETs together may be 0.666666 times as long; alone, 'a' has least room: up to 5ms
  it would hold with a 'wcet' of 5ms for 'a', which has 10ms
                  or 'policy: fixed_priority'
                  or 'policy: edf'
                  or 'cores: 3'
)");
    // with offsets that hold it is decided
    const Result given = jarol("check " + file + " --set platform.phasing=given");
    CHECK(given.exit_code == 0);
    CHECK(given.output.starts_with(
        file +
        ": SCHEDULABLE on 2 cores (global_edf): every activation of the whole repetition ends by its deadline, where "
        "those of equal deadlines go in order of name\n"));
    const Result late = jarol("check " + file + " --set tasks.a.period=11ms");
    CHECK(late.exit_code == 1);
    CHECK(late.output.starts_with(file +
                                  ": NOT SCHEDULABLE task 'a' activation 0 (released 0.000 ms) finishes 15.000 ms, "
                                  "deadline 11.000 ms (late 4.000 ms)\n"));
    CHECK(jarol("check " + file + " --set platform.policy=edf").output.find("all 2 cores") == std::string::npos);
    // on one core it is edf, which is decided
    const std::string one = file + " --set platform.cores=1 --set tasks.a.wcet=1ms --set tasks.b.wcet=4ms";
    CHECK(jarol("check " + one).exit_code == 0);
    CHECK(jarol("check " + one + " --set tasks.c.wcet=5000001ns").exit_code == 1);
    CHECK(json_of("check --json " + one)["policy"] == "global_edf");
  }

  TEST_CASE("check tells why not: the demand, the chart, and what would help") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority}
tasks:
  fast: {type: Work, period: 5ms, wcet: 2ms}
  slow: {type: Work, period: 7ms, wcet: 4ms}
)");
    const Result no = jarol("check " + file);
    CHECK(no.exit_code == 1);
    CHECK(
        no.output ==
        file +
            R"(: NOT SCHEDULABLE core 0: task 'slow' activation 0 (released 0.000 ms) finishes 8.000 ms, deadline 7.000 ms (late 1.000 ms)
  a task's worst response is longer than its deadline on one core (fixed_priority)
  from release to end 8ms: fast 4ms + slow 4ms
    fast ##################...........................##################.........
    slow ^.................###########################..................|!!!!!!!!
         0ns                                                                  8ms
  task     period     offset   deadline       wcet     use   response      slack
  fast        5ms        0ns        5ms        2ms  40.00%        2ms        3ms
  slow        7ms        0ns        7ms        4ms  57.14%        8ms       -1ms
  utilisation 97.14%; a task's response is its longest time from release to end when each takes its wcet;
  assumed: the most urgent task runs, interrupting others, as under 'run --clock real', without overhead
  all WCETs together may be 0.875 times as long; alone, 'fast' has least room: up to 1.5ms
  it would hold with a 'wcet' of 1.5ms for 'fast', which has 2ms
                  or a 'wcet' of 3ms for 'slow', which has 4ms
                  or 'policy: table'
                  or 'policy: edf'
)");
    CHECK(jarol("check " + file + " --set platform.policy=edf").exit_code == 0);
    const auto late = json_of("check --json --set platform.policy=edf --set tasks.slow.deadline=5ms " + file);
    CHECK(late["witness"] ==
          nlohmann::json{{"core", 0},
                         {"task", "slow"},
                         {"activation", 0},
                         {"release_ns", 0},
                         {"finish_ns", 6'000'000},
                         {"deadline_ns", 5'000'000},
                         {"demand", {{"length_ns", 5'000'000}, {"demand_ns", 6'000'000}, {"blocking_ns", 0}}}});
  }

  TEST_CASE("late by little is told in what fits, and no digit that matters is left out") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", "{graph: t, tasks: {a: {type: Work, period: 50ms, let: 40ms}}}\n");
    const auto headline = [&](const std::string& wcet) {
      const std::string output = jarol("check " + file + " --set tasks.a.wcet=" + wcet).output;
      return output.substr(0, output.find('\n'));
    };
    const std::string late = file + ": NOT SCHEDULABLE core 0: task 'a' activation 0 (released 0.000 ms) finishes ";
    CHECK(headline("40000001ns") == late + "40.000001 ms, deadline 40.000 ms (late 1 ns)");
    CHECK(headline("40000999ns") == late + "40.000999 ms, deadline 40.000 ms (late 999 ns)");
    CHECK(headline("40001us") == late + "40.001 ms, deadline 40.000 ms (late 0.001 ms)");
    CHECK(headline("40012345ns") == late + "40.012345 ms, deadline 40.000 ms (late 12.345 us)");
    CHECK(headline("41000001ns") == late + "41.000001 ms, deadline 40.000 ms (late 1.000001 ms)");
    CHECK(headline("60350us") == late + "60.350 ms, deadline 40.000 ms (late 20.350 ms)");
  }

  TEST_CASE("where only jitter makes a task late, the worst response is told") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority}
tasks:
  a: {type: Work, period: 5ms, wcet: 2ms, jitter: 3ms}
  b: {type: Work, period: 10ms, wcet: 3ms, deadline: 6ms}
)");
    const Result late = jarol("check " + file);
    CHECK(late.exit_code == 1);
    CHECK(late.output.starts_with(
        file +
        ": NOT SCHEDULABLE core 0: task 'b' responds within 7.000 ms at worst, deadline 6.000 ms (late 1.000 ms)\n"));
  }

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
    const std::string output = jarol("check " + file).output;
    CHECK(output.find("  note: 'late' reads at the very instant at which 'a' runs, and so one period late; give it an "
                      "'offset'\n") != std::string::npos);
    CHECK(output.find("'soon' reads") == std::string::npos);
  }

  TEST_CASE("overheads of the platform count in the verdict, and margins leave them out") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: edf}
timing: {period: 10ms}
tasks:
  a: {type: Counter, wcet: 4ms}
  b: {type: Relay, wcet: 4ms}
connections: [a.out -> b.in]
)");
    CHECK(json_of("check --json " + file)["alpha"] == doctest::Approx(1.25));
    const auto with = json_of("check --json --set platform.dispatch=1ms --set platform.copy=1us " + file);
    CHECK(with["verdict"] == "not_schedulable");  // 8 bytes: 8 us over
    CHECK(with["tasks"][0]["max_wcet_ns"] == 3'992'000);
    CHECK(with["alpha"] == doctest::Approx(7.992 / 8));
  }

  TEST_CASE("check draws the chart of a late activation") {
    const TemporaryFolder folder;
    CHECK(jarol("check specs/counting.yaml --set tasks.slow.wcet=20ms --svg " + (folder / "g.svg")).exit_code == 1);
    std::ifstream file(folder / "g.svg");
    const std::string svg{std::istreambuf_iterator<char>(file), {}};
    CHECK(svg.starts_with("<svg xmlns"));
    CHECK(svg.find("counting: activation 0 of slow is 5.05ms late</text>") != std::string::npos);
    CHECK(svg.ends_with("</svg>\n"));
  }

  TEST_CASE("check writes random graphs that it can check, the same for the same seed") {
    const TemporaryFolder folder;
    CHECK(jarol("check --generate waters --count 2 --seed 7 -o " + (folder / "g")).output ==
          "2 graphs in " + (folder / "g") + "\n");
    CHECK(jarol("check --generate waters --seed 7 -o " + (folder / "h")).exit_code == 0);
    const auto text_of = [](const std::string& path) {
      std::ifstream file(path);
      return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    CHECK(text_of(folder / "g/waters_7.yaml") == text_of(folder / "h/waters_7.yaml"));
    CHECK(text_of(folder / "g/waters_7.yaml") != text_of(folder / "g/waters_8.yaml"));
    for (const std::string kind : {"waters", "uunifast"}) {
      jarol("check --generate " + kind + " --tasks 12 --utilisation 0.5 -o " + (folder / "k"));
      const auto check = json_of("check --json " + (folder / "k") + "/" + kind + "_0.yaml");
      CHECK(check["tasks"].size() == 12);
      CHECK(check["utilisation"] == doctest::Approx(0.5).epsilon(0.001));
    }
    CHECK(jarol("check --generate waters").output == "error: --generate needs -o DIR, a folder for the graphs\n");
    CHECK(jarol("check").output == "error: check needs a FILE, a graph\n");
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
    const Result good = jarol("check " + file);
    CHECK(good.exit_code == 0);
    CHECK(good.output.find("  chain c: reaction 2ms to 12ms, data age at most 12ms, jitter 0ns\n"
                           "    slowest way from 30ms: a 0ns, out 2ms\n"
                           "    at 12.57 rad/s: delay 2ms, jitter 0ns, held for 10ms: 5.0 deg of phase lost\n") !=
          std::string::npos);
    const Result bad = jarol("check " + file + " --set chains.c.reaction=11ms");
    CHECK(bad.exit_code == 1);
    CHECK(bad.output.starts_with(file + ": SCHEDULABLE on one core (table), BUT A LIMIT IS BROKEN by chain 'c': "));
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

  TEST_CASE("without a wcet the verdict is open") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", "{graph: t, tasks: {a: {type: Counter, period: 1ms}}}\n");
    const Result result = jarol("check " + file);
    CHECK(result.exit_code == 3);
    CHECK(result.output.starts_with(file + ": UNKNOWN on one core (table): no 'wcet' is stated for 'a'\n"));
  }

  TEST_CASE("a bad file does not hide the others, and all its errors are told") {
    const TemporaryFolder folder;
    const std::string bad =
        folder.write("bad.yaml", "{graph: t, tasks: {a: {type: Countr, period: 1ms}}, conections: []}\n");
    const Result result = jarol("check --json " + bad + " specs/counting.yaml", "2>/dev/null");
    CHECK(result.exit_code == 2);
    CHECK(nlohmann::json::parse(result.output)["file"] == "specs/counting.yaml");
    CHECK(jarol("check " + bad).output.ends_with(bad + ": 2 errors\n"));
  }

  TEST_CASE("a fault stops the run, is told with task, activation, instant and cause, and exits with 3") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
timing: {period: 10ms}
communicators:
  i: {type: double, direction: in, init: 1e308}
tasks:
  sum: {type: Accumulate}
connections: [i -> sum.in]
)");
    const Result result = jarol("run " + file + " --for 1s");
    CHECK(result.exit_code == 3);
    CHECK(result.output.find("fault: task 'sum' activation 1 at 0.01 s: output 'out' is inf\n") != std::string::npos);
    const auto run = nlohmann::json::parse(jarol("run " + file + " --for 1s --json").output);
    CHECK(run["faults"] ==
          nlohmann::json::parse(
              R"([{"task": "sum", "activation": 1, "instant_ns": 10000000, "cause": "output 'out' is inf"}])"));
    CHECK(jarol("run " + file + " --for 1s --set tasks.sum.on_fault=hold").exit_code == 0);
  }

  TEST_CASE("usage errors and unreadable files exit with 2 and a sentence") {
    CHECK(jarol("").exit_code == 2);
    const Result command = jarol("chek x");
    CHECK(command.exit_code == 2);
    CHECK(command.output ==
          "error: there is no command 'chek'; did you mean 'check'?; there are: bench, check, doctor, graph, messages, "
          "replay, run, schema, tasks, vehicle\n");
    const Result missing = jarol("run no/such.yaml");
    CHECK(missing.exit_code == 2);
    CHECK(missing.output == "error: can't read 'no/such.yaml': No such file or directory\n1 error\n");
    const Result endless = jarol("run specs/counting.yaml");
    CHECK(endless.exit_code == 2);
    CHECK(endless.output ==
          "error: 'specs/counting.yaml' has no mission that ends; say how long to run, as in --for 10s\n");
    const Result duration = jarol("run specs/counting.yaml --for 10");
    CHECK(duration.exit_code == 2);
    CHECK(duration.output == "error: --for: '10' has no unit; write one of h, min, s, ms, us or ns, as in 10ms\n");
    CHECK(jarol("run specs/counting.yaml --for 1s --trace /no/such/x.csv").output ==
          "error: can't write '/no/such/x.csv': No such file or directory\n");
  }

  TEST_CASE("every command helps") {
    for (const std::string command : {"", "bench", "check", "graph", "run", "schema", "tasks"}) {
      const Result help = jarol(command + " --help");
      CHECK(help.exit_code == 0);
      CHECK(help.output.find("Usage") != std::string::npos);
    }
  }

  TEST_CASE("tasks tells all about one") {
    CHECK(jarol("tasks Accumulate").output ==
          "Accumulate: gives the running sum of its input\n\ninputs\n  in  double\n\noutputs\n  out  double  sum of "
          "all inputs so far\n");
    CHECK(jarol("tasks Acumulate").exit_code == 2);
    CHECK(json_of("tasks --json")["tasks"].size() == 28);
    CHECK(json_of("tasks --json")["distributers"].size() == 4);
    CHECK(json_of("tasks LauvVehicle --json")["distributers"][0]["channels"][0] ==
          nlohmann::json{{"name", "motion"},
                         {"direction", "in"},
                         {"type", "Motion"},
                         {"text", "position, attitude and velocities"}});
  }

  TEST_CASE("graph prints the order of tasks and a drawing") {
    CHECK(jarol("graph specs/counting.yaml").output.find("count (Counter): every 10ms, deadline 10ms\n") !=
          std::string::npos);
    CHECK(jarol("graph specs/counting.yaml --dot").output.starts_with("digraph \"counting\" {\n"));
    CHECK(jarol("graph specs/counting.yaml --dot --json").exit_code == 2);
  }

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

  TEST_CASE("graph --json tells channels, and what is handed over while nothing comes") {
    const auto communicators = json_of("graph --json specs/exolauv_bare.yaml --profile dune")["communicators"];
    CHECK(communicators[0]["channel"] == "dune.motion");
    CHECK(communicators[0]["timeout_ns"] == 1'000'000'000);
    CHECK(communicators[2]["safe"] == nlohmann::json{{"thruster", 0}, {"fins", {0, 0, 0, 0}}});
  }
}
