// Tasks that write where they may, and one that writes where it may not: for runs under guard.
#include <cstdlib>
#include <stdexcept>

#include "graph/plugins/plugin.h"

namespace {
using namespace jarol;

double shared_number = 0;

enum class Where : std::uint8_t { nowhere, task, plan, global, library, zero, input, behind, parameters, overflow };

constexpr auto enumerators(Where) {
  return std::array<Enumerator<Where>, 10>{{{"nowhere", Where::nowhere},
                                            {"task", Where::task},
                                            {"plan", Where::plan},
                                            {"global", Where::global},
                                            {"library", Where::library},
                                            {"zero", Where::zero},
                                            {"input", Where::input},
                                            {"behind", Where::behind},
                                            {"parameters", Where::parameters},
                                            {"overflow", Where::overflow}}};
}

template <class T>
void write_to(const T* where, T what) {
  *const_cast<volatile T*>(where) = what;
}

volatile int one = 1;
int dive_deeper(volatile int* above);
int (*volatile go_on)(volatile int*) = dive_deeper;

int dive_deeper(volatile int* above) {
  volatile int room[64] = {*above + one};
  return go_on(room) + room[0];
}

// Uses its heap, and says where its values lie.
struct Owner {
  static constexpr std::string_view summary = "for tests";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    Sequence<double> seen{};
    static constexpr auto fields() { return describe(field<&State::seen>()); }
  };
  struct Out {
    std::int64_t address = 0;
    double sum = 0;
    Sequence<double> last{};
    static constexpr auto fields() { return describe(field<&Out::address>(), field<&Out::sum>(), field<&Out::last>()); }
  };
  static void run(const Tick& tick, const In& in, State& state, Out& out) {
    state.seen.resize(1 + static_cast<std::size_t>(tick.activation % 50));
    for (double& each : state.seen) each += in.in;
    Sequence<double> scratch;
    for (const double each : state.seen) scratch.push_back(each);
    out.last.resize(scratch.size());
    for (std::size_t i = 0; i < scratch.size(); ++i) out.last[i] = scratch[i];
    out.sum += scratch[0];
    out.address = static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(&state.seen[0]));
  }
};

// Its state fills more than a page, and what is put back after a fault does so too.
struct Large {
  static constexpr std::string_view summary = "for tests";
  struct State {
    double n = 0;
    std::array<double, 1000> seen{};
    static constexpr auto fields() { return describe(field<&State::n>(), field<&State::seen>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, State& state, Out& out) {
    state.n += 1;
    state.seen[static_cast<std::size_t>(state.n) % state.seen.size()] += state.n;
    out.out = state.n;
    for (const double each : state.seen) out.out += each;
    if (static_cast<std::int64_t>(state.n) % 5 == 0) throw std::runtime_error("too hot");
  }
};

// Throws in some of its activations, and catches that in others.
struct Thrower {
  static constexpr std::string_view summary = "for tests";
  struct State {
    double caught = 0;
    Sequence<double> seen{};
    static constexpr auto fields() { return describe(field<&State::caught>(), field<&State::seen>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, State& state, Out& out) {
    for (int i = 0; i < 3; ++i) {
      try {
        if (tick.activation % 3 == 1) throw std::runtime_error("a text that is too long for a small string");
        state.seen.push_back(1);
      } catch (const std::exception&) { state.caught += 1; }
    }
    out.out = state.caught;
    if (tick.activation % 5 == 4) throw std::runtime_error("too hot");
    if (tick.activation % 7 == 6) state.seen.resize(1'000'000);
    if (tick.activation % 11 == 10) out.out = state.seen.at(state.seen.size());
  }
};

struct Wild {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    Where where = Where::nowhere;
    std::int64_t at = 3;
    static constexpr auto fields() { return describe(field<&Param::where>(), field<&Param::at>()); }
  };
  struct In {
    std::int64_t address = 0;
    static constexpr auto fields() { return describe(field<&In::address>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, Out& out) {
    out.out += 1;
    if (tick.activation < p.at) return;
    switch (p.where) {
      case Where::nowhere: return;
      case Where::task: return write_to(reinterpret_cast<const double*>(in.address), 7.0);
      // what the plan's signals are made of
      case Where::plan: return write_to(&type_of<Out>().fields[0].offset, std::size_t{7});
      case Where::global: return write_to(&shared_number, 7.0);
      case Where::library: return std::srand(7);
      case Where::zero: return write_to(reinterpret_cast<const double*>(in.address & 0), 7.0);
      case Where::input: return write_to(&in.address, std::int64_t{7});  // its own all the same
      case Where::behind: return write_to(&out.out + 1, 7.0);
      case Where::parameters: return write_to(&p.at, std::int64_t{7});
      case Where::overflow: {
        volatile int top = 0;
        out.out = dive_deeper(&top);
        return;
      }
    }
  }
};
}  // namespace

JAROL_PLUGIN(Owner, Large, Thrower, Wild)
