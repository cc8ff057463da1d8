#include <doctest/doctest.h>

#include "graph/expect/parse.h"
#include "runtime/execute/executor.h"
#include "runtime/execute/expectations.h"
#include "tests/graph/graph_of.h"
#include "tests/graph/plant_registry.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Truth {
  double place = 0;
  static constexpr auto fields() { return describe(field<&Truth::place>("m")); }
};

// A vehicle that goes one metre a second.
class Going : public ExternalSystem {
 public:
  const Type* true_type() const override { return &type_of<Truth>(); }
  void copy_true_values(void* to) const override {
    static_cast<Truth*>(to)->place = std::chrono::duration<double>(now_).count();
  }
  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t, void* value) override {
    *static_cast<double*>(value) = 1;
    return true;
  }
  void hand_over(std::size_t, const void*) override {}

 private:
  Duration now_{};
};

// A counter that shows 0 to 9, each for 10 ms, its sum after 5 ms, and the vehicle.
const char* const text = R"(
graph: t
timing: {period: 20ms}
distributers:
  boat: {type: Plant, link: {type: test}}
communicators:
  sensor: {channel: boat.sensor}
tasks:
  count: {type: Counter, period: 10ms}
  sum: {type: Accumulate, period: 10ms, let: 5ms}
  gain: {type: Relay}
connections:
  - count.out -> sum.in
  - sensor -> gain.in
)";

std::vector<Verdict> judge(const std::vector<std::string>& conditions, Duration end = 100ms,
                           const std::string& cut_short = "", std::size_t workers = 1) {
  std::string all = text;
  all += "expect:\n";
  for (const std::string& condition : conditions) all += "  - " + condition + "\n";
  Problems problems;
  const GraphSpec spec = load_spec(std::make_shared<Source>(Source{"t.yaml", all}), {}, problems);
  Graph graph = build_graph(spec, tests::plant_registry(), problems);
  graph.expectations =
      expect::read_expectations(spec.expect, graph, {{expect::TrueValues::Where::here, &type_of<Truth>()}}, problems);
  problems.throw_if_any();
  Expectations expectations(graph, outputs_of(graph), graph.expectations);
  Recorder recorder({&expectations});
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<Going>());
  Executor executor(graph, std::move(systems),
                    {.recorder = &recorder, .record_truth = true, .workers = workers, .sharing = Sharing::always});
  executor.run_until(end / 2);
  executor.run_until(end);
  recorder.close();
  return expectations.judge(executor.report().covered, cut_short);
}

std::string words(const std::vector<Verdict>& verdicts) {
  std::string all;
  for (const Verdict& v : verdicts) {
    const char* const outcome = v.outcome == Verdict::Outcome::holds   ? "holds "
                                : v.outcome == Verdict::Outcome::fails ? "fails "
                                                                       : "not judged ";
    all += outcome + (v.outcome == Verdict::Outcome::holds ? v.reached_text : v.why) + "\n";
  }
  return all;
}

TEST_SUITE("runtime/expectations") {
  TEST_CASE("a run is judged by what it published, with the value that was reached") {
    for (const std::size_t workers : {1, 4})
      CHECK(words(judge({"count.out within 0 of 9", "count.out within 0 of 8", "max(count.out) < 9",
                         "max(count.out) before 50ms < 4.5", "mean(count.out) within 0.001 of 4.5", "min(sum.out) >= 1",
                         "sum.out within 0 of 45", "final(count.out) before 35ms within 0 of 3",
                         "max(abs(count.out - 4.5)) <= 4.5"},
                        100ms, "", workers)) ==
            "holds 9\nfails reached 9\nfails reached 9\nholds 4\nholds 4.5\nfails reached 0\nholds 45\nholds 3\n"
            "holds 4.5\n");
  }

  TEST_CASE("always, never and once say when") {
    CHECK(words(judge({"always count.out < 10", "always count.out < 5", "never count.out within 0 of 7",
                       "once count.out within 0 of 7", "once count.out > 20",
                       "never count.out within 0 of 7 before 60ms"})) ==
          "holds \nfails was not so at 0.05 s: 5\nfails was so at 0.07 s: 7\nholds at 0.07 s: 7\nfails was not "
          "so\nholds \n");
  }

  TEST_CASE("two values are compared at every instant at which one of them changes") {
    // the sum is 5 ms behind
    CHECK(words(judge({"max(sum.out - count.out) within 0.001 of 36",
                       "min(sum.out - count.out) within 0.001 of -1"})) == "holds 36\nholds -1\n");
  }

  TEST_CASE("true values are those of the instants at which the vehicle is met") {
    CHECK(words(judge({"place of boat within 1mm of 8cm", "max(place of boat) after 30ms < 5cm",
                       "always gain.out < 2"})) == "holds 0.08 m\nfails reached 0.08 m\nholds \n");
  }

  TEST_CASE("a run that is cut short is judged by what can't be mended any more alone") {
    CHECK(words(judge(
              {"count.out within 0 of 9", "max(count.out) < 5", "max(count.out) < 20", "never count.out within 0 of 3",
               "once count.out within 0 of 3", "always count.out < 20", "min(count.out) > 1"},
              100ms, "cut short")) ==
          "not judged cut short\nfails reached 9\nnot judged cut short\nfails was so at 0.03 s: 3\nholds at 0.03 s: 3\n"
          "not judged cut short\nfails reached 0\n");
    CHECK(words(judge({"count.out < 5 after 1s"}, 100ms, "cut short")) ==
          "not judged the run ended at 0.1 s, before 1 s\n");
  }

  TEST_CASE("a window that is over is judged, however much is cut off behind it") {
    CHECK(words(judge({"count.out within 0 of 4 before 50ms", "count.out within 0 of 5 before 50ms",
                       "mean(count.out) within 0.01 of 2 before 50ms", "always count.out < 9 between 10ms and 100ms",
                       "once count.out > 20 before 60ms", "count.out < 5 before 110ms"},
                      100ms, "cut short")) ==
          "holds 4\nfails reached 4\nholds 2\nfails was not so at 0.09 s: 9\nfails was not so\nnot judged cut short\n");
  }

  TEST_CASE("a window that has not begun when the run ends that was not cut short fails") {
    for (const std::string condition :
         {"count.out < 5", "always count.out < 5", "never count.out < 5", "once count.out < 5"})
      CHECK(words(judge({condition + " after 100ms"})) ==
            "fails was never looked at: the run ended at 0.1 s, before 0.1 s\n");
    CHECK(words(judge({"count.out within 0 of 9 after 99ms"})) == "holds 9\n");
  }

  TEST_CASE("rise, overshoot and settling are those of the step from the first value") {
    CHECK(words(judge({"rise_time(count.out to 9) within 1ms of 80ms", "overshoot(count.out to 7) <= 2",
                       "settling_time(count.out to 9 within 1) within 1ms of 80ms", "rise_time(count.out to 20) < 1s",
                       "settling_time(count.out to 3 within 1) < 1s"})) ==
          "holds 0.08 s\nholds 2\nholds 0.08 s\nfails did not rise to 90 % of the step\nfails had not settled\n");
  }
}
}  // namespace
