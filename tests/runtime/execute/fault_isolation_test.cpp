// A fault of one task in a graph of ten: the tasks that it does not feed notice nothing, whatever fault and policy;
// those that it feeds see what DESIGN says, which is worked out here by hand from the faulty activations alone.
#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <stdexcept>

#include "graph/analysis/execution_times.h"
#include "graph/analysis/policies.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

enum class Cause : std::uint8_t { none, heap, throws, nan, range };
[[maybe_unused]] constexpr auto enumerators(Cause) {
  return std::array<Enumerator<Cause>, 5>{{{"none", Cause::none},
                                           {"heap", Cause::heap},
                                           {"throws", Cause::throws},
                                           {"nan", Cause::nan},
                                           {"range", Cause::range}}};
}

bool is_faulty(std::int64_t activation) { return activation % 7 == 3 || activation % 7 == 4; }

// Counts its activations and sums its input; some of them are faulty, in the midst of what they do.
struct Culprit {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    Cause cause = Cause::none;
    static constexpr auto fields() { return describe(field<&Param::cause>()); }
  };
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    double runs = 100, sum = 0;
    Sequence<double> seen{};
    static constexpr auto fields() {
      return describe(field<&State::runs>(), field<&State::sum>(), field<&State::seen>());
    }
  };
  struct Out {
    double runs = 0, sum = 0;
    static constexpr auto fields() { return describe(field<&Out::runs>("").in(0, 1e6), field<&Out::sum>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
    state.runs += 1;
    state.sum += in.in;
    if (state.seen.size() < 8) state.seen.push_back(in.in);
    out.runs = state.runs;
    out.sum = state.sum + static_cast<double>(state.seen.size());
    if (p.cause == Cause::none || !is_faulty(tick.activation)) return;
    if (p.cause == Cause::heap) state.seen.resize(100'000);
    if (p.cause == Cause::throws) throw std::runtime_error("too hot");
    if (p.cause == Cause::nan) out.sum = std::numeric_limits<double>::quiet_NaN();
    if (p.cause == Cause::range) out.runs = -1;
  }
};

// Culprit `c` among nine others: it feeds `near`, `far`, `timed` and, with others, `mixed`; `a` to `e` it does not
// feed.
std::string text_of(const std::string& cause, const std::string& policy, bool timed) {
  return R"(graph: ten
timing: {period: 20ms}
platform: {policy: fixed_priority}
tasks:
  a: {type: Counter, period: 5ms, wcet: 10us, priority: 1}
  b: {type: Accumulate, period: 10ms, let: 7ms, wcet: 10us, priority: 1}
  c: {type: Culprit, period: 10ms, heap: 4KiB, wcet: 1ms, on_fault: )" +
         policy + (timed ? ", let: 6ms" : "") + ", parameters: {cause: " + cause + R"(}}
  d: {type: Sum, period: 20ms, wcet: 10us, priority: 1}
  e: {type: Relay, period: 20ms, let: 20ms, wcet: 10us, priority: 1}
  far: {type: Accumulate, period: 10ms, wcet: 10us, priority: 1}
  mixed: {type: Sum, period: 5ms, wcet: 10us, priority: 1}
  near: {type: Relay, period: 10ms, wcet: 10us, priority: 1}
  other: {type: Accumulate, period: 5ms, let: 5ms, wcet: 10us, priority: 1}
  timed: {type: Relay, period: 10ms, let: 10ms, wcet: 10us, priority: 1}
connections:
  - a.out -> b.in
  - a.out -> c.in
  - b.out -> d.a
  - a.out -> d.b
  - d.out -> e.in
  - a.out -> other.in
  - c.runs -> near.in
  - near.out -> far.in
  - c.sum -> timed.in
  - c.runs -> mixed.a
  - a.out -> mixed.b
)";
}

Graph graph_of_text(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    analysis::add_policies(made);
    tasks::add_tasks(made);
    made.add(task_class<Culprit>());
    return made;
  }();
  return tests::graph_of(registry, text);
}

struct Ran {
  Report report;
  std::map<std::string, std::string> lines;  // by output
};

// `times`: what activations take, as the schedule of the platform has it; empty: nothing is late.
Ran run(const std::string& text, std::size_t workers, Duration end = 400ms, const std::string& times = "") {
  const Graph graph = graph_of_text(text);
  std::optional<analysis::Schedule> schedule;
  Problems problems;
  if (!times.empty())
    schedule.emplace(schedule_of(
        graph, analysis::ExecutionTimes::read(graph, std::make_shared<Source>(Source{"times", times}), 0, problems)));
  tests::TraceLines lines(graph);
  Recorder recorder({&lines});
  Executor executor(graph, {},
                    {.recorder = &recorder,
                     .workers = workers,
                     .sharing = workers > 1 ? Sharing::always : Sharing::if_it_pays,
                     .schedule = schedule ? &*schedule : nullptr});
  executor.run_until(end);
  recorder.close();
  Ran ran{executor.report(), {}};
  for (const std::string& line : lines.lines) {
    const std::size_t name = line.find(' ') + 1;
    ran.lines[line.substr(name, line.find('=') - name)] +=
        line.substr(0, name) + line.substr(line.find('=') + 1) + "; ";
  }
  return ran;
}

// What `c.runs` has by the words of the design: the state is as before a faulty activation, or as at the start.
std::string expected_runs(const std::string& policy, bool timed, Duration end) {
  std::string text;
  double runs = 100;
  bool skip = false;
  for (std::int64_t k = 0; k * 10ms < end; ++k) {
    const Duration published = k * 10ms + (timed ? Duration(6ms) : Duration{});
    if (published >= end) break;
    if (std::exchange(skip, false)) continue;
    if (is_faulty(k)) {
      if (policy == "stop") break;
      skip = policy == "skip";
      if (policy == "restart") runs = 100;
      continue;
    }
    runs += 1;
    text += duration_text(published) + " " + number_text(runs) + "; ";
  }
  return text;
}
}  // namespace

TEST_SUITE("runtime/fault_isolation") {
  TEST_CASE("tasks that a faulty one does not feed are those of a run without the fault, to the bit") {
    for (const bool timed : {false, true}) {
      const Ran without = run(text_of("none", "stop", timed), 1);
      REQUIRE(without.report.fault_count == 0);
      for (const std::string cause : {"heap", "throws", "nan", "range"})
        for (const std::string policy : {"hold", "skip", "restart"}) {
          std::uint64_t digest = 0;
          for (const std::size_t workers : {1, 2, 4}) {
            CAPTURE(cause);
            CAPTURE(policy);
            CAPTURE(timed);
            CAPTURE(workers);
            const Ran ran = run(text_of(cause, policy, timed), workers);
            CHECK(ran.report.fault_count > 3);
            for (const char* output : {"a.out", "b.out", "d.out", "e.out", "other.out"})
              CHECK(ran.lines.at(output) == without.lines.at(output));
            for (const char* output : {"near.out", "far.out", "timed.out", "mixed.out"})
              CHECK(ran.lines.at(output) != without.lines.at(output));
            CHECK(ran.lines.at("c.runs") == expected_runs(policy, timed, 400ms));
            if (workers == 1) digest = ran.report.digest;
            CHECK(ran.report.digest == digest);
          }
        }
    }
  }

  TEST_CASE("the same holds where the faulty activations are late, or left out as one before them still runs") {
    const Ran without = run(text_of("none", "stop", true), 1);
    for (const std::string times :
         {"c: [1ms, 1ms, 1ms, 8ms, 8ms, 1ms, 1ms]", "c: [1ms, 1ms, 1ms, 14ms, 1ms, 1ms, 1ms]"})
      for (const std::string policy : {"hold", "skip", "restart"}) {
        CAPTURE(times);
        CAPTURE(policy);
        std::uint64_t digest = 0;
        for (const std::size_t workers : {1, 2, 4}) {
          CAPTURE(workers);
          const Ran ran = run(text_of("none", policy, true), workers, 400ms, times);
          CHECK(ran.report.fault_count > 3);
          for (const Fault& fault : ran.report.faults) CHECK(fault.task == "c");
          for (const char* output : {"a.out", "b.out", "d.out", "e.out", "other.out"})
            CHECK(ran.lines.at(output) == without.lines.at(output));
          CHECK(ran.lines.at("c.runs") == expected_runs(policy, true, 400ms));
          if (workers == 1) digest = ran.report.digest;
          CHECK(ran.report.digest == digest);
        }
      }
  }

  TEST_CASE("readers of a faulty task keep its last value, at the instant of the fault, too") {
    const Ran ran = run(text_of("throws", "hold", false), 1, 60ms);
    CHECK(ran.lines.at("c.runs") == "0ns 101; 10ms 102; 20ms 103; 50ms 104; ");
    CHECK(ran.lines.at("near.out") == "0ns 101; 10ms 102; 20ms 103; 30ms 103; 40ms 103; 50ms 104; ");
    const Ran anew = run(text_of("throws", "restart", false), 1, 60ms);
    CHECK(anew.lines.at("c.runs") == "0ns 101; 10ms 102; 20ms 103; 50ms 101; ");
    CHECK(anew.lines.at("near.out") == "0ns 101; 10ms 102; 20ms 103; 30ms 103; 40ms 103; 50ms 101; ");
  }

  TEST_CASE("until a fault stops the run it is the run without it, with any number of workers") {
    for (const std::string cause : {"heap", "throws", "nan", "range"}) {
      const Ran without = run(text_of("none", "stop", false), 1, 30ms);
      for (const std::size_t workers : {1, 2, 4}) {
        CAPTURE(cause);
        const Ran ran = run(text_of(cause, "stop", false), workers);
        CHECK(ran.report.stopped);
        CHECK(ran.report.simulated == 30ms);
        for (const auto& [output, lines] : without.lines) CHECK(ran.lines.at(output).starts_with(lines));
        CHECK(ran.lines.at("c.runs") == expected_runs("stop", false, 400ms));
      }
    }
  }

  TEST_CASE("each cause is reported in words, a number out of range with its range") {
    const auto cause = [](const std::string& of) {
      return run(text_of(of, "hold", false), 1, 40ms).report.faults.at(0).cause;
    };
    CHECK(cause("throws") == "threw: too hot");
    CHECK(cause("nan") == "output 'sum' is nan");
    CHECK(cause("range") == "output 'runs' is -1, out of its range from 0 to 1e+06");
    CHECK(cause("heap") ==
          "917504 bytes more do not fit its heap: 48 of 4096 bytes are in use; give it a larger one, as in heap: "
          "1024KiB");
  }

  TEST_CASE("fault_limit stops the run with the fault that reaches it, in releases and not in runs") {
    const auto stops_at = [](const std::string& policy, const std::string& limit) -> std::string {
      const Ran ran = run(text_of("throws", policy + ", fault_limit: " + limit, false), 1, 1s);
      return ran.report.stopped ? to_text(ran.report.faults.back()) : "goes on";
    };
    const std::string by = ", which is its fault_limit";
    // activations 3, 4, 10, 11, 17, 18 ...
    CHECK(stops_at("hold", "1 of 1") ==
          "task 'c' activation 3 at 0.03 s: threw: too hot; that is fault 1 in 1 releases" + by);
    CHECK(stops_at("hold", "3 of 8") ==
          "task 'c' activation 10 at 0.1 s: threw: too hot; that is fault 3 in 8 releases" + by);
    CHECK(stops_at("restart", "3 of 7") == "goes on");
    // skip leaves out 4, 11 ...: of 3, 10, 17 there are three in 15 releases
    CHECK(stops_at("skip", "3 of 14") == "goes on");
    CHECK(stops_at("skip", "3 of 15") ==
          "task 'c' activation 17 at 0.17 s: threw: too hot; that is fault 3 in 15 releases" + by);
  }

  TEST_CASE("a run that is saved with a restart and a limit under way goes on as in one piece") {
    for (const std::string policy : {"restart", "restart, fault_limit: 5 of 17", "hold, fault_limit: 5 of 18"}) {
      const Graph graph = graph_of_text(text_of("throws", policy, true));
      Executor whole(graph, {});
      whole.run_until(400ms);
      for (Duration at = 1ms; at < 400ms; at += 13ms) {
        Executor first(graph, {}), second(graph, {});
        first.run_until(at);
        Archive::Bytes bytes;
        Archive to = Archive::to(bytes);
        first.serialize(to);
        Archive from = Archive::from(bytes);
        second.serialize(from);
        second.run_until(400ms);
        CHECK(second.report().digest == whole.report().digest);
        CHECK(second.report().stopped == whole.report().stopped);
        CHECK(second.report().fault_count == whole.report().fault_count);
      }
    }
  }
}
