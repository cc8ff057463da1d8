#include "runtime/machine/real_clock.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <thread>

#include "tests/runtime/at_some_speed.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

// Publishes its activation; that one of number `slow` takes `lasts`, that one of number `throws` throws.
struct Slow {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    std::int64_t slow = 2;
    Duration lasts = 50ms;
    std::int64_t throws = -1;
    static constexpr auto fields() {
      return describe(field<&Param::slow>(), field<&Param::lasts>(), field<&Param::throws>());
    }
  };
  struct State {
    double runs = 0;
    static constexpr auto fields() { return describe(field<&State::runs>()); }
  };
  struct Out {
    double out = -1;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    state.runs += 1;
    out.out = state.runs;
    if (tick.activation == p.slow) std::this_thread::sleep_for(p.lasts);
    if (tick.activation == p.throws) throw std::runtime_error("too hot");
  }
};

// Tells that it has run.
struct Reporting {
  static constexpr std::string_view summary = "for tests";
  static inline std::atomic<bool> has_run{false};
  static void run(const Tick&) { has_run = true; }
};

Graph graph_from(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Slow>());
    made.add(task_class<Reporting>());
    return made;
  }();
  return jarol::tests::graph_of(registry, text);
}

std::string text_with(const std::string& slow) {
  return "graph: t\ntiming: {period: 20ms}\ntasks:\n  s: {type: Slow" + slow +
         "}\n  r: {type: Relay, on_fault: hold}\nconnections: [s.out -> r.in]\n";
}

struct RealRun : tests::Run {
  std::uint64_t late = 0, left_out = 0;  // of all tasks
  int times = 1;                         // as slow as the text says
};

RealRun run(const std::string& text, Duration end, int times) {
  const Graph graph = graph_from(tests::slowed(text, times));
  tests::TraceLines lines(graph, times);
  Recorder recorder({&lines});
  RealClock clock(graph.tasks.size());
  Executor executor(graph, {}, {.digest = true, .recorder = &recorder, .clock = &clock});
  clock.start();
  executor.run_until(times * end);
  recorder.close();
  RealRun run;
  run.times = times;
  run.report = executor.report();
  tests::at_full_speed(run.report, times);
  run.lines = lines.lines;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    run.late += clock.timing(i).late;
    run.left_out += clock.timing(i).left_out;
  }
  return run;
}

// Without other misses than those that are meant.
RealRun run_undisturbed(const std::string& text, Duration end, const std::string& misses) {
  RealRun r;
  tests::at_some_speed([&](int times) {
    r = run(text, end, times);
    return tests::misses_of(r.report) == misses;
  });
  REQUIRE(tests::misses_of(r.report) == misses);
  return r;
}
}  // namespace

TEST_SUITE("runtime/real_clock") {
  TEST_CASE("the real clock gives the digest of the virtual clock") {
    const std::string text = text_with(", parameters: {slow: -1}");
    const RealRun real = run_undisturbed(text, 200ms, "");
    REQUIRE(real.report.fault_count == 0);
    const Graph graph = graph_from(tests::slowed(text, real.times));
    CHECK(real.report.digest == tests::run_graph(graph, real.times * 200ms).report.digest);
    CHECK(real.report.activations == 20);
  }

  TEST_CASE("before its start the clock stands at zero") {
    RealClock clock(1);
    CHECK(clock.now() == 0ns);
    clock.start();
    CHECK(clock.now() < 1s);
  }

  TEST_CASE("an instant is never begun before the clock has reached it") {
    const Graph graph = graph_from(text_with(", on_fault: hold, parameters: {slow: -1}"));
    RealClock clock(graph.tasks.size());
    Executor executor(graph, {}, {.clock = &clock});
    clock.start();
    executor.run_until(101ms);
    CHECK(clock.now() >= 100ms);
    CHECK(clock.lateness().count() == 6);
    CHECK(clock.lateness().percentile(0) >= 0ns);
  }

  TEST_CASE("a task that is late publishes nothing, readers keep the last value, its state is undone") {
    // what it feeds waits for it and is late too
    const RealRun r = run_undisturbed(text_with(", on_fault: hold, parameters: {slow: 2, lasts: 30ms}"), 120ms,
                                      "late: r 2, s 2; left out: r 3, s 3");
    REQUIRE(r.report.fault_count == 4);
    CHECK(r.late == 2);
    CHECK(r.left_out == 2);
    CHECK(r.report.faults[0].task == "s");
    CHECK(r.report.faults[0].activation == 2);
    CHECK(r.report.faults[0].instant == 40ms);
    CHECK(r.report.faults[0].cause.substr(0, 12) == "late: ended ");
    CHECK(r.report.faults[0].cause.find(" after its release, deadline 20ms") != std::string::npos);
    CHECK(r.report.faults[1].task == "r");
    CHECK(lines_of(r, "s.out") == "0ns s.out=1; 20ms s.out=2; 80ms s.out=3; 100ms s.out=4");
    CHECK(lines_of(r, "r.out") == "0ns r.out=1; 20ms r.out=2; 80ms r.out=3; 100ms r.out=4");
  }

  TEST_CASE("releases while a late one still runs are left out, each a fault") {
    const RealRun r = run_undisturbed(text_with(", on_fault: hold, let: 20ms, parameters: {slow: 2, lasts: 70ms}"),
                                      160ms, "late: r 3, s 2; left out: r 4, r 5, s 3, s 4, s 5");
    CHECK(r.late == 2);
    CHECK(r.left_out == 5);
    std::string faults;
    for (const Fault& fault : r.report.faults)
      if (fault.task == "s") faults += std::to_string(fault.activation) + " " + fault.cause.substr(0, 12) + "; ";
    CHECK(faults == "2 late: ended ; 3 left out: an; 4 left out: an; 5 left out: an; ");
    CHECK(r.report.faults[2].cause == "left out: an activation before it still ran at its release");
    CHECK(lines_of(r, "s.out") == "20ms s.out=1; 40ms s.out=2; 140ms s.out=3");
  }

  TEST_CASE("an activation that is skipped takes no time, however late its instant is worked on") {
    // s is to be skipped at 60 ms, when b works beyond 80 ms
    const RealRun r = run_undisturbed(
        "graph: t\ntiming: {period: 20ms}\ntasks:\n"
        "  b: {type: Slow, on_fault: hold, parameters: {slow: 3, lasts: 25ms}}\n"
        "  s: {type: Slow, on_fault: skip, parameters: {slow: -1, throws: 2}}\n",
        120ms, "late: b 3; left out: b 4");
    std::string faults;
    for (const Fault& fault : r.report.faults)
      faults += fault.task + " " + std::to_string(fault.activation) + " " + fault.cause.substr(0, 10) + "; ";
    CHECK(faults == "s 2 threw: too; b 3 late: ende; b 4 left out: ; ");
    CHECK(lines_of(r, "s.out") == "0ns s.out=1; 20ms s.out=2; 80ms s.out=3; 100ms s.out=4");
  }

  TEST_CASE("with 'stop' a late task ends the run") {
    const RealRun r = run_undisturbed(text_with(", parameters: {slow: 1, lasts: 25ms}"), 200ms, "late: r 1, s 1");
    CHECK(r.report.stopped);
    CHECK(r.report.simulated == 20ms);
  }

  TEST_CASE("memory that is locked under a limit leaves threads and allocations free") {
    const pid_t child = fork();
    if (child == 0) {
      // a limit above what there is, where the process may set one, and nobody for whom no limit counts
      constexpr std::size_t room = 512U << 20;
      const rlimit limit{room, room};
      setrlimit(RLIMIT_MEMLOCK, &limit);
      rlimit before{};
      bool good = getrlimit(RLIMIT_MEMLOCK, &before) == 0 && (geteuid() != 0 || setuid(65534) == 0);
      prepare_thread({});
      try {
        const auto memory = std::make_unique_for_overwrite<char[]>(room);
        std::thread([&] { memory[room / 2] = 1; }).join();
      } catch (const std::exception&) { good = false; }
      rlimit after{};
      good = good && getrlimit(RLIMIT_MEMLOCK, &after) == 0 && after.rlim_cur == before.rlim_cur;
      _exit(good ? 0 : 1);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }

  TEST_CASE("without a priority a thread asks the ordinary scheduler for a short slice, and keeps its niceness") {
    std::uint64_t slice = 0;
    int niceness = 0;
    std::thread([&] {
      setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 3);
      prepare_thread({});
      struct {
        std::uint32_t size, policy;
        std::uint64_t flags;
        std::int32_t nice;
        std::uint32_t priority;
        std::uint64_t runtime, deadline, period;
      } attributes{};
      if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) == 0) slice = attributes.runtime;
      niceness = getpriority(PRIO_PROCESS, 0);
    }).join();
    CHECK(niceness == 3);
    if (slice == 0)
      MESSAGE("this kernel has no slices that can be asked for");
    else
      CHECK(slice == 100'000);
  }

  TEST_CASE("an interrupt ends the wait for an instant far away") {
    const Graph graph = graph_from("{graph: t, tasks: {a: {type: Reporting, period: 1h}}}");
    RealClock clock(graph.tasks.size());
    Executor executor(graph, {}, {.clock = &clock});
    std::thread other([&] {
      while (!Reporting::has_run) std::this_thread::sleep_for(1ms);
      std::this_thread::sleep_for(20ms);
      executor.interrupt();
    });
    clock.start();
    executor.run_until(2h);
    other.join();
    CHECK(executor.report().instants == 1);
    CHECK(clock.now() < 60s);
  }
}

TEST_SUITE("runtime/histogram") {
  TEST_CASE("percentiles are those of the samples, rounded up by a sixteenth at most") {
    Histogram h;
    CHECK(h.percentile(0.5) == 0ns);
    for (std::int64_t i = 1; i <= 100'000; ++i) h.add(i * 10ns);
    CHECK(h.count() == 100'000);
    CHECK(h.max() == 1ms);
    CHECK(h.percentile(1.0) == 1ms);
    for (const double part : {0.001, 0.1, 0.5, 0.99, 0.999}) {
      CAPTURE(part);
      CHECK(static_cast<double>(h.percentile(part).count()) >= part * 1e6);
      CHECK(static_cast<double>(h.percentile(part).count()) <= part * 1e6 * 17 / 16);
    }
  }

  TEST_CASE("small durations are exact, and a negative one counts as none") {
    Histogram h;
    for (const Duration duration : {-5ns, 3ns, 31ns, 31ns}) h.add(duration);
    CHECK(h.percentile(0.25) == 0ns);
    CHECK(h.percentile(0.5) == 3ns);
    CHECK(h.percentile(0.75) == 31ns);
  }

  TEST_CASE("the longest duration there is fits") {
    Histogram h;
    h.add(Duration::max());
    CHECK(h.percentile(0.5) == Duration::max());
  }
}
