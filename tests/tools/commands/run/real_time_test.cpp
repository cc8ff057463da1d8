// Runs on the real clock as people start them: who runs the tasks, what is reported, what is refused.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/runtime/at_some_speed.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/real_time.h"

namespace {
using command::TemporaryFolder;

// A source feeds two, of which one has a LET; on two cores where there are two.
const std::string graph = R"(graph: t
fault_limit: 100%
tasks:
  source: {type: Counter, period: 20ms, wcet: 1ms, on_fault: hold, core: 0}
  flow: {type: Accumulate, period: 20ms, wcet: 1ms, on_fault: hold, core: 0}
  timed: {type: Sum, period: 40ms, let: 30ms, wcet: 1ms, on_fault: hold, core: CORE}
communicators:
  to: {type: double, direction: out, period: 40ms, offset: 10ms}
connections: [source.out -> flow.in, flow.out -> timed.a, timed.out -> timed.b, timed.out -> to]
)";

std::string on_core(int core) {
  std::string text = graph;
  return text.replace(text.find("CORE"), 4, std::to_string(core));
}

struct BothRuns {
  nlohmann::json real, should;  // on the real clock, on the virtual one
  std::string real_trace, virtual_trace;
};

// For 200 ms without a fault; on a machine that is late more slowly.
BothRuns run_undisturbed(const std::string& text, const std::string& more = "", bool traced = false) {
  const TemporaryFolder folder;
  BothRuns run;
  CHECK(jarol::tests::at_some_speed([&](int times) {
    const std::string file = folder.write("t.yaml", jarol::tests::slowed(text, times));
    const auto json_of = [&](const std::string& clock, std::string& trace) {
      const std::string run_it = "run " + file + more + clock + " --for " + std::to_string(200 * times) + "ms --json" +
                                 (traced ? " --trace " + folder / "t.csv" : "");
      const auto json = nlohmann::json::parse(command::run_jarol(run_it, "2>/dev/null").output);
      std::ifstream written(folder / "t.csv");
      trace.assign(std::istreambuf_iterator<char>(written), {});
      return json;
    };
    run.real = json_of(" --clock real", run.real_trace);
    if (!run.real["faults"].empty()) return false;
    run.should = json_of("", run.virtual_trace);
    return true;
  }));
  return run;
}
}  // namespace

TEST_SUITE("tools/real_time") {
  TEST_CASE("whoever runs the tasks, the digest is that of the virtual clock, and as much is told of each task") {
    const std::string priorities = " --set platform.policy=fixed_priority", two = " --set platform.cores=2";
    std::vector<std::pair<int, std::string>> modes{{0, ""}, {0, priorities}};
    if (std::thread::hardware_concurrency() >= 2) {
      modes.emplace_back(1, two);
      modes.emplace_back(1, two + priorities);
    }
    for (const auto& [core, mode] : modes) {
      const std::string its = mode;
      CAPTURE(its);
      const BothRuns run = run_undisturbed(on_core(core), mode);
      CHECK(run.real["faults"].size() == 0);
      CHECK(run.real["digest"] == run.should["digest"]);
      CHECK(run.real["activations"] == run.should["activations"]);
      CHECK(run.real["outputs"] == run.should["outputs"]);
      for (const std::string task : {"flow", "source", "timed"}) {
        const auto& reported = run.real["real_time"]["tasks"][task];
        CHECK(reported["activations"] == (task == "timed" ? 5 : 10));
        CHECK(reported["execution_max_ns"] > 0);
        CHECK(reported["response_max_ns"] >= reported["execution_max_ns"]);
        CHECK(reported["late"] == 0);
        CHECK(reported["left_out"] == 0);
      }
    }
  }

  TEST_CASE("the trace has its rows in order of time, whoever runs the tasks") {
    const BothRuns run = run_undisturbed(on_core(0), " --set platform.policy=fixed_priority", true);
    CHECK(run.virtual_trace.size() > 100);
    CHECK(run.real_trace == run.virtual_trace);
  }

  TEST_CASE("the progress that a terminal shows leaves alone the CPU of the thread that keeps the time") {
    cpu_set_t usable;
    sched_getaffinity(0, sizeof usable, &usable);
    if (CPU_COUNT(&usable) < 2) return;
    std::size_t cpu = 0;
    while (!CPU_ISSET(cpu, &usable)) ++cpu;
    const TemporaryFolder folder;
    const std::string one = folder.write("one.yaml", on_core(0));
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(terminal >= 0);
    REQUIRE((grantpt(terminal) == 0 && unlockpt(terminal) == 0));
    std::FILE* const run = popen(("echo $$; exec " JAROL_COMMAND " run " + one + " --clock real --for 10min --cpus " +
                                  std::to_string(cpu) + " 2>" + ptsname(terminal))
                                     .c_str(),
                                 "r");
    int id = 0;
    REQUIRE(std::fscanf(run, "%d", &id) == 1);
    // of each of its threads, on how many CPUs it may run
    const auto counts = [&] {
      std::vector<int> found;
      for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(id) + "/task")) {
        cpu_set_t set;
        sched_getaffinity(std::stoi(thread.path().filename()), sizeof set, &set);
        found.push_back(CPU_COUNT(&set));
      }
      std::sort(found.begin(), found.end());
      return found;
    };
    // that one, the one that shows the progress, and the one that looks after both
    const std::vector<int> should{1, CPU_COUNT(&usable), CPU_COUNT(&usable)};
    for (int look = 0; look < 3000 && counts() != should; ++look)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(counts() == should);
    kill(id, SIGINT);
    while (std::fgetc(run) != EOF) {}  // its report has to find a reader
    CHECK(WEXITSTATUS(pclose(run)) == 130);
    close(terminal);
  }

  TEST_CASE("what check finds not schedulable is a negative verdict, and not run unless forced") {
    const TemporaryFolder folder;
    const std::string one = folder.write("one.yaml", on_core(0));
    const std::string run = "run " + one + " --clock real --for 40ms --set tasks.flow.wcet=30ms";
    const auto refused = command::run_jarol(run);
    CHECK(refused.exit_code == 1);
    CHECK(refused.output ==
          "error: '" + one +
              "' is not schedulable: the tasks need more than the whole core; 'jarol check' says more, --force runs it "
              "all the same\n");
    const auto forced = command::run_jarol(run + " --force");
    CHECK(forced.exit_code == 0);
    CHECK(forced.output.find("note: run by force: '" + one +
                             "' is not schedulable: the tasks need more than the whole core\n") != std::string::npos);
  }

  TEST_CASE("what breaks a chain's limit is a negative verdict, and not run unless forced") {
    const TemporaryFolder folder;
    const std::string one = folder.write("one.yaml", on_core(0) + "chains:\n  c: {path: [flow, timed, to]}\n");
    const std::string run = "run " + one + " --clock real --for 40ms";
    CHECK(command::run_jarol(run).exit_code == 0);
    const std::string late = run + " --set chains.c.reaction=80ms --set chains.c.age=85ms";
    const auto refused = command::run_jarol(late);
    CHECK(refused.exit_code == 1);
    CHECK(refused.output == "error: '" + one +
                                "' breaks a limit of chain 'c': reaction 90ms over 80ms, data age 90ms over 85ms; "
                                "'jarol check' says more, --force runs it all the same\n");
    CHECK(
        command::run_jarol(late + " --set tasks.flow.wcet=30ms").output ==
        "error: '" + one +
            "' is not schedulable: the tasks need more than the whole core, and breaks a limit of chain 'c': reaction "
            "90ms over 80ms, data age 90ms over 85ms; 'jarol check' says more, "
            "--force runs it all the same\n");
    const auto forced = command::run_jarol(late + " --force");
    CHECK(forced.exit_code == 0);
    CHECK(forced.output.find("note: run by force: '" + one +
                             "' breaks a limit of chain 'c': reaction 90ms over 80ms, "
                             "data age 90ms over 85ms\n") != std::string::npos);
    // on the virtual clock it is logical time that is short, whatever the limit
    CHECK(command::run_jarol("run " + one + " --for 40ms --set chains.c.reaction=80ms").exit_code == 0);
  }

  TEST_CASE("a chain's limit that only an upper bound breaks is not known to break, and the run begins") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
fault_limit: 100%  # the machine may be late, which is not what this is about
tasks:
  a: {type: Counter, period: 1ms, let: 1ms, wcet: 1us, on_fault: hold}
  b: {type: Relay, period: 3000.0001s, let: 1ms, wcet: 1us, on_fault: hold}
connections: [a.out -> b.in]
chains:
  c: {path: [a, b], reaction: 3000s}
)");
    const auto run = command::run_jarol("run " + file + " --clock real --for 20ms");
    CHECK(run.exit_code == 0);
    CHECK(run.output.find("chain 'c' may break a limit, by upper bounds: reaction 3000.0031s over 3000s\n") !=
          std::string::npos);
  }

  TEST_CASE("a vehicle that never answers was not there: the run is not brought to an end, and says so") {
    const std::string udp =
        "--set 'distributers.dune.link={type: udp, peer: \"127.0.0.1:9\"}' --for 200ms --clock real";
    for (const std::string concurrency : {"exotasks", "threads"}) {
      const std::string run = "run specs/exolauv_bare.yaml " + udp + " --concurrency " + concurrency;
      const auto [exit_code, text] = command::run_jarol(run);
      CHECK(exit_code == 3);
      CHECK(text.find("error: nothing came from the vehicle of 'dune' in the whole run; is it there?\n") !=
            std::string::npos);
      const std::size_t link = text.find("  link        udp 127.0.0.1:0 with 127.0.0.1:9: ");
      REQUIRE(link != std::string::npos);
      CHECK(text.substr(text.find('\n', link) + 1)
                .starts_with("              NO PACKET HAS COME over udp 127.0.0.1:0 with 127.0.0.1:9\n"));
      const auto json = nlohmann::json::parse(command::run_jarol(run + " --json", "2>/dev/null").output);
      CHECK(json["links"][0]["heard"] == false);
      CHECK(json["judgement"]["unheard"] == nlohmann::json::array({"dune"}));
    }
    // nor has what is dropped
    jarol::LinkReport link{
        "udp 127.0.0.1:7002", {{"packets in", 0}, {"packets out", 3}, {"dropped: stranger", 2}}, 0, 2};
    CHECK(jarol::tools::to_text(link) ==
          "  link        udp 127.0.0.1:7002: 3 packets out, 2 dropped: stranger\n"
          "              NO PACKET THAT COUNTS HAS COME over udp 127.0.0.1:7002\n");
    link.dropped = 0;
    CHECK(jarol::tools::to_text(link).ends_with("\n              NO PACKET HAS COME over udp 127.0.0.1:7002\n"));
    link.heard = 1;
    CHECK(jarol::tools::to_text(link) == "  link        udp 127.0.0.1:7002: 3 packets out, 2 dropped: stranger\n");
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("an operator that never speaks may not be there") {
    const auto [exit_code, json] = command::run_jarol(
        "run specs/javiator.yaml --set 'distributers.terminal.link={type: udp, peer: 9}' --set at_end=null "
        "--set expect=nothing --set fault_limit=100% --clock real --for 100ms --json",
        "2>/dev/null");
    CHECK(exit_code == 0);
    CHECK(nlohmann::json::parse(json)["links"][0]["heard"] == false);
    CHECK(nlohmann::json::parse(json)["judgement"]["unheard"].empty());
  }
#endif

  TEST_CASE("peers, strangers and takeovers of a link are in its report, as text and as JSON") {
    jarol::LinkReport link;
    link.link = "udp 127.0.0.1:7002";
    link.counts = {{"packets in", 5}};
    link.heard = 5;
    link.peers = {{"127.0.0.1:4001", 3}, {"127.0.0.1:4002", 2}};
    link.strangers = {{"127.0.0.1:5000", 12}};
    link.more_strangers = 3;
    link.takeovers = {{"127.0.0.1:4000", "127.0.0.1:4001", std::chrono::milliseconds(12340)}};
    CHECK(jarol::tools::to_text(link) ==
          "  link        udp 127.0.0.1:7002: 5 packets in\n"
          "              peer 127.0.0.1:4001, 3 packets\n"
          "              peer 127.0.0.1:4002, 2 packets\n"
          "              taken over by 127.0.0.1:4001 at 12.34 s, after 127.0.0.1:4000 had been silent\n"
          "              stranger 127.0.0.1:5000, 12 times\n"
          "              more strangers, 3 times\n");
    CHECK(jarol::tools::to_json(link).dump() ==
          R"({"link":"udp 127.0.0.1:7002","heard":true,"counts":{"packets in":5},)"
          R"("peers":[{"address":"127.0.0.1:4001","packets":3},{"address":"127.0.0.1:4002","packets":2}],)"
          R"("strangers":[{"address":"127.0.0.1:5000","times":12}],"more_strangers":3,)"
          R"("takeovers":[{"from":"127.0.0.1:4000","to":"127.0.0.1:4001","at_ns":12340000000}]})");
  }

  TEST_CASE("what can't be executed is refused with what would be right") {
    const TemporaryFolder folder;
    const std::string one = folder.write("one.yaml", on_core(0));
    const auto refusal = [&](const std::string& more) {
      const auto result = command::run_jarol("run " + one + " --clock real --for 200ms " + more);
      CHECK(result.exit_code == 2);
      return result.output;
    };
    CHECK(refusal("--set platform.policy=edf") ==
          "error: '" + one +
              "' has the policy 'edf'; the real clock executes 'table' and 'fixed_priority'; choose one "
              "by --set platform.policy=table\n");
    CHECK(refusal("--set platform.policy=fixed_priority --rt-priority 2") ==
          "error: --rt-priority 2: the tasks of '" + one + "' take 2 priorities below it; choose 3 or more\n");
    CHECK(refusal("--set platform.cores=2 --set tasks.timed.core=1 --cpus 0") ==
          "error: '" + one + "' has tasks on 2 cores; --cpus names 1 CPU\n");
    CHECK(refusal("--cpus 0,0") == "error: --cpus: '0,0' names CPU 0 twice\n");
    CHECK(refusal("--workers 2") == "error: --workers belongs to the virtual clock; the real one goes by 'platform'\n");
  }

  TEST_CASE("what is safe and did not go out makes a run unfinished, but where nobody was ever there") {
    jarol::FailsafeReport safe;
    CHECK(jarol::tools::exit_code_of({safe}) == 0);
    safe.at_end = jarol::FailsafeReport::AtEnd{};
    CHECK(jarol::tools::exit_code_of({safe}) == 0);
    safe.at_end->failure = jarol::unsent_text;
    CHECK(jarol::tools::exit_code_of({safe}) == 3);
    safe.at_end->is_alone = true;
    CHECK(jarol::tools::exit_code_of({safe}) == 0);
  }
}
