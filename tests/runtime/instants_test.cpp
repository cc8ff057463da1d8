// What happens at one instant, pair by pair of its steps, and in which order it is reported.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "tests/runtime/random_model.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

// A plant that senses at each instant what it held before it, and the instant itself in ms.
class Plant : public ExternalSystem {
 public:
  explicit Plant(std::vector<std::string>* diary = nullptr) : diary_(diary) {}
  void reach(Duration instant) override {
    sensed_ = held_;
    ms_ = static_cast<double>(instant / 1ms);
  }
  bool take(std::size_t channel, void* value) override {
    if (diary_ != nullptr) diary_->push_back("take " + std::to_string(channel));
    *static_cast<double*>(value) = channel == 0 ? sensed_ : ms_;
    return true;
  }
  void hand_over(std::size_t channel, const void* value) override {
    if (diary_ != nullptr) diary_->push_back("hand over " + std::to_string(channel));
    held_ = *static_cast<const double*>(value);
  }

 private:
  double held_ = -1, sensed_ = -2, ms_ = -3;
  std::vector<std::string>* diary_;
};

tests::Run run_plant(const std::string& text, Duration end, std::vector<std::string>* diary = nullptr) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    const Type* number = &type_of<double>();
    const std::vector<ChannelClass> channels{{"held", Direction::in, number, ""},
                                             {"ms", Direction::in, number, ""},
                                             {"command", Direction::out, number, ""},
                                             {"command2", Direction::out, number, ""},
                                             {"command3", Direction::out, number, ""}};
    made.add(DistributerClass{"Plant", "for tests", channels});
    return made;
  }();
  const Graph graph =
      tests::graph_of(registry, "graph: t\ntiming: {period: 10ms}\n" +
                                    std::string("distributers: {p: {type: Plant, link: {type: test}}}\n") + text);
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<Plant>(diary));
  return tests::run_graph(graph, end, std::move(systems));
}
}  // namespace

TEST_SUITE("runtime/instants") {
  TEST_CASE("sensors sample before outs act: a command at an instant does not change what is sensed at it") {
    const auto r = run_plant(R"(communicators: {to: {channel: p.command}, from: {channel: p.held}}
tasks: {c: {type: Counter, init: {out: 7}}, r: {type: Relay}}
connections: [c.out -> to, from -> r.in]
)",
                             40ms);
    CHECK(lines_of(r, "to") == "0ns to=7; 10ms to=0; 20ms to=1; 30ms to=2");
    CHECK(lines_of(r, "from") == "0ns from=-1; 10ms from=7; 20ms from=0; 30ms from=1");
  }

  TEST_CASE("sensors sample before ins act: what is sensed at an instant is taken at it") {
    const auto r = run_plant(R"(communicators: {from: {channel: p.ms}}
tasks: {r: {type: Relay}}
connections: [from -> r.in]
)",
                             30ms);
    CHECK(lines_of(r, "from") == "0ns from=0; 10ms from=10; 20ms from=20");
  }

  TEST_CASE("LETs end before outs act: what is published at an instant is handed over at it") {
    const auto r = run_plant(R"(communicators: {to: {channel: p.command, offset: 4ms}}
tasks: {c: {type: Counter, let: 4ms, init: {out: 7}}}
connections: [c.out -> to]
)",
                             30ms);
    CHECK(lines_of(r, "to") == "4ms to=0; 14ms to=1; 24ms to=2");
  }

  TEST_CASE("LETs end before tasks latch: one that ends at an instant is read at it, with a LET or without") {
    const auto r = run_plant(R"(tasks:
  c: {type: Counter, let: 4ms, init: {out: 7}}
  flow: {type: Relay, offset: 4ms}
  timed: {type: Relay, offset: 4ms, let: 1ms}
connections: [c.out -> flow.in, c.out -> timed.in]
)",
                             20ms);
    CHECK(lines_of(r, "flow.out") == "4ms flow.out=0; 14ms flow.out=1");
    CHECK(lines_of(r, "timed.out") == "5ms timed.out=0; 15ms timed.out=1");
  }

  TEST_CASE("outs act before ins: an out that is fed by an in hands over what that published before") {
    const auto r = run_plant(R"(communicators: {to: {channel: p.command}, from: {channel: p.ms, init: 7}}
connections: [from -> to]
)",
                             30ms);
    CHECK(lines_of(r, "to") == "0ns to=7; 10ms to=0; 20ms to=10");
    CHECK(lines_of(r, "from") == "0ns from=0; 10ms from=10; 20ms from=20");
  }

  TEST_CASE("outs act before tasks run: an out hands over what a data-flow task published before") {
    const auto r = run_plant(R"(communicators: {to: {channel: p.command}}
tasks: {c: {type: Counter, init: {out: 7}}}
connections: [c.out -> to]
)",
                             30ms);
    CHECK(lines_of(r, "to") == "0ns to=7; 10ms to=0; 20ms to=1");
  }

  TEST_CASE("ins act before tasks latch: what is taken at an instant is read at it, with a LET or without") {
    const auto r = run_plant(R"(communicators: {from: {channel: p.ms, init: 7}}
tasks:
  flow: {type: Relay}
  timed: {type: Relay, let: 1ms}
connections: [from -> flow.in, from -> timed.in]
)",
                             30ms);
    CHECK(lines_of(r, "flow.out") == "0ns flow.out=0; 10ms flow.out=10; 20ms flow.out=20");
    CHECK(lines_of(r, "timed.out") == "1ms timed.out=0; 11ms timed.out=10; 21ms timed.out=20");
  }

  TEST_CASE("communicators act at offset + k period") {
    const auto r = run_plant(R"(communicators:
  to: {channel: p.command, period: 5ms, offset: 2ms}
  from: {channel: p.ms, offset: 9999999ns}
tasks: {c: {type: Counter, period: 5ms, init: {out: 7}}, r: {type: Relay}}
connections: [c.out -> to, from -> r.in]
)",
                             20ms);
    CHECK(lines_of(r, "to") == "2ms to=0; 7ms to=1; 12ms to=2; 17ms to=3");
    CHECK(lines_of(r, "from") == "9.999999ms from=9; 19.999999ms from=19");
  }

  TEST_CASE("communicators of one step act in bytewise order of name: capitals, underscores, small letters") {
    std::vector<std::string> diary;
    run_plant(R"(communicators:
  a: {channel: p.command3}
  Z: {channel: p.command}
  _b: {channel: p.command2}
  y: {channel: p.ms}
  B: {channel: p.held}
connections: [y -> a, B -> Z, B -> _b]
)",
              10ms, &diary);
    CHECK(diary == std::vector<std::string>{"hand over 2", "hand over 3", "hand over 4", "take 0", "take 1"});
  }

  TEST_CASE("an output publishes at most once at an instant, and instants come in their order") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const Graph graph = tests::graph_of(oracle::to_yaml(oracle::random_model(seed), seed));
      struct Once : RecordSink {
        void take(Duration instant, std::uint32_t output, const void*) override {
          good = good && instant >= now && published.emplace(instant, output).second;
          now = instant;
        }
        void finish() override {}
        std::set<std::pair<Duration, std::uint32_t>> published;
        Duration now{};
        bool good = true;
      } once;
      Recorder recorder({&once});
      Executor executor(graph, {}, {.digest = true, .recorder = &recorder});
      executor.run_until(30ms);
      recorder.close();
      CAPTURE(seed);
      CHECK(once.good);
      CHECK_FALSE(once.published.empty());
    }
  }

  TEST_CASE("outputs are numbered by name, bytewise: of tasks with their output, of communicators without") {
    const Graph graph = tests::graph_of(R"(graph: t
timing: {period: 10ms}
communicators:
  b: {type: double, direction: out}
  a_: {type: double, direction: in}
tasks:
  a: {type: Counter}
  a0: {type: Counter}
  B: {type: Counter}
  _: {type: Relay}
connections: [a.out -> b, a_ -> _.in]
)");
    std::vector<std::string> names;
    for (const Output& output : outputs_of(graph)) names.push_back(output.name);
    CHECK(names == std::vector<std::string>{"B.out", "_.out", "a.out", "a0.out", "a_", "b"});
  }

  TEST_CASE("what is released at one instant runs in the order of connections, of however many periods it is") {
    for (const std::vector<int>& periods :
         {std::vector{12, 6, 4, 3, 2, 1}, std::vector{60, 30, 20, 15, 12, 10, 6, 5, 4, 3, 2, 1}}) {
      std::string all = "graph: t\ntasks:\n", connections = "connections:\n";
      for (const int period : periods) {
        const std::string name = "t" + std::to_string(period);
        const bool first = period == periods.front();
        all +=
            "  " + name + ": {type: " + (first ? "Counter" : "Relay") + ", period: " + std::to_string(period) + "ms}\n";
        if (!first) connections += " -> " + name + ".in\n";
        if (period > 1) connections += "  - " + name + ".out";
      }
      const int last = periods.front();
      const auto r = tests::run_text(all + connections, std::chrono::milliseconds(last + 1));
      CHECK(r.lines.back() == std::to_string(last) + "ms t1.out=1");
    }
  }
}
