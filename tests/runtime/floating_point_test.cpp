// Tasks compute in one floating-point environment, whatever others leave behind.
#include "graph/floating_point.h"

#include <doctest/doctest.h>

#include <cfenv>
#include <stdexcept>

#include "tests/runtime/trace_of.h"

#if defined(__x86_64__)
namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

constexpr FloatingPointControl flush{0x9fc0, 0x33f}, upward{0x5f80, 0xb3f};

bool computes_by_default() { return floating_point_control() == default_floating_point_control(); }

// At its activation 1 it leaves an environment behind, and throws if it is told to.
struct Careless {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    bool upward = false;
    bool throws = false;
    static constexpr auto fields() { return describe(field<&Param::upward>(), field<&Param::throws>()); }
  };
  struct State {
    double runs = 0;
    static constexpr auto fields() { return describe(field<&State::runs>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    out.out = ++state.runs;
    if (tick.activation != 1) return;
    set_floating_point_control(p.upward ? ::upward : flush);
    if (p.throws) throw std::runtime_error("too hot");
  }
};

// Subnormal, and a quotient whose last bit depends on the rounding.
struct Exact {
  static constexpr std::string_view summary = "for tests";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double small = 0;
    double third = 0;
    static constexpr auto fields() { return describe(field<&Out::small>(), field<&Out::third>()); }
  };
  static void run(const Tick& tick, const In& in, Out& out) {
    const double scale = static_cast<double>(tick.activation) + 1 + 0 * in.in;
    out.small = 0x1p-1060 * scale / 2;
    out.third = scale / 3;
  }
};

// Writes to the tick in spite of `const`.
struct Rude {
  static constexpr std::string_view summary = "for tests";
  static void run(const Tick& tick) { const_cast<Tick&>(tick).now = 99s; }
};

struct Now {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    Duration now{};
    static constexpr auto fields() { return describe(field<&Out::now>()); }
  };
  static void run(const Tick& tick, Out& out) { out.now = tick.now; }
};

const Registry& registry() {
  static const Registry known = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Careless>());
    made.add(task_class<Exact>());
    made.add(task_class<Rude>());
    made.add(task_class<Now>());
    return made;
  }();
  return known;
}

std::string text_of(const std::string& of_careless) {
  return "graph: t\ntiming: {period: 10ms}\ntasks:\n  careless: {type: Careless, on_fault: hold" + of_careless +
         "}\n  exact: {type: Exact}\n  slow: {type: Exact, let: 5ms}\n"
         "connections: [careless.out -> exact.in, careless.out -> slow.in]\n";
}

tests::Run run(const std::string& of_careless) {
  return tests::run_graph(tests::graph_of(registry(), text_of(of_careless)), 40ms);
}
}  // namespace

TEST_SUITE("runtime/floating_point") {
  TEST_CASE("what differs from the default environment is named") {
    const DefaultFloatingPoint scope;
    CHECK(describe_difference(floating_point_control()) == "");
    CHECK(describe_difference(flush) == "flush-to-zero, denormals-are-zero");
    CHECK(describe_difference({0x1fc0, 0x33f}) == "denormals-are-zero");
    CHECK(describe_difference(upward) == "rounding upward");
    CHECK(describe_difference({0x3f80, 0x33f}) == "rounding downward");
    CHECK(describe_difference({0x7f80, 0x33f}) == "rounding toward zero");
    CHECK(describe_difference({0x1f80, 0xf3f}) == "rounding of long double toward zero");
    CHECK(describe_difference({0x1f80, 0x23f}) == "less precision of long double");
    CHECK(describe_difference({0x1d80, 0x33f}) == "exceptions that raise a signal");
  }

  TEST_CASE("every environment that differs is found and ended, whatever numbers it leaves alone") {
    const auto what_is_left = [](FloatingPointControl control) -> std::string {
      const DefaultFloatingPoint scope;
      set_floating_point_control(control);
      try {
        require_default_floating_point();
      } catch (const std::runtime_error& error) { return computes_by_default() ? error.what() : "not ended"; }
      return "";
    };
    const std::string left = "left another floating-point environment behind: ";
    CHECK(what_is_left(default_floating_point_control()) == "");
    for (const unsigned control : {0x9f80U, 0x1fc0U, 0x3f80U, 0x5f80U, 0x7f80U, 0x1d80U, 0x0f80U, 0x0000U})
      CHECK(what_is_left({control, 0x33f}) == left + describe_difference({control, 0x33f}));
    for (const unsigned x87 : {0x73fU, 0xb3fU, 0xf3fU, 0x03fU, 0x23fU, 0x33bU, 0x31fU})
      CHECK(what_is_left({0x1f80, x87}) == left + describe_difference({0x1f80, x87}));
    std::feraiseexcept(FE_ALL_EXCEPT);  // flags are no difference
    CHECK(what_is_left(default_floating_point_control()) == "");
    std::feclearexcept(FE_ALL_EXCEPT);
  }

  TEST_CASE("registers of long double that hold something are found and emptied, wherever the top of them is") {
    const auto what_is_left = [](void (*leave)()) -> std::string {
      const DefaultFloatingPoint scope;
      leave();
      try {
        require_default_floating_point();
      } catch (const std::runtime_error& error) {
        const long double one = 1;
        return computes_by_default() && one / 4 == 0.25L ? error.what() : "not ended";
      }
      return "";
    };
    const std::string left = "left another floating-point environment behind: registers of long double in use";
    CHECK(what_is_left([] { asm volatile("fld1"); }) == left);
    CHECK(what_is_left([] { asm volatile("fld1\n fld1\n fld1\n fld1\n fld1\n fld1\n fld1\n fld1"); }) == left);
    CHECK(what_is_left([] { asm volatile("pxor %%mm0, %%mm0" ::: "mm0"); }) == left);
    CHECK(what_is_left([] { asm volatile("fld1\n fstp %st(0)"); }) == "");
  }

  TEST_CASE("a task that leaves another environment behind has a fault, and no other task computes in it") {
    const auto good = run(", parameters: {}, offset: 7ms");  // careless is not there at the others' instants
    for (const bool up : {false, true}) {
      const auto r = run(std::string(", parameters: {upward: ") + (up ? "true}" : "false}"));
      REQUIRE(r.report.faults.size() == 1);
      CHECK(to_text(r.report.faults[0]) ==
            std::string(
                "task 'careless' activation 1 at 0.01 s: threw: left another floating-point environment behind: ") +
                (up ? "rounding upward" : "flush-to-zero, denormals-are-zero"));
      CHECK(lines_of(r, "careless.out") == "0ns careless.out=1; 20ms careless.out=2; 30ms careless.out=3");
      for (const std::string output : {"exact.small", "exact.third", "slow.small", "slow.third"})
        CHECK(lines_of(r, output) == lines_of(good, output));
    }
  }

  TEST_CASE("a task that throws and leaves another environment behind is reported with what it threw") {
    const auto r = run(", parameters: {throws: true}");
    REQUIRE(r.report.faults.size() == 1);
    CHECK(to_text(r.report.faults[0]) == "task 'careless' activation 1 at 0.01 s: threw: too hot");
    CHECK(lines_of(r, "slow.small") == lines_of(run(", offset: 7ms"), "slow.small"));
    CHECK(computes_by_default());
  }

  TEST_CASE("a run does not depend on the environment of its caller, and gives it back, with any number of workers") {
    const Graph graph = tests::graph_of(registry(), text_of(", parameters: {upward: true}"));
    const auto digest_of = [&](std::size_t workers) {
      Executor executor(graph, {}, {.workers = workers, .sharing = Sharing::always});
      executor.run_until(40ms);
      return executor.report().digest;
    };
    const std::uint64_t expected = digest_of(1);
    for (const std::size_t workers : {1U, 2U, 4U}) {
      std::uint64_t digest = 0;
      bool kept = false;
      {
        const DefaultFloatingPoint scope;
        set_floating_point_control(flush);
        digest = digest_of(workers);
        kept = floating_point_control() == flush;
      }
      CHECK(digest == expected);
      CHECK(kept);
    }
  }

  TEST_CASE("a tick that a task changes in spite of const is seen by no other task") {
    const auto r = tests::run_graph(
        tests::graph_of(registry(),
                        "graph: t\ntiming: {period: 10ms}\ntasks:\n  a_rude: {type: Rude}\n  now: {type: Now}\n"),
        20ms);
    CHECK(lines_of(r, "now.now") == "0ns now.now=0; 10ms now.now=10000000");
  }
}
#endif
