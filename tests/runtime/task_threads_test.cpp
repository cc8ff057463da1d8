// Tasks on several threads in real time: what is published is what the virtual clock publishes.
#include "runtime/task_threads.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <thread>

#include "runtime/executor.h"
#include "runtime/machine.h"
#include "tests/runtime/random_model.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

struct Mode {
  const char* name;
  int cores;
  const char* policy;
};
const Mode table_1{"table on 1 core", 1, "table"};
const Mode table_2{"table on 2 cores", 2, "table"};
const Mode priorities_1{"priorities on 1 core", 1, "fixed_priority"};
const Mode priorities_2{"priorities on 2 cores", 2, "fixed_priority"};
const Mode modes[] = {table_2, priorities_1, priorities_2};

// Publishes how often it ran plus what it reads. Activation `faulty` takes `lasts`, or throws if that is none.
struct Faulty {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    std::int64_t faulty = -1;
    Duration lasts{};
    static constexpr auto fields() { return describe(field<&Param::faulty>(), field<&Param::lasts>()); }
  };
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    double runs = 0;
    static constexpr auto fields() { return describe(field<&State::runs>()); }
  };
  struct Out {
    double out = -1;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
    state.runs += 1;
    out.out = 1000 * state.runs + in.in;
    if (tick.activation != p.faulty) return;
    if (p.lasts == Duration{}) throw std::runtime_error("on purpose");
    std::this_thread::sleep_for(p.lasts);
  }
};

// Reads its input at its end.
struct Patient {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    Duration waits{};
    static constexpr auto fields() { return describe(field<&Param::waits>()); }
  };
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double out = -1;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out) {
    std::this_thread::sleep_for(p.waits);
    out.out = in.in;
  }
};

// Keeps its processor busy for so long.
struct Busy {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    Duration lasts{};
    static constexpr auto fields() { return describe(field<&Param::lasts>()); }
  };
  static void run(const Param& p, const Tick&) {
    const std::int64_t end = RealClock::monotonic() + p.lasts.count();
    while (RealClock::monotonic() < end) {}
  }
};

Graph graph_of(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Faulty>());
    made.add(task_class<Busy>());
    made.add(task_class<Patient>());
    return made;
  }();
  Problems problems;
  Graph graph =
      build_graph(load_spec(std::make_shared<Source>(Source{"t.yaml", text}), {}, problems), registry, problems);
  problems.throw_if_any();
  return graph;
}

// Every ANY is a core, one after the other.
Graph on(const Mode& mode, std::string text) {
  int core = 0;
  for (std::size_t at; (at = text.find("ANY")) != std::string::npos; core = (core + 1) % mode.cores)
    text.replace(at, 3, std::to_string(core));
  return graph_of(text + "platform: {cores: " + std::to_string(mode.cores) + ", policy: " + mode.policy + "}\n");
}

struct RealRun : tests::Run {
  std::uint64_t late = 0, left_out = 0;
  std::vector<std::int64_t> worst;  // execution, per task
  std::vector<std::string> refusals;
};

const MachineFacts& machine() {
  static const MachineFacts facts = find_machine_facts();
  return facts;
}

// Before other programs where the machine permits it, so that they disturb less.
RealTimeOptions undisturbed() {
  RealTimeOptions options;
  if (machine().fifo_priority >= 60) options.priority = 60;
  return options;
}

RealRun run(const Graph& graph, Duration end, const RealTimeOptions& options = undisturbed(),
            Duration piece = Duration::max()) {
  tests::TraceLines lines(graph);
  Recorder recorder({&lines});
  RealClock clock(graph.tasks.size(), options);
  const std::vector<analysis::TaskThread> threads = analysis::threads_of(graph);
  Executor executor(graph, {}, {.recorder = &recorder, .clock = &clock, .threads = threads});
  std::thread([&] {  // the test's own thread keeps its scheduler
    if (options.priority) clock.prepare_thread();
    clock.start();
    for (Duration at{}; at < end; at += std::min(piece, end)) executor.run_until(at);
    executor.run_until(end);
  })
      .join();
  recorder.close();
  RealRun run;
  run.report = executor.report();
  run.lines = lines.lines;
  run.refusals = executor.refusals();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    run.late += clock.timing(i).late;
    run.left_out += clock.timing(i).left_out;
    run.worst.push_back(clock.timing(i).execution.most());
  }
  return run;
}

// Again when the machine was late for reasons of its own.
RealRun run_undisturbed(const Graph& graph, Duration end, std::uint64_t late = 0, std::uint64_t left_out = 0) {
  RealRun r;
  for (int attempt = 0; attempt < 30; ++attempt) {
    r = run(graph, end);
    if (r.late == late && r.left_out == left_out) break;
  }
  return r;
}

std::string text_of(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += to_text(fault) + "\n";
  return text;
}

std::vector<std::string> sorted(std::vector<std::string> lines) {
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Every instant is a multiple of the step, so that every deadline is one at least.
std::string coarse_random_graph(std::uint64_t seed, Duration step) {
  const auto coarse = [&](std::int64_t ns) { return (ns + 999'999) / 1'000'000 * step.count(); };
  oracle::Model model = oracle::random_model(seed);
  for (oracle::TaskModel& task : model.tasks) {
    task.period = coarse(task.period);
    task.offset = coarse(task.offset) % task.period;
    if (task.let) task.let = coarse(*task.let);
  }
  for (oracle::CommunicatorModel& c : model.communicators) {
    c.period = coarse(c.period);
    c.offset = coarse(c.offset) % c.period;
  }
  std::string text = oracle::to_yaml(model, seed);
  for (const oracle::TaskModel& task : model.tasks) {
    const std::string begin = "  " + task.name + ": {";
    text.insert(text.find(begin) + begin.size(), "core: ANY, ");
  }
  return text;
}

// A random graph gives what it gives on the virtual clock; it goes slower where the machine is too busy.
void check_random_graph(std::uint64_t seed, const Mode& mode, bool in_pieces) {
  for (Duration step = 6ms;; step *= 2) {
    const std::string text = coarse_random_graph(seed, step);
    const Duration end = 20 * step;
    RealRun r;
    for (int attempt = 0; attempt < 5; ++attempt) {
      r = run(on(mode, text), end, undisturbed(), in_pieces ? end / 9 : end);
      if (r.report.fault_count == 0) break;
    }
    if (r.report.fault_count > 0 && step < 200ms) continue;
    const tests::Run should = tests::run_graph(on(table_1, text), end);
    CAPTURE(seed);
    CAPTURE(mode.name);
    CAPTURE(text);
    CHECK(text_of(r.report.faults) == "");
    CHECK(r.report.digest == should.report.digest);
    CHECK(r.report.activations == should.report.activations);
    CHECK(r.report.instants == should.report.instants);
    CHECK(sorted(r.lines) == sorted(should.lines));
    return;
  }
}
}  // namespace

TEST_SUITE("runtime/task_threads") {
  TEST_CASE("random graphs publish what they publish on the virtual clock, whoever runs their tasks") {
    const std::uint64_t count = std::getenv("JAROL_FULL") != nullptr ? 200 : 4;
    for (std::uint64_t seed = 0; seed < count; ++seed)
      for (const Mode& mode : modes) check_random_graph(seed, mode, false);
  }

  TEST_CASE("inputs are those of the release, whatever is published while a task waits or runs") {
    // `follower` begins when `busy` has ended, and `fast` has published twice more
    const std::string text = R"(graph: t
tasks:
  timed: {type: Counter, period: 10ms, let: 5ms, core: ANY}
  busy: {type: Patient, period: 60ms, let: 60ms, core: ANY, parameters: {waits: 25ms}}
  fast: {type: Counter, period: 10ms, core: ANY}
  follower: {type: Patient, period: 60ms, let: 60ms, core: ANY, parameters: {waits: 1ms}}
connections: [timed.out -> busy.in, fast.out -> follower.in]
)";
    for (const Mode& mode : modes) {
      CAPTURE(mode.name);
      const RealRun r = run_undisturbed(on(mode, text), 190ms);
      CHECK(lines_of(r, "busy.out") == "60ms busy.out=0; 120ms busy.out=5; 180ms busy.out=11");
      CHECK(lines_of(r, "follower.out") == "60ms follower.out=0; 120ms follower.out=6; 180ms follower.out=12");
    }
  }

  TEST_CASE("values are recorded in order of their instants") {
    // a data-flow task that is read late is seen to have ended after others have published at later instants
    const std::string text = R"(graph: t
tasks:
  fast: {type: Counter, period: 5ms, let: 5ms}
  slow: {type: Faulty, period: 40ms, parameters: {faulty: 0, lasts: 12ms}}
  reader: {type: Relay, period: 40ms, offset: 30ms}
connections: [fast.out -> slow.in, slow.out -> reader.in]
)";
    const RealRun r = run_undisturbed(on(priorities_1, text), 40ms);
    CHECK(r.lines == std::vector<std::string>{"0ns slow.out=1000", "5ms fast.out=0", "10ms fast.out=1",
                                              "15ms fast.out=2", "20ms fast.out=3", "25ms fast.out=4",
                                              "30ms fast.out=5", "30ms reader.out=1000", "35ms fast.out=6"});
  }

  TEST_CASE("faults, what they keep back and what they undo are those of the virtual clock") {
    for (const std::string on_fault : {"hold", "skip", "stop"}) {
      const std::string text = R"(graph: t
timing: {period: 20ms}
tasks:
  source: {type: Counter, core: ANY}
  flow: {type: Faulty, core: ANY, on_fault: )" +
                               on_fault +
                               R"(, parameters: {faulty: 2}}
  timed: {type: Faulty, core: ANY, let: 10ms, on_fault: )" +
                               on_fault + ", parameters: {faulty: " + (on_fault == "stop" ? "3" : "1") + R"(}}
  reader: {type: Sum, let: 20ms}
connections: [source.out -> flow.in, flow.out -> timed.in, timed.out -> reader.a, flow.out -> reader.b]
)";
      CAPTURE(on_fault);
      const tests::Run should = tests::run_graph(on(table_1, text), 120ms);
      CHECK(should.report.fault_count == (on_fault == "stop" ? 1 : 2));
      for (const Mode& mode : modes) {
        CAPTURE(mode.name);
        const RealRun r = run_undisturbed(on(mode, text), 120ms);
        CHECK(text_of(r.report.faults) == text_of(should.report.faults));
        CHECK(r.report.digest == should.report.digest);
        CHECK(r.report.activations == should.report.activations);
        CHECK(r.report.stopped == should.report.stopped);
        CHECK(r.report.simulated == should.report.simulated);
        CHECK(sorted(r.lines) == sorted(should.lines));
      }
    }
  }

  TEST_CASE("a task that is late publishes what one that throws does: nothing, and its state is undone") {
    for (const std::string let : {"", ", let: 10ms"}) {
      const auto text = [&](const std::string& lasts) {
        return "graph: t\ntiming: {period: 20ms}\ntasks:\n  source: {type: Counter, core: ANY}\n  s: {type: Faulty, "
               "core: ANY" +
               let + ", on_fault: hold, parameters: {faulty: 2, lasts: " + lasts +
               "}}\n  r: {type: Relay, core: ANY, let: 20ms, offset: 10ms}\nconnections: [source.out -> s.in, s.out -> "
               "r.in]\n";
      };
      const tests::Run should = tests::run_graph(on(table_1, text("0ms")), 160ms);
      REQUIRE(should.report.fault_count == 1);
      for (const Mode& mode : modes) {
        CAPTURE(let);
        CAPTURE(mode.name);
        const RealRun r = run_undisturbed(on(mode, text("14ms")), 160ms, 1);
        REQUIRE(r.report.fault_count == 1);
        CHECK(r.report.faults[0].task == "s");
        CHECK(r.report.faults[0].activation == 2);
        CHECK(r.report.faults[0].instant == should.report.faults[0].instant);
        CHECK(r.report.faults[0].cause.substr(0, 6) == "late: ");
        CHECK(r.report.digest == should.report.digest);
        CHECK(sorted(r.lines) == sorted(should.lines));
      }
    }
  }

  TEST_CASE("releases while a late one still runs are left out, each a fault; more urgent tasks go on meanwhile") {
    const std::string text = R"(graph: t
tasks:
  other: {type: Accumulate, period: 10ms, on_fault: hold, core: 0}
  s: {type: Faulty, period: 20ms, let: 20ms, on_fault: skip, core: 0, parameters: {faulty: 2, lasts: 70ms}}
connections: [s.out -> s.in, s.out -> other.in]
)";
    for (const Mode& mode : modes) {
      CAPTURE(mode.name);
      const bool waits = mode.name == table_2.name;  // a table does not preempt
      const RealRun r = run_undisturbed(on(mode, text), 180ms, waits ? 2 : 1, waits ? 9 : 3);
      std::string faults;
      for (const Fault& fault : r.report.faults)
        if (fault.task == "s") faults += to_text(fault) + "\n";
      CHECK(faults ==
            "task 's' activation 2 at 0.06 s: late: had not ended when it was due, deadline 20ms\n"
            "task 's' activation 3 at 0.08 s: left out: an activation before it still ran at its release\n"
            "task 's' activation 4 at 0.1 s: left out: an activation before it still ran at its release\n"
            "task 's' activation 5 at 0.12 s: left out: an activation before it still ran at its release\n");
      CHECK(lines_of(r, "s.out") == "20ms s.out=999; 40ms s.out=2999; 140ms s.out=5999; 160ms s.out=9999");
      // one that has not even begun when it is due leaves no trace in the state
      const std::string before =
          "0ns other.out=-1; 10ms other.out=-2; 20ms other.out=997; 30ms other.out=1996; 40ms other.out=4995; ";
      if (waits)
        CHECK(lines_of(r, "other.out") ==
              before +
                  "120ms other.out=7994; 130ms other.out=10993; 140ms other.out=16992; 150ms other.out=22991; "
                  "160ms other.out=32990; 170ms other.out=42989");
      else
        CHECK(lines_of(r, "other.out").find(before + "50ms other.out=7994; 60ms other.out=10993; ") == 0);
      CHECK(r.lines.size() == (waits ? 11 : 18) + 4);
    }
  }

  TEST_CASE("under SCHED_FIFO a more urgent task preempts, and what it takes is not counted to the other") {
    if (machine().fifo_priority < 4) {
      MESSAGE("this machine does not permit SCHED_FIFO");
      return;
    }
    const Graph graph = on(priorities_1, R"(graph: t
tasks:
  long: {type: Busy, period: 100ms, let: 100ms, wcet: 40ms, parameters: {lasts: 40ms}}
  quick: {type: Busy, period: 10ms, let: 5ms, wcet: 2ms, parameters: {lasts: 2ms}}
)");
    RealTimeOptions options;
    options.priority = 4;
    options.core_cpus = {machine().usable.front()};
    for (int attempt = 0; attempt < 30; ++attempt) {
      const RealRun r = run(graph, 200ms, options);
      if (r.report.fault_count > 0 || r.worst[0] > 38'000'000) continue;
      CHECK(r.refusals.empty());
      CHECK(r.report.activations == 22);
      CHECK(r.worst[0] > 25'000'000);  // of 40 ms on the clock, some 8 for the others
      CHECK(r.worst[1] >= 2'000'000);
      return;
    }
    FAIL("this machine kept no run undisturbed");
  }

  TEST_CASE("a priority that leaves none for the threads is an error") {
    const Graph graph = on(priorities_1, R"(graph: t
tasks: {a: {type: Counter, period: 10ms}, b: {type: Counter, period: 20ms}, c: {type: Counter, period: 20ms}}
)");
    RealTimeOptions options;
    options.priority = 2;
    CHECK_THROWS_WITH_AS(run(graph, 10ms, options),
                         "SCHED_FIFO priority 2 is too low; tasks take 2 below it, so that it has to be 3 at least",
                         std::invalid_argument);
  }

  TEST_CASE("in pieces it is the same run") { check_random_graph(5, priorities_2, true); }
}
