// What an activation sees: its release as its time, its inputs as they were then, whole and its own.
#include <doctest/doctest.h>

#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

// What it gets of time.
struct Watch {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    std::int64_t now = -1, activation = -1, period = -1;
    static constexpr auto fields() {
      return describe(field<&Out::now>(), field<&Out::activation>(), field<&Out::period>());
    }
  };
  static void run(const Tick& tick, Out& out) { out = {tick.now.count(), tick.activation, tick.period.count()}; }
};

// Texts that change in number and length: at activation k, k of them, each its number repeated.
struct Texts {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    Sequence<String> out{"first"};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) {
    out.out.clear();
    for (std::int64_t i = 0; i < tick.activation; ++i) {
      String text;
      for (std::int64_t k = 0; k <= i; ++k) text += std::to_string(tick.activation);
      out.out.push_back(text);
    }
  }
};

// Passes on, and keeps what it got before.
struct Pass {
  static constexpr std::string_view summary = "for tests";
  struct In {
    Sequence<String> in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    Sequence<String> before{};
    static constexpr auto fields() { return describe(field<&State::before>()); }
  };
  struct Out {
    Sequence<String> now{}, before{};
    static constexpr auto fields() { return describe(field<&Out::now>(), field<&Out::before>()); }
  };
  static void run(const Tick&, const In& in, State& state, Out& out) {
    out.now = in.in;
    out.before = state.before;
    state.before = in.in;
  }
};

tests::Run run_latching(const std::string& text, Duration end) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Watch>());
    made.add(task_class<Texts>());
    made.add(task_class<Pass>());
    return made;
  }();
  const Graph graph = tests::graph_of(registry, "graph: t\n" + text);
  return tests::run_graph(graph, end);
}
}  // namespace

TEST_SUITE("runtime/latching") {
  TEST_CASE("logical time counts nanoseconds from the start, and an activation sees its release as its time") {
    const auto watch = [](const std::string& let) {
      return run_latching("tasks: {w: {type: Watch, period: 10ns, offset: 7ns" + let + "}}\n", 30ns);
    };
    CHECK(lines_of(watch(""), "w.now") == "7ns w.now=7; 17ns w.now=17; 27ns w.now=27");
    CHECK(lines_of(watch(", let: 3ns"), "w.now") == "10ns w.now=7; 20ns w.now=17");
    CHECK(lines_of(watch(", let: 10ns"), "w.now") == "17ns w.now=7; 27ns w.now=17");
    CHECK(lines_of(watch(", let: 10ns"), "w.activation") == "17ns w.activation=0; 27ns w.activation=1");
    CHECK(lines_of(watch(""), "w.period") == "7ns w.period=10; 17ns w.period=10; 27ns w.period=10");
    // a year and one nanosecond later still to the nanosecond
    const auto late = run_latching("tasks: {w: {type: Watch, period: 8761h, offset: 31536000000000001ns}}\n", 8761h);
    CHECK(lines_of(late, "w.now") == "31536000.000000001s w.now=31536000000000001");
  }

  TEST_CASE("deep inputs are latched at the release: what is published during a LET does not reach the activation") {
    const auto r = run_latching(R"(tasks:
  n: {type: Texts, period: 1ms}
  p: {type: Pass, period: 4ms, let: 4ms}
  q: {type: Pass, period: 4ms, offset: 2ms, let: 3ms}
connections: [n.out -> p.in, n.out -> q.in]
)",
                                11ms);
    CHECK(lines_of(r, "p.now") == R"(4ms p.now=[]; 8ms p.now=["4","44","444","4444"])");
    CHECK(lines_of(r, "p.before") == "4ms p.before=[]; 8ms p.before=[]");
    CHECK(lines_of(r, "q.now") == R"(5ms q.now=["2","22"]; 9ms q.now=["6","66","666","6666","66666","666666"])");
    CHECK(lines_of(r, "q.before") == R"(5ms q.before=[]; 9ms q.before=["2","22"])");
  }

  TEST_CASE("a deep value that is on its way stays what it was, however often its writer and its readers run on") {
    const auto r = run_latching(R"(tasks:
  n: {type: Texts, period: 2ms, let: 2ms}
  p: {type: Pass, period: 6ms, let: 5ms}
  last: {type: Pass, period: 3ms}
connections: [n.out -> p.in, p.now -> last.in]
)",
                                13ms);
    CHECK(lines_of(r, "p.now") == R"(5ms p.now=["first"]; 11ms p.now=["2","22"])");
    CHECK(lines_of(r, "last.now") == R"(0ns last.now=[]; 3ms last.now=[]; 6ms last.now=["first"]; )"
                                     R"(9ms last.now=["first"]; 12ms last.now=["2","22"])");
    CHECK(lines_of(r, "last.before") == R"(0ns last.before=[]; 3ms last.before=[]; 6ms last.before=[]; )"
                                        R"(9ms last.before=["first"]; 12ms last.before=["first"])");
  }

  TEST_CASE("until first published an output reads as its init, else as its default in Out, deep ones too") {
    const auto r = run_latching(R"(timing: {period: 4ms}
tasks:
  default: {type: Texts, let: 4ms}
  given: {type: Texts, let: 4ms, init: {out: [a, bc]}}
  p: {type: Pass}
  q: {type: Pass}
connections: [default.out -> p.in, given.out -> q.in]
)",
                                8ms);
    CHECK(lines_of(r, "p.now") == R"(0ns p.now=["first"]; 4ms p.now=[])");
    CHECK(lines_of(r, "q.now") == R"(0ns q.now=["a","bc"]; 4ms q.now=[])");
  }

  TEST_CASE("each reader has a copy of its own: what one keeps of it is not what another sees later") {
    const auto r = run_latching(R"(tasks:
  n: {type: Texts, period: 1ms}
  seldom: {type: Pass, period: 3ms, offset: 1ms}
  often: {type: Pass, period: 1ms}
connections: [n.out -> seldom.in, n.out -> often.in]
)",
                                6ms);
    CHECK(lines_of(r, "seldom.now") == R"(1ms seldom.now=["1"]; 4ms seldom.now=["4","44","444","4444"])");
    CHECK(lines_of(r, "seldom.before") == R"(1ms seldom.before=[]; 4ms seldom.before=["1"])");
    CHECK(lines_of(r, "often.before") == R"(0ns often.before=[]; 1ms often.before=[]; 2ms often.before=["1"]; )"
                                         R"(3ms often.before=["2","22"]; 4ms often.before=["3","33","333"]; )"
                                         R"(5ms often.before=["4","44","444","4444"])");
  }
}
