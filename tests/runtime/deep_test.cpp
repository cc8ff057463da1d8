#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

// A list of texts whose number and lengths change from activation to activation.
struct Names {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    std::uint32_t max = 5;
    static constexpr auto fields() { return describe(field<&Param::max>()); }
  };
  struct State {
    Sequence<String> names{};
    static constexpr auto fields() { return describe(field<&State::names>()); }
  };
  struct Out {
    Sequence<String> out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    const auto n = static_cast<std::size_t>(tick.activation);
    String name = "n";  // scratch
    for (std::size_t i = 0; i < n % 7; ++i) name += name;
    state.names.resize(n % (p.max + 1));
    if (!state.names.empty()) state.names.back() = name;
    out.out = state.names;
  }
};

// Lengths of what it gets, and what it had before.
struct Lengths {
  static constexpr std::string_view summary = "for tests";
  struct In {
    Sequence<String> in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    Sequence<std::uint32_t> out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, const In& in, Out& out) {
    Sequence<std::uint32_t> lengths;  // scratch
    for (const String& name : in.in) lengths.push_back(static_cast<std::uint32_t>(name.size()));
    out.out = std::move(lengths);
  }
};

// Grows by `step` numbers an activation; `nan` after so many.
struct Grows {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    std::uint32_t step = 10;
    std::int64_t nan = -1;
    static constexpr auto fields() { return describe(field<&Param::step>(), field<&Param::nan>()); }
  };
  struct State {
    Sequence<double> numbers{};
    static constexpr auto fields() { return describe(field<&State::numbers>()); }
  };
  struct Out {
    Sequence<double> out{};
    double size = 0;
    static constexpr auto fields() { return describe(field<&Out::out>(), field<&Out::size>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    for (std::uint32_t i = 0; i < p.step; ++i) state.numbers.push_back(static_cast<double>(tick.activation));
    out.out = state.numbers;
    out.size = static_cast<double>(state.numbers.size());
    if (tick.activation == p.nan) out.out.back() = std::numeric_limits<double>::quiet_NaN();
  }
};

// A flat task that uses scratch.
struct Scratches {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, Out& out) {
    const Sequence<double> numbers{1, 2, 3};
    out.out = numbers[2];
  }
};

tests::Run run(const std::string& text, Duration end) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Names>());
    made.add(task_class<Lengths>());
    made.add(task_class<Grows>());
    made.add(task_class<Scratches>());
    return made;
  }();
  const Graph graph = tests::graph_of(registry, "graph: t\ntiming: {period: 10ms}\n" + text);
  return tests::run_graph(graph, end);
}

std::string fault_of(const tests::Run& r) { return r.report.faults.empty() ? "" : to_text(r.report.faults[0]); }
}  // namespace

TEST_SUITE("runtime/deep") {
  TEST_CASE("sequences and strings, nested, are cloned across connections") {
    const auto r =
        run("tasks:\n  n: {type: Names}\n  l: {type: Lengths}\n  m: {type: Lengths, let: 5ms}\n"
            "connections: [n.out -> l.in, n.out -> m.in]\n",
            40ms);
    CHECK(fault_of(r) == "");
    CHECK(lines_of(r, "n.out") ==
          R"(0ns n.out=[]; 10ms n.out=["nn"]; 20ms n.out=["nn","nnnn"]; 30ms n.out=["nn","nnnn","nnnnnnnn"])");
    CHECK(lines_of(r, "l.out") == "0ns l.out=[]; 10ms l.out=[2]; 20ms l.out=[2,4]; 30ms l.out=[2,4,8]");
    CHECK(lines_of(r, "m.out") == "5ms m.out=[]; 15ms m.out=[2]; 25ms m.out=[2,4]; 35ms m.out=[2,4,8]");
  }

  TEST_CASE("initial values may be deep, and go through communicators") {
    const auto r =
        run("communicators:\n  i: {type: 'double[]', direction: in, init: [1, 2]}\n"
            "  o: {type: 'double[]', direction: out}\n"
            "tasks:\n  m: {type: Mean}\n  w: {type: Window, let: 10ms, parameters: {length: 2}, init: {out: [7]}}\n"
            "connections: [i -> m.in, m.out -> w.in, w.out -> o]\n",
            40ms);
    CHECK(lines_of(r, "i") == "0ns i=[1,2]; 10ms i=[1,2]; 20ms i=[1,2]; 30ms i=[1,2]");
    CHECK(lines_of(r, "o") == "0ns o=[7]; 10ms o=[1.5]; 20ms o=[1.5,1.5]; 30ms o=[1.5,1.5]");
  }

  TEST_CASE("a task that outgrows its heap has a fault with task, activation and size") {
    const auto r = run("tasks: {g: {type: Grows, heap: 1KiB}}\n", 200ms);
    CHECK(r.report.stopped);
    CHECK(fault_of(r) ==
          "task 'g' activation 3 at 0.03 s: 512 bytes more do not fit its heap: 832 of 1024 bytes are in use; give it "
          "a larger one, as in heap: 2KiB");
    CHECK(lines_of(r, "g.size") == "0ns g.size=10; 10ms g.size=20; 20ms g.size=30");
  }

  TEST_CASE("an input that does not fit its reader's heap is a fault of the reader, until one comes that fits") {
    const std::string text =
        "tasks:\n  n: {type: Names, parameters: {max: 2}}\n"
        "  l: {type: Lengths, heap: 96B, on_fault: hold}\nconnections: [n.out -> l.in]\n";
    const auto r = run(text, 90ms);
    CHECK_FALSE(r.report.stopped);
    CHECK(r.report.fault_count == 3);
    CHECK(fault_of(r) ==
          "task 'l' activation 2 at 0.02 s: 48 bytes more do not fit its heap: 64 of 96 bytes are in use; give it a "
          "larger one, as in heap: 128B");
    CHECK(lines_of(r, "l.out") ==
          "0ns l.out=[]; 10ms l.out=[2]; 30ms l.out=[]; 40ms l.out=[16]; 60ms l.out=[]; 70ms l.out=[1]");
  }

  TEST_CASE("hold and skip put a deep state and deep outputs back as they were before the activation") {
    for (const std::string let : {"", ", let: 10ms"}) {
      CAPTURE(let);
      const auto r = run("tasks: {g: {type: Grows, on_fault: hold, parameters: {step: 1, nan: 2}" + let + "}}\n", 60ms);
      CHECK(r.report.fault_count == 1);
      CHECK(fault_of(r) ==
            "task 'g' activation 2 at 0.0" + std::string(let.empty() ? "2" : "3") + " s: output 'out.2' is nan");
      CHECK(lines_of(r, "g.out").find("[0,1,3]") != std::string::npos);
    }
    // out of heap in the middle of growing: the next activation finds what was there before
    const auto r = run("tasks: {g: {type: Grows, heap: 1KiB, on_fault: skip}}\n", 100ms);
    CHECK(r.report.fault_count == 4);
    CHECK(lines_of(r, "g.size") == "0ns g.size=10; 10ms g.size=20; 20ms g.size=30");
  }

  TEST_CASE("a flat task has scratch if it is given a heap, and else a fault that says so") {
    const auto without = run("tasks: {s: {type: Scratches}}\n", 10ms);
    CHECK(fault_of(without) ==
          "task 's' activation 0 at 0 s: it has no heap for the 32 bytes it wants; add one, as in heap: 64KiB");
    const auto with = run("tasks: {s: {type: Scratches, heap: 64B}}\n", 50ms);
    CHECK(fault_of(with) == "");
    CHECK(lines_of(with, "s.out") == "0ns s.out=3; 10ms s.out=3; 20ms s.out=3; 30ms s.out=3; 40ms s.out=3");
  }

  TEST_CASE("the digest with deep values is the same in pieces and for another size of heap") {
    const auto text = [](const std::string& heap) {
      return "tasks:\n  n: {type: Names" + heap + "}\n  l: {type: Lengths}\nconnections: [n.out -> l.in]\n";
    };
    const auto one = run(text(""), 10s);
    CHECK(one.report.digest == run(text(", heap: 8KiB"), 10s).report.digest);
    CHECK(one.report.digest != run(text(", parameters: {max: 6}"), 10s).report.digest);
  }
}
