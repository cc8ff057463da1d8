#include "graph/analysis/time_table.h"

#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "graph/analysis/validate_table.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace jarol::analysis;
using namespace std::chrono_literals;

CoreResult table_of(const std::string& text, std::uint64_t max) {
  const System system = system_of(tests::graph_of(text));
  Budget budget;
  return check_table(system, std::vector<std::size_t>(system.models.size(), 0), true, budget, max);
}
}  // namespace

TEST_SUITE("graph/analysis/time_table") {
  TEST_CASE("a table is looked at once more, and everything that could be wrong with one is found") {
    const System system = system_of(tests::graph_of(R"(graph: t
timing: {period: 10ns}
tasks:
  a: {type: Counter, wcet: 2ns}
  b: {type: Relay, wcet: 3ns, deadline: 8ns}
connections: [a.out -> b.in]
)"));
    const std::vector<Slice> good{{0, 0, 0ns, 2ns}, {1, 0, 2ns, 5ns}, {0, 1, 10ns, 12ns}, {1, 1, 12ns, 15ns}};
    const std::vector<std::size_t> one{0, 0}, two{0, 1};
    CHECK(fault_of_table(system, one, good, 20ns, 10ns) == "");
    const auto with = [&](std::size_t i, Slice slice) {
      std::vector<Slice> changed = good;
      changed[i] = slice;
      return changed;
    };
    CHECK(fault_of_table(system, one, with(3, {1, 0, 12ns, 15ns}), 20ns, 10ns) == "task 1 activation 0 stands twice");
    CHECK(fault_of_table(system, one, {good[0], good[1], good[2]}, 20ns, 10ns) == "task 1 activation 1 is missing");
    CHECK(fault_of_table(system, one, with(1, {1, 0, 2ns, 4ns}), 20ns, 10ns) == "task 1 activation 0 is cut short");
    CHECK(fault_of_table(system, one, with(2, {0, 1, 9ns, 12ns}), 20ns, 10ns) ==
          "task 0 activation 1 begins before its release");
    CHECK(fault_of_table(system, one, with(1, {1, 0, 6ns, 9ns}), 20ns, 10ns) ==
          "task 1 activation 0 ends after its deadline");
    CHECK(fault_of_table(system, two, with(1, {1, 0, 1ns, 4ns}), 20ns, 10ns) ==
          "task 1 activation 0 begins before the one that it follows has ended");
    System apart = system;
    apart.follows.clear();
    CHECK(fault_of_table(apart, one, with(1, {1, 0, 1ns, 4ns}), 20ns, 10ns) ==
          "task 1 activation 0 begins while another runs on its core");
    CHECK(fault_of_table(apart, two, with(1, {1, 0, 1ns, 4ns}), 20ns, 10ns) == "");
  }

  using tests::graph_of;

  TEST_CASE("tasks released together take their turns as they are run: by deadline, not by period or name") {
    CHECK(check(graph_of(R"(graph: t
tasks:
  b: {type: Counter, period: 400ms, let: 45ms, wcet: 30ms}
  a: {type: Counter, period: 200ms, let: 200ms, wcet: 80ms}
)"))
              .verdict == Verdict::schedulable);
    const Result r = check(graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 200ms, let: 45ms, wcet: 30ms}
  b: {type: Counter, period: 400ms, let: 40ms, wcet: 20ms}
)"));
    CHECK(r.verdict == Verdict::not_schedulable);
    REQUIRE(r.late);
    CHECK(r.late->task == 0);
    CHECK(r.late->finish == 50ms);
  }

  TEST_CASE("tasks that fit are schedulable, and their responses are reported") {
    const Result r = check(graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 10ms, wcet: 2ms}
  b: {type: Counter, period: 20ms, wcet: 5ms}
)"));
    CHECK(r.verdict == Verdict::schedulable);
    CHECK(r.reason == "every job of the time table ends by its deadline");
    CHECK(r.utilisation == doctest::Approx(0.45));
    CHECK(r.response[0] == 2ms);
    CHECK(r.response[1] == 7ms);
  }

  TEST_CASE("the first late job is named with its times") {
    const Result r = check(graph_of(R"(graph: t
tasks:
  long:  {type: Counter, period: 40ms, wcet: 19ms}
  short: {type: Counter, period: 10ms, wcet: 2ms}
)"));
    CHECK(r.verdict == Verdict::not_schedulable);
    REQUIRE(r.late.has_value());
    CHECK(r.late->task == 1);
    CHECK(r.late->activation == 1);
    CHECK(r.late->release == 10ms);
    CHECK(r.late->finish == 23ms);
    CHECK(r.late->deadline == 20ms);
  }

  TEST_CASE("more than the whole core is never schedulable, by however little") {
    const char* text = R"(graph: t
tasks:
  a: {type: Counter, period: 1s, wcet: 500ms}
  b: {type: Counter, period: 1s, wcet: %s}
)";
    std::string exact(text), over(text);
    exact.replace(exact.find("%s"), 2, "500ms");
    over.replace(over.find("%s"), 2, "500.000001ms");
    CHECK(check(graph_of(exact)).verdict == Verdict::schedulable);
    CHECK(check(graph_of(over)).verdict == Verdict::not_schedulable);
  }

  TEST_CASE("overload that shows only after the table's reach is found by exact utilisation") {
    const CoreResult r = table_of(R"(graph: t
tasks:
  a: {type: Counter, period: 999983ns, wcet: 500000ns}
  b: {type: Counter, period: 999979ns, wcet: 500000ns}
)",
                                  10);
    CHECK(r.verdict == Verdict::not_schedulable);
    CHECK(r.reason == "the tasks need more than the whole core");
  }

  TEST_CASE("a task without a wcet leaves the verdict open and is named") {
    const Result r = check(graph_of("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}"));
    CHECK(r.verdict == Verdict::unknown);
    CHECK(r.reason == "no 'wcet' is stated for 'a'");
  }

  TEST_CASE("a table of too many jobs leaves the verdict open and says so") {
    const CoreResult r = table_of(R"(graph: t
tasks:
  a: {type: Counter, period: 999983ns, wcet: 400us}
  b: {type: Counter, period: 999979ns, wcet: 400us, deadline: 799us}
)",
                                  1000);
    CHECK(r.verdict == Verdict::unknown);
    CHECK(r.reason == "the periods repeat only after more than 1000 activations, and none of these is late");
  }

  TEST_CASE("where a table repeats soon, but only after large offsets, that is the reason why it stays open") {
    const CoreResult r = table_of(R"(graph: t
tasks:
  a: {type: Counter, period: 1us, let: 1us, wcet: 100ns}
  b: {type: Counter, period: 400us, offset: 900ns, let: 400us, wcet: 550ns}
  c: {type: Counter, period: 400us, offset: 200900ns, let: 400us, wcet: 550ns}
)",
                                  500);
    CHECK(r.verdict == Verdict::unknown);
    CHECK(r.reason ==
          "all that the offsets lead to is seen to repeat only after more than 500 activations, and none of these is "
          "late");
  }

  TEST_CASE("what lasts decades beside what comes each second is late, and no time overflows on the way") {
    const Result r = check(graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 87600h, wcet: 87600h, jitter: 87600h}
  b: {type: Work, period: 87600h, offset: 87599h, wcet: 1h, blocking: 87600h}
  c: {type: Work, period: 1s, wcet: 87600h, blocking: 87600h, jitter: 87600h}
)"));
    CHECK(r.verdict == Verdict::not_schedulable);
    CHECK(r.evidence == Evidence::proof);
    REQUIRE(r.late);
    CHECK(r.late->finish > r.late->deadline);
  }

  TEST_CASE("periods that never repeat are judged by what stands before each task, with its jitter and blocking") {
    const std::string text = R"(graph: t
tasks:
  a: {type: Counter, period: 1000003ns, wcet: 100us, jitter: 50us}
  b: {type: Work, period: 1000033ns, wcet: 200us, blocking: 20us, deadline: %s}
  c: {type: Work, period: 1000037ns, wcet: 1us}
)";
    // 50 us late, then a and c, then b with what holds it up
    const auto with = [&](const std::string& deadline) {
      std::string changed = text;
      return check(graph_of(changed.replace(changed.find("%s"), 2, deadline)));
    };
    const Result yes = with("371us");
    CHECK(yes.verdict == Verdict::schedulable);
    CHECK(yes.evidence == Evidence::safe);
    CHECK(yes.response[1] == 370'999ns);  // c at the same instant comes after it
    CHECK(with("319us").verdict == Verdict::not_schedulable);
  }
}
