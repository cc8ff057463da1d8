// What a run takes from outside and misses, given again on the virtual clock, gives the run again.
#include "runtime/record/log.h"

#include <doctest/doctest.h>

#include <cstring>

#include "tests/how_many.h"
#include "tests/runtime/outside.h"
#include "tests/runtime/random_model.h"
#include "tests/runtime/run_on_threads.h"

namespace {
using namespace jarol;
using namespace jarol::tests::threads;
using tests::lines_of;

// A log that is kept in memory.
class KeptLog : public RecordSink, public TakenValues {
 public:
  explicit KeptLog(const Graph& graph) : inputs_(logged_inputs(graph)), outputs_(log_outputs(graph)) {}

  void take(Duration instant, std::uint32_t output, const void* value) override {
    if (output + 1 == outputs_.size()) {
      FAIL("no vehicle is brought to rest here");
    } else if (output + 2 == outputs_.size()) {
      digests.push_back(*static_cast<const RunningDigest*>(value));
    } else if (output + 3 == outputs_.size()) {
      misses.push_back(*static_cast<const Miss*>(value));
    } else {
      Value copy(*outputs_[output].type);
      copy_value(*outputs_[output].type, copy.data(), value);
      taken.push_back({instant, inputs_[output], std::move(copy)});
    }
  }
  void finish() override {}

  bool take(Duration instant, std::size_t communicator, void* value) override {
    if (next_ == taken.size() || taken[next_].instant != instant || taken[next_].communicator != communicator)
      return false;
    const Value& taken_value = taken[next_++].value;
    copy_value(*taken_value.type(), value, taken_value.data());
    return true;
  }
  bool is_at_end() const { return next_ == taken.size(); }

  struct Taken {
    Duration instant{};
    std::size_t communicator = 0;
    Value value;
  };
  std::vector<Taken> taken;
  std::vector<Miss> misses;
  std::vector<RunningDigest> digests;

 private:
  std::vector<std::size_t> inputs_;
  std::vector<Output> outputs_;
  std::size_t next_ = 0;
};

tests::Run replay(const Graph& graph, Duration end, std::vector<std::unique_ptr<ExternalSystem>> systems,
                  const std::vector<Miss>& misses) {
  tests::TraceLines lines(graph);
  Recorder recorder({&lines});
  Executor executor(graph, std::move(systems), {.recorder = &recorder, .misses = misses});
  executor.run_until(end);
  recorder.close();
  return {executor.report(), lines.lines};
}

std::vector<std::string> sorted_faults(const Report& report) {
  std::vector<std::string> texts;
  for (const Fault& fault : report.faults) texts.push_back(to_text(fault));
  return sorted(std::move(texts));
}

std::string first_difference(const std::vector<std::string>& is, const std::vector<std::string>& should) {
  for (std::size_t i = 0; i < std::max(is.size(), should.size()); ++i) {
    const std::string one = i < is.size() ? is[i] : "nothing", other = i < should.size() ? should[i] : "nothing";
    if (one != other) return "is " + one + ", should be " + other;
  }
  return "";
}

// How many misses there were.
std::size_t misses_replayed(const std::string& text, Duration end, bool has_outside) {
  const Graph graph = graph_of(text);
  KeptLog log(graph);
  Recorder recorder({&log});
  const RealRun real = run(text, end, 1, {}, 1,
                           has_outside ? tests::outside() : std::vector<std::unique_ptr<ExternalSystem>>{}, &recorder);
  recorder.close();
  const tests::Run again = replay(graph, real.report.covered, replayed_systems(graph, log), log.misses);
  CHECK(again.report.digest == real.report.digest);
  CHECK(first_difference(sorted(again.lines), sorted(real.lines)) == "");
  if (real.report.fault_count <= Report::faults_kept)
    CHECK(first_difference(sorted_faults(again.report), sorted_faults(real.report)) == "");
  CHECK(again.report.fault_count == real.report.fault_count);
  CHECK(again.report.stopped == real.report.stopped);
  CHECK(again.report.activations == real.report.activations);
  CHECK(again.report.instants == real.report.instants);
  CHECK(log.is_at_end());
  return log.misses.size();
}

const Mode every_mode[] = {table_1, table_2, priorities_1, priorities_2};
}  // namespace

TEST_SUITE("runtime/log") {
  TEST_CASE(
      "an activation that was late publishes nothing, and its state is as before; hold goes on, skip leaves one out") {
    const auto text = [](const std::string& on_fault, const std::string& let) {
      return "graph: t\ntasks: {a: {type: Faulty, period: 10ms, on_fault: " + on_fault + let +
             "}}\nconnections: [a.out -> a.in]\n";
    };
    const std::vector<Miss> misses{{.activation = 2, .ended_after = 12'000'000, .task = 0, .left_out = 0}};
    const tests::Run held = replay(graph_of(text("hold", ", let: 10ms")), 70ms, {}, misses);
    CHECK(lines_of(held, "a.out") ==
          "10ms a.out=999; 20ms a.out=2999; 40ms a.out=5999; 50ms a.out=9999; 60ms a.out=14999");
    CHECK(text_of(held.report.faults) ==
          "task 'a' activation 2 at 0.03 s: late: ended 12ms after its release, deadline 10ms\n");
    const tests::Run skipped = replay(graph_of(text("skip", ", let: 5ms")), 70ms, {}, misses);
    CHECK(lines_of(skipped, "a.out") ==
          "5ms a.out=999; 15ms a.out=2999; 45ms a.out=5999; 55ms a.out=9999; 65ms a.out=14999");
    CHECK(text_of(skipped.report.faults) ==
          "task 'a' activation 2 at 0.025 s: late: ended 12ms after its release, deadline 5ms\n");
  }

  TEST_CASE("one that was left out is the one that skip leaves out") {
    const Graph graph = graph_of(
        "graph: t\ntasks: {a: {type: Faulty, period: 10ms, on_fault: skip, let: 5ms}}\nconnections: [a.out -> a.in]\n");
    const tests::Run r = replay(graph, 60ms, {},
                                {{.activation = 1, .ended_after = -1, .task = 0, .left_out = 0},
                                 {.activation = 2, .ended_after = -1, .task = 0, .left_out = 1}});
    CHECK(lines_of(r, "a.out") == "5ms a.out=999; 35ms a.out=2999; 45ms a.out=5999; 55ms a.out=9999");
    CHECK(text_of(r.report.faults) ==
          "task 'a' activation 1 at 0.015 s: late: had not ended when it was due, deadline 5ms\n"
          "task 'a' activation 2 at 0.025 s: left out: an activation before it still ran at its release\n");
  }

  TEST_CASE("a run on the virtual clock is the same with what it took from outside") {
    const Graph graph = graph_of(R"(graph: t
timing: {period: 3ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.sensor, period: 1ms, timeout: 2ms}
  w: {channel: p.window}
  o: {channel: p.actuator, period: 1ms, safe: -1}
  mean: {type: double, direction: out}
tasks: {r: {type: Accumulate, period: 1ms}, m: {type: Mean}}
connections: [i -> r.in, r.out -> o, w -> m.in, m.out -> mean]
)");
    KeptLog log(graph);
    Recorder recorder({&log});
    tests::TraceLines lines(graph);
    Recorder trace({&lines});
    Executor executor(graph, tests::outside(), {.recorder = &trace, .log = &recorder});
    executor.run_until(500ms);
    trace.close();
    recorder.close();
    CHECK(executor.report().non_finite_inputs > 0);
    CHECK(log.taken.size() > 300);
    const tests::Run again = replay(graph, 500ms, replayed_systems(graph, log), {});
    CHECK(again.lines == lines.lines);
    CHECK(again.report.digest == executor.report().digest);
  }

  TEST_CASE("a run in real time gives its trace and its faults again, whatever was late and whoever ran the tasks") {
    for (const std::string on_fault : {"hold", "skip", "stop"})
      for (const Mode& mode : every_mode) {
        CAPTURE(on_fault);
        const std::string mode_name = mode.name;
        CAPTURE(mode_name);
        std::string text = R"(graph: t
timing: {period: 5ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.sensor, timeout: 10ms}
  o: {channel: p.actuator, offset: 2ms, safe: -1}
tasks:
  flow: {type: Faulty, core: ANY, on_fault: FAULT, parameters: {faulty: 4, lasts: 8ms}}
  timed: {type: Faulty, core: ANY, let: 4ms, on_fault: FAULT, parameters: {faulty: 6, lasts: 13ms}}
  throws: {type: Faulty, core: ANY, let: 5ms, on_fault: FAULT, parameters: {faulty: 7}}
  reader: {type: Sum, core: ANY, on_fault: FAULT}
connections: [i -> flow.in, flow.out -> timed.in, timed.out -> reader.a, flow.out -> reader.b, reader.out -> o, throws.out -> throws.in]
)";
        for (std::size_t at; (at = text.find("FAULT")) != std::string::npos;) text.replace(at, 5, on_fault);
        CHECK(misses_replayed(on(mode, text), 60ms, true) > 0);
      }
  }

  TEST_CASE("a running digest stands before the tasks on threads of which it is not known whether they are late") {
    // at 1 s `slow`, released at 0.8 s, still runs
    const std::string text = on(priorities_1, R"(graph: t
timing: {period: 400ms}
tasks:
  fast: {type: Counter, period: 100ms, on_fault: hold}
  slow: {type: Patient, on_fault: hold, parameters: {waits: 380ms}}
connections: [fast.out -> slow.in]
)");
    const Graph graph = graph_of(text);
    RunningDigest second;
    for (int attempt = 0; attempt < 10 && second.settled != 800'000'000; ++attempt) {  // again where it came too late
      KeptLog log(graph);
      Recorder recorder({&log});
      run(text, 1050ms, 1, {}, 1, {}, &recorder);
      recorder.close();
      REQUIRE(log.digests.size() == 2);
      CHECK(log.digests[0].settled == 0);
      CHECK(log.digests[0].exact == 1);
      second = log.digests[1];
    }
    CHECK(second.settled == 800'000'000);
    CHECK(second.exact == 0);
  }

  TEST_CASE("what was run before an external system was lost is run again") {
    // after so many instants it can't be reached any more
    class Lost : public tests::Outside {
     public:
      explicit Lost(int instants) : instants_(instants) {}
      void reach(Duration) override {
        if (instants_-- == 0) throw std::runtime_error("lost");
      }

     private:
      int instants_;
    };
    for (const Mode& mode : every_mode) {
      const std::string mode_name = mode.name;
      CAPTURE(mode_name);
      const Graph graph = graph_of(on(mode, R"(graph: t
timing: {period: 6ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators: {i: {channel: p.sensor, period: 2ms}, o: {channel: p.actuator, period: 2ms, offset: 1ms}}
tasks:
  a: {type: Accumulate, period: 2ms, core: ANY, on_fault: hold}
  b: {type: Accumulate, period: 2ms, core: ANY, let: 2ms, on_fault: hold}
  under_way: {type: Patient, core: ANY, on_fault: hold, parameters: {waits: 2ms}}
connections: [i -> a.in, a.out -> b.in, b.out -> o, a.out -> under_way.in]
)"));
      std::vector<std::unique_ptr<ExternalSystem>> systems;
      systems.push_back(std::make_unique<Lost>(7));
      KeptLog log(graph);
      Recorder recorder({&log});
      RealClock clock(graph.tasks.size());
      const std::vector<analysis::TaskThread> threads = analysis::threads_of(graph);
      Executor executor(graph, std::move(systems), {.clock = &clock, .threads = threads, .log = &recorder});
      clock.start();
      CHECK_THROWS_WITH_AS(executor.run_until(1s), "lost", std::runtime_error);
      recorder.close();
      const Report& real = executor.report();
      CHECK(real.instants == 7);
      CHECK(real.covered == 6ms + 1ns);
      const tests::Run again = replay(graph, real.covered, replayed_systems(graph, log), log.misses);
      CHECK(again.report.digest == real.digest);
      CHECK(again.report.activations == real.activations);
    }
  }

  TEST_CASE("random graphs that a machine can't always keep up with give again what they gave") {
    const std::uint64_t count = tests::how_many(10, 500, 5);
    std::size_t misses = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed)
      for (const Mode& mode : every_mode) {
        CAPTURE(seed);
        const std::string mode_name = mode.name;
        CAPTURE(mode_name);
        const std::string text = oracle::hurried_random_graph(seed);
        CAPTURE(text);
        misses += misses_replayed(on(mode, text), 2ms, false);
      }
    CHECK(misses > 0);
    MESSAGE(misses << " misses");
  }
}
