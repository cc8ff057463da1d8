// Tasks on plain numbers, for trying things and for tests.
#pragma once

#include <cstdint>
#include <string_view>

#include "graph/task.h"

namespace jarol::tasks {

struct Counter {
  static constexpr std::string_view summary = "gives the index of its activation";
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "0, 1, 2 ...")); }
  };
  static void run(const Tick& tick, Out& out);
};

struct Relay {
  static constexpr std::string_view summary = "passes its input on";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "the input")); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

struct Sum {
  static constexpr std::string_view summary = "adds two numbers";
  struct In {
    double a = 0;
    double b = 0;
    static constexpr auto fields() { return describe(field<&In::a>(), field<&In::b>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "a + b")); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

struct Accumulate {
  static constexpr std::string_view summary = "gives the running sum of its input";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    double sum = 0;
    static constexpr auto fields() { return describe(field<&State::sum>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "sum of all inputs so far")); }
  };
  static void run(const Tick&, const In& in, State& state, Out& out);
};

struct Window {
  static constexpr std::string_view summary = "gives the newest values of its input, oldest first";
  struct Param {
    std::uint32_t length = 10;
    static constexpr auto fields() { return describe(field<&Param::length>("", "of the window, at most")); }
  };
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    Sequence<double> values{};
    static constexpr auto fields() { return describe(field<&State::values>()); }
  };
  struct Out {
    Sequence<double> out{};
    static constexpr auto fields() { return describe(field<&Out::out>("", "the newest inputs, oldest first")); }
  };
  static void run(const Param& p, const Tick&, const In& in, State& state, Out& out);
};

struct Mean {
  static constexpr std::string_view summary = "gives the mean of a sequence";
  struct In {
    Sequence<double> in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "the mean, 0 of none")); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

struct Work {
  static constexpr std::string_view summary = "takes time and does nothing else";
  struct Param {
    std::uint32_t rounds = 1000;
    static constexpr auto fields() {
      return describe(field<&Param::rounds>("", "dependent multiplications, about 1 ns each"));
    }
  };
  struct State {
    std::uint64_t number = 1;
    static constexpr auto fields() { return describe(field<&State::number>("", "what it computes on")); }
  };
  static void run(const Param& p, const Tick&, State& state);
};

}  // namespace jarol::tasks
