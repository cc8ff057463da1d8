// Small tasks for the verifier: TASK(Name, { statements }) computes `out.out` from `tick` and `in.in`.
#pragma once

#include "graph/plugins/plugin.h"

struct OneParam {
  double in = 0;
  std::int64_t address = 0;
  static constexpr auto fields() {
    return jarol::describe(jarol::field<&OneParam::in>(), jarol::field<&OneParam::address>());
  }
};
struct OneState {
  double kept = 0;
  std::int64_t address = 0;
  static constexpr auto fields() {
    return jarol::describe(jarol::field<&OneState::kept>(), jarol::field<&OneState::address>());
  }
};
struct OneOut {
  double out = 0;
  static constexpr auto fields() { return jarol::describe(jarol::field<&OneOut::out>()); }
};

#define TASK(Name, ...)                                                                         \
  struct Name {                                                                                 \
    static constexpr std::string_view summary = "for tests";                                    \
    using Param = OneParam;                                                                     \
    using State = OneState;                                                                     \
    using Out = OneOut;                                                                         \
    static void run([[maybe_unused]] const Param& in, [[maybe_unused]] const jarol::Tick& tick, \
                    [[maybe_unused]] State& state, [[maybe_unused]] Out& out) __VA_ARGS__       \
  };
