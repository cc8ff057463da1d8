// What the benchmarks run: tasks that pass a message of 64 bytes on, with the body of a small filter.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "graph/task.h"
#include "runtime/machine/real_clock.h"

namespace jarol::bench {

struct Message {
  std::array<double, 8> words{};
  static constexpr auto fields() { return describe(field<&Message::words>()); }
};

struct Filter {
  std::array<double, 7> mean{};
  double count = 0;
  static constexpr auto fields() { return describe(field<&Filter::mean>(), field<&Filter::count>()); }
};

/// The body that tasks and floors share, in a unit of its own, as a user's task would be: a first-order low-pass on
/// seven channels, and a count.
void pass_on(const Message& in, Filter& state, Message& out);

struct Source {
  static constexpr std::string_view summary = "begins a chain or a fan";
  using State = Filter;
  struct Out {
    Message out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, State& state, Out& out) { pass_on({}, state, out.out); }
};

struct Stage {
  static constexpr std::string_view summary = "passes a message on";
  struct In {
    Message in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  using State = Filter;
  struct Out {
    Message out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, const In& in, State& state, Out& out) { pass_on(in.in, state, out.out); }
};

/// Passes nothing on and takes as long as its parameter says.
struct Body {
  static constexpr std::string_view summary = "takes time";
  struct Param {
    std::uint32_t rounds = 1;
    static constexpr auto fields() { return describe(field<&Param::rounds>()); }
  };
  struct In {
    Message in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  using State = Filter;
  struct Out {
    Message out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, State& state, Out& out) {
    for (std::uint32_t i = 0; i < p.rounds; ++i) pass_on(in.in, state, out.out);
  }
};

/// Keeps how late each activation begins. What no task of a graph may do: it looks at a clock and at globals.
struct Stamp {
  static constexpr std::string_view summary = "looks at the clock";
  inline static const RealClock* clock = nullptr;
  inline static std::vector<Duration> begun;  // after the release
  static void run(const Tick& tick) { begun.push_back(clock->now() - tick.now); }
};

/// Throws at every activation.
struct Thrower {
  static constexpr std::string_view summary = "fails";
  static void run(const Tick&);
};

}  // namespace jarol::bench
