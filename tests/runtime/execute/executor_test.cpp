// In one file: sentences of the semantics, on the same few tasks.
#include "runtime/execute/executor.h"

#include <doctest/doctest.h>

#include <limits>

#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::graph_of;
using tests::lines_of;
using tests::run_graph;
using tests::run_text;

// An external system that writes down what happens to it, in its order.
class LineDiary : public ExternalSystem {
 public:
  explicit LineDiary(std::vector<std::string>& lines) : lines_(lines) {}
  void reach(Duration instant) override { lines_.push_back(duration_text(instant) + " reach"); }
  bool take(std::size_t channel, void* value) override {
    lines_.push_back("take " + std::to_string(channel));
    if (values.empty()) return false;
    *static_cast<double*>(value) = values.front();
    values.erase(values.begin());
    return true;
  }
  void hand_over(std::size_t channel, const void* value) override {
    lines_.push_back("hand over " + std::to_string(channel) + " " + number_text(*static_cast<const double*>(value)));
  }
  std::vector<double> values;

 private:
  std::vector<std::string>& lines_;
};

const Registry& registry_with_echo() {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    const Type* number = &type_of<double>();
    made.add(DistributerClass{"Echo",
                              "for tests",
                              {{"a", Direction::in, number, ""},
                               {"b", Direction::in, number, ""},
                               {"c", Direction::out, number, ""},
                               {"d", Direction::out, number, ""}}});
    return made;
  }();
  return registry;
}

Graph echo_graph(const std::string& text) { return tests::graph_of(registry_with_echo(), text); }

// More than a recorder's chunk holds.
struct Huge {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    std::array<double, 40'000> out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) { out.out.back() = static_cast<double>(tick.activation); }
};
}  // namespace

TEST_SUITE("runtime/executor") {
  TEST_CASE("activation k is released at offset + k period and sees that instant") {
    const auto run = run_text("{graph: t, tasks: {a: {type: Counter, period: 10ms, offset: 3ms}}}", 30ms);
    CHECK(lines_of(run, "a.out") == "3ms a.out=0; 13ms a.out=1; 23ms a.out=2");
    CHECK(run.report.activations == 3);
    CHECK(run.report.instants == 3);
  }

  TEST_CASE("a run covers the instants from 0 to before its end") {
    CHECK(run_text("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}", 20ms).report.activations == 2);
    CHECK(run_text("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}", 20ms + 1ns).report.activations == 3);
  }

  TEST_CASE("with a LET the outputs are published at release + LET, never earlier or later") {
    const auto run = run_text("{graph: t, tasks: {a: {type: Counter, period: 10ms, let: 4ms}}}", 24ms);
    CHECK(lines_of(run, "a.out") == "4ms a.out=0; 14ms a.out=1");
    CHECK(run.report.instants == 5);  // 0, 4, 10, 14, 20
  }

  TEST_CASE("with a LET equal to the period the outputs are published before the next release latches") {
    const auto run = run_text(R"(graph: t
timing: {period: 10ms}
tasks:
  a: {type: Counter, let: 10ms}
  b: {type: Relay}
connections: [a.out -> b.in]
)",
                              30ms);
    CHECK(lines_of(run, "b.out") == "0ns b.out=0; 10ms b.out=0; 20ms b.out=1");
  }

  TEST_CASE("a data-flow task publishes at its release, and tasks released then that it feeds latch the new value") {
    const auto run = run_text(R"(graph: t
timing: {period: 10ms}
tasks:
  z: {type: Counter}
  a: {type: Relay}
  l: {type: Relay, let: 5ms}
connections: [z.out -> a.in, z.out -> l.in]
)",
                              20ms);
    CHECK(lines_of(run, "a.out") == "0ns a.out=0; 10ms a.out=1");
    CHECK(lines_of(run, "l.out") == "5ms l.out=0; 15ms l.out=1");
  }

  TEST_CASE("data-flow order holds between tasks of different rates that meet") {
    const auto run = run_text(R"(graph: t
tasks:
  c: {type: Counter, period: 10ms}
  b: {type: Relay, period: 20ms}
  a: {type: Relay, period: 10ms}
connections: [c.out -> b.in, b.out -> a.in]
)",
                              40ms);
    CHECK(lines_of(run, "b.out") == "0ns b.out=0; 20ms b.out=2");
    CHECK(lines_of(run, "a.out") == "0ns a.out=0; 10ms a.out=0; 20ms a.out=2; 30ms a.out=2");
  }

  TEST_CASE("inputs are latched at the release: what is published during a LET does not reach the activation") {
    const auto run = run_text(R"(graph: t
tasks:
  c: {type: Counter, period: 1ms}
  l: {type: Relay, period: 4ms, let: 4ms}
connections: [c.out -> l.in]
)",
                              9ms);
    CHECK(lines_of(run, "l.out") == "4ms l.out=0; 8ms l.out=4");
  }

  TEST_CASE("until first published an output reads as its init, else as its default") {
    const auto run = run_text(R"(graph: t
timing: {period: 10ms}
tasks:
  a: {type: Counter, let: 10ms, init: {out: 7}}
  b: {type: Relay}
  c: {type: Counter, let: 10ms}
  d: {type: Relay}
connections: [a.out -> b.in, c.out -> d.in]
)",
                              10ms);
    CHECK(lines_of(run, "b.out") == "0ns b.out=7");
    CHECK(lines_of(run, "d.out") == "0ns d.out=0");
  }

  TEST_CASE("a LET task may feed itself") {
    const auto run = run_text(R"(graph: t
timing: {period: 10ms}
tasks:
  one: {type: Relay, let: 10ms, init: {out: 1}}
  sum: {type: Sum, let: 10ms}
connections: [one.out -> one.in, one.out -> sum.a, sum.out -> sum.b]
)",
                              40ms);
    CHECK(lines_of(run, "sum.out") == "10ms sum.out=1; 20ms sum.out=2; 30ms sum.out=3");
  }

  TEST_CASE("an `in` publishes its init, then the channel's newest value, else again the last one") {
    const Graph graph = echo_graph(R"(graph: t
timing: {period: 10ms}
distributers: {e: {type: Echo, link: {type: test}}}
communicators: {i: {channel: e.a, init: 5}}
tasks: {r: {type: Relay}}
connections: [i -> r.in]
)");
    std::vector<std::string> lines;
    auto diary = std::make_unique<LineDiary>(lines);
    std::vector<std::unique_ptr<ExternalSystem>> systems;
    SUBCASE("none ever came") {
      systems.push_back(std::move(diary));
      CHECK(lines_of(run_graph(graph, 20ms, std::move(systems)), "i") == "0ns i=5; 10ms i=5");
    }
    SUBCASE("one came") {
      diary->values = {8};
      systems.push_back(std::move(diary));
      CHECK(lines_of(run_graph(graph, 20ms, std::move(systems)), "i") == "0ns i=8; 10ms i=8");
    }
    SUBCASE("a value that is not finite is counted and not taken") {
      diary->values = {8, std::numeric_limits<double>::quiet_NaN(), 9};
      systems.push_back(std::move(diary));
      const auto run = run_graph(graph, 30ms, std::move(systems));
      CHECK(lines_of(run, "i") == "0ns i=8; 10ms i=8; 20ms i=9");
      CHECK(run.report.non_finite_inputs == 1);
    }
  }

  TEST_CASE("inside one instant: the outside arrives, LETs end, outs act, ins act, tasks run") {
    const Graph graph = echo_graph(R"(graph: t
timing: {period: 10ms}
distributers: {e: {type: Echo, link: {type: test}}}
communicators:
  o2: {channel: e.c}
  o1: {channel: e.d}
  i2: {channel: e.a}
  i1: {channel: e.b}
tasks:
  l: {type: Counter, let: 10ms, init: {out: -1}}
  d: {type: Counter, init: {out: -2}}
  r: {type: Sum}
connections: [l.out -> o1, d.out -> o2, i1 -> r.a, i2 -> r.b]
)");
    std::vector<std::string> lines;
    std::vector<std::unique_ptr<ExternalSystem>> systems;
    systems.push_back(std::make_unique<LineDiary>(lines));
    const auto run = run_graph(graph, 20ms, std::move(systems));
    // o1 hands over the LET output that ends at 10 ms; o2 what the data-flow task published one period before
    CHECK(lines == std::vector<std::string>{"0ns reach", "hand over 3 -1", "hand over 2 -2", "take 1", "take 0",
                                            "10ms reach", "hand over 3 0", "hand over 2 0", "take 1", "take 0"});
    CHECK(run.lines == std::vector<std::string>{"0ns o1=-1", "0ns o2=-2", "0ns i1=0", "0ns i2=0", "0ns d.out=0",
                                                "0ns r.out=0", "10ms l.out=0", "10ms o1=0", "10ms o2=0", "10ms i1=0",
                                                "10ms i2=0", "10ms d.out=1", "10ms r.out=0"});
  }

  TEST_CASE("communicators of one step act in order of name, whatever their periods") {
    const Graph graph = echo_graph(R"(graph: t
timing: {period: 40ms}
distributers: {e: {type: Echo, link: {type: test}}}
communicators:
  o1: {channel: e.d, period: 40ms}
  o2: {channel: e.c, period: 20ms}
  i1: {channel: e.b, period: 40ms}
  i2: {channel: e.a, period: 20ms}
connections: [i1 -> o1, i2 -> o2]
)");
    std::vector<std::string> lines;
    std::vector<std::unique_ptr<ExternalSystem>> systems;
    systems.push_back(std::make_unique<LineDiary>(lines));
    run_graph(graph, 21ms, std::move(systems));
    CHECK(lines == std::vector<std::string>{"0ns reach", "hand over 3 0", "hand over 2 0", "take 1", "take 0",
                                            "20ms reach", "hand over 2 0", "take 0"});
  }

  TEST_CASE("an `out` hands over what a LET that ends at that instant publishes") {
    const auto run = run_graph(graph_of(R"(graph: t
timing: {period: 10ms}
communicators:
  from_let: {type: double, direction: out}
tasks:
  l: {type: Counter, let: 10ms, init: {out: 5}}
connections: [l.out -> from_let]
)"),
                               20ms);
    CHECK(lines_of(run, "from_let") == "0ns from_let=5; 10ms from_let=0");
  }

  TEST_CASE("a task latches at its release what an `in` publishes then and what a LET publishes then") {
    const auto run = run_text(R"(graph: t
timing: {period: 10ms}
tasks:
  l: {type: Counter, let: 10ms, init: {out: 5}}
  r: {type: Relay}
  slow: {type: Relay, let: 10ms}
connections: [l.out -> r.in, l.out -> slow.in]
)",
                              30ms);
    CHECK(lines_of(run, "r.out") == "0ns r.out=5; 10ms r.out=0; 20ms r.out=1");  // one output, two readers
    CHECK(lines_of(run, "slow.out") == "10ms slow.out=5; 20ms slow.out=0");
  }

  TEST_CASE("a run in pieces is the same run") {
    const Graph graph = graph_of(R"(graph: t
tasks:
  c: {type: Counter, period: 3ms}
  l: {type: Relay, period: 5ms, let: 4ms}
  s: {type: Accumulate, period: 7ms, offset: 1ms}
connections: [c.out -> l.in, l.out -> s.in]
)");
    Executor whole(graph, {}), pieces(graph, {});
    whole.run_until(1s);
    for (const Duration cut : {1ns, 3000000ns, 10000000ns, 10000001ns, 999999999ns, 1000000000ns})
      pieces.run_until(cut);
    CHECK(pieces.report().digest == whole.report().digest);
    CHECK(pieces.report().activations == whole.report().activations);
    CHECK(pieces.report().instants == whole.report().instants);
  }

  TEST_CASE("periods without a common multiple cost no more than others") {
    // least common multiple: about 10^24 ns
    const auto run = run_text(R"(graph: t
tasks:
  a: {type: Counter, period: 1000003ns}
  b: {type: Relay, period: 999983ns}
  c: {type: Relay, period: 999979ns, let: 999979ns}
  d: {type: Relay, period: 1000033ns}
connections: [a.out -> b.in, b.out -> c.in, c.out -> d.in]
)",
                              1s);
    CHECK(run.report.activations == 4002);
  }

  TEST_CASE("a value of any size is handed to who looks on, whole") {
    Registry registry;
    registry.add(task_class<Huge>());
    const Graph graph = tests::graph_of(registry, "{graph: t, tasks: {h: {type: Huge, period: 1ms}}}");
    struct Last : RecordSink {
      void take(Duration, std::uint32_t, const void* value) override {
        got.push_back(static_cast<const std::array<double, 40'000>*>(value)->back());
      }
      void finish() override {}
      std::vector<double> got;
    } sink;
    Recorder recorder({&sink});
    Executor executor(graph, {}, {.digest = true, .recorder = &recorder});
    executor.run_until(3ms);
    recorder.close();
    CHECK(sink.got == std::vector<double>{0, 1, 2});
  }

  TEST_CASE("the digest is the sum of one hash per publication") {
    const auto run = run_text("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}", 20ms);
    std::uint64_t expected = 0;
    for (std::int64_t k = 0; k < 2; ++k) {
      digest::Words words;
      words.add(std::bit_cast<std::uint64_t>(static_cast<double>(k)));
      expected += digest::publication(digest::name_hash("a.out"), digest::instant_term(k * 10'000'000), words.sum());
    }
    CHECK(run.report.digest == expected);
  }
}
