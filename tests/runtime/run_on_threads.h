// Runs with tasks on threads of their own, for tests.
#pragma once

#include <doctest/doctest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "graph/analysis/policies.h"
#include "graph/analysis/threads.h"
#include "runtime/execute/executor.h"
#include "runtime/machine/machine.h"
#include "tests/runtime/at_some_speed.h"
#include "tests/runtime/outside.h"
#include "tests/runtime/trace_of.h"

namespace jarol::tests::threads {

using namespace std::chrono_literals;

struct Mode {
  const char* name;
  int cores;
  const char* policy;
};
inline const Mode table_1{"table on 1 core", 1, "table"};
inline const Mode table_2{"table on 2 cores", 2, "table"};
inline const Mode priorities_1{"priorities on 1 core", 1, "fixed_priority"};
inline const Mode priorities_2{"priorities on 2 cores", 2, "fixed_priority"};
inline const Mode modes[] = {table_2, priorities_1, priorities_2};

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
    const Duration end = RealClock::monotonic() + p.lasts;
    while (RealClock::monotonic() < end) {}
  }
};

inline Graph graph_of(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    analysis::add_policies(made);
    tasks::add_tasks(made);
    made.add(task_class<Faulty>());
    made.add(task_class<Busy>());
    made.add(task_class<Patient>());
    made.add(tests::plant());
    return made;
  }();
  return jarol::tests::graph_of(registry, text);
}

// Every ANY is a core, one after the other.
inline std::string on(const Mode& mode, std::string text) {
  int core = 0;
  for (std::size_t at; (at = text.find("ANY")) != std::string::npos; core = (core + 1) % mode.cores)
    text.replace(at, 3, std::to_string(core));
  return text + "platform: {cores: " + std::to_string(mode.cores) + ", policy: " + mode.policy + "}\n";
}

struct RealRun : tests::Run {
  int times = 1;  // as slow as the text says
  std::uint64_t late = 0, left_out = 0;
  std::vector<std::int64_t> worst;  // execution, per task
  std::vector<std::string> refusals;
};

inline const MachineFacts& machine() {
  static const MachineFacts facts = find_machine_facts();
  return facts;
}

// Before other programs where the machine permits it, so that they disturb less.
inline RealTimeOptions undisturbed() {
  RealTimeOptions options;
  if (machine().fifo_priority >= 60) options.priority = 60;
  return options;
}

// All of a stack is locked in memory when its thread is made, and tests make many. Sanitizers need more.
inline void keep_stacks_small() {
#ifdef JAROL_SANITIZED
  constexpr std::size_t size = std::size_t{2} << 20;
#else
  constexpr std::size_t size = std::size_t{512} << 10;
#endif
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, size);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

// A graph that is so many times as slow as what is told of it.
inline RealRun run(const Graph& graph, Duration end, int times, const RealTimeOptions& options, int pieces = 1,
                   std::vector<std::unique_ptr<ExternalSystem>> systems = {}, Recorder* log = nullptr) {
  keep_stacks_small();
  tests::TraceLines lines(graph, times);
  Recorder recorder({&lines});
  RealClock clock(graph.tasks.size(), options);
  const std::vector<analysis::TaskThread> threads = analysis::threads_of(graph);
  Executor executor(graph, std::move(systems),
                    {.recorder = &recorder, .clock = &clock, .threads = threads, .log = log});
  std::thread([&] {  // the test's own thread keeps its scheduler
    if (options.priority) clock.prepare_thread();
    clock.start();
    for (int piece = 1; piece <= pieces; ++piece) executor.run_until(times * end * piece / pieces);
  })
      .join();
  recorder.close();
  munlockall();  // or all threads of the tests that follow would pay for it
  RealRun run;
  run.times = times;
  run.report = executor.report();
  at_full_speed(run.report, times);
  run.lines = lines.lines;
  run.refusals = executor.refusals();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    run.late += clock.timing(i).late;
    run.left_out += clock.timing(i).left_out;
    run.worst.push_back(clock.timing(i).execution.max().count() / times);
  }
  return run;
}

inline RealRun run(const std::string& text, Duration end, int times = 1, const RealTimeOptions& options = undisturbed(),
                   int pieces = 1, std::vector<std::unique_ptr<ExternalSystem>> systems = {}, Recorder* log = nullptr) {
  return run(graph_of(slowed(text, times)), end, times, options, pieces, std::move(systems), log);
}

// Without other misses than those that are meant.
inline RealRun run_undisturbed(const std::string& text, Duration end, const std::string& misses = "", int pieces = 1) {
  RealRun r;
  at_some_speed([&](int times) {
    r = run(text, end, times, undisturbed(), pieces);
    return misses_of(r.report) == misses;
  });
  REQUIRE(misses_of(r.report) == misses);
  return r;
}

// What a run as slow as that one publishes on the virtual clock.
inline tests::Run run_virtual(const std::string& text, Duration end, int times) {
  const Graph graph = graph_of(slowed(text, times));
  tests::TraceLines lines(graph, times);
  Recorder recorder({&lines});
  Executor executor(graph, {}, {.recorder = &recorder});
  executor.run_until(times * end);
  recorder.close();
  tests::Run run{executor.report(), lines.lines};
  at_full_speed(run.report, times);
  return run;
}

inline std::string text_of(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += to_text(fault) + "\n";
  return text;
}

inline std::vector<std::string> sorted(std::vector<std::string> lines) {
  std::sort(lines.begin(), lines.end());
  return lines;
}

}  // namespace jarol::tests::threads
