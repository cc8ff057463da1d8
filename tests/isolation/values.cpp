// Tasks whose structs reach what is not theirs where they are made, copied or ended, outside `run`.
#include <array>
#include <chrono>
#include <cmath>

#include "tests/isolation/task.h"

namespace {

double counter = 0;
[[gnu::used]] void set_counter(double to) { counter = to; }
std::int64_t made = 0;

[[gnu::noinline]] double now() {
  return static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count());
}

#define KEPT(Name, ...)                                                                     \
  struct Name {                                                                             \
    double kept = __VA_ARGS__;                                                              \
    static constexpr auto fields() { return jarol::describe(jarol::field<&Name::kept>()); } \
  };
KEPT(SinceNow, now())
KEPT(Numbered, static_cast<double>(++made))
KEPT(OfGlobal, counter)
KEPT(OfRoot, std::sqrt(2.0))

// what is copied counts
struct Counting {
  jarol::Sequence<double> values;
  Counting& operator=(const Counting& other) {
    values = other.values;
    ++made;
    return *this;
  }
  static constexpr auto fields() { return jarol::describe(jarol::field<&Counting::values>()); }
};
// what is ended counts
struct Ending {
  jarol::Sequence<double> values;
  ~Ending() { ++made; }
  static constexpr auto fields() { return jarol::describe(jarol::field<&Ending::values>()); }
};
struct Plain {
  jarol::Sequence<double> values;
  static constexpr auto fields() { return jarol::describe(jarol::field<&Plain::values>()); }
};

// its elements are made when it gets longer
struct Growing {
  jarol::Sequence<SinceNow> values;
  static constexpr auto fields() { return jarol::describe(jarol::field<&Growing::values>()); }
};
struct GrowingDeep {
  std::array<jarol::Sequence<jarol::Sequence<Numbered>>, 2> values;
  static constexpr auto fields() { return jarol::describe(jarol::field<&GrowingDeep::values>()); }
};

// of a template
template <class Its>
struct Templated {
  static constexpr std::string_view summary = "for tests";
  using State = Its;
  static void run(const jarol::Tick&, State&) {}
};
struct OfTemplate : Templated<Numbered> {};

#undef TASK
#define TASK(Name, Its)                                                                 \
  struct Name {                                                                         \
    static constexpr std::string_view summary = "for tests";                            \
    using State = Its;                                                                  \
    using Out = OneOut;                                                                 \
    static void run(const jarol::Tick& tick, [[maybe_unused]] State& state, Out& out) { \
      out.out = static_cast<double>(tick.activation);                                   \
    }                                                                                   \
  };

// offends: a clock: std::chrono::_V2::steady_clock::now: SinceNow::SinceNow > now
TASK(Starts, SinceNow)
// offends: a writable global: made: Numbered::Numbered
TASK(Counts, Numbered)
// offends: a writable global: counter: OfGlobal::OfGlobal
TASK(ReadsDefault, OfGlobal)
// offends: a writable global: made: Counting::operator=
TASK(CountsCopies, Counting)
// offends: a writable global: made: Ending::~Ending
TASK(CountsEnds, Ending)
// offends: a clock: std::chrono::_V2::steady_clock::now: ...
TASK(Grows, Growing)
// offends: a writable global: made: ...
TASK(GrowsDeep, GrowingDeep)
#if 0
// offends: a writable global: made: Numbered::Numbered
TASK(OfTemplate,)
#endif
TASK(Computes, OfRoot)
TASK(Sequences, Plain)

}  // namespace

JAROL_PLUGIN(Starts, Counts, ReadsDefault, CountsCopies, CountsEnds, Grows, GrowsDeep, OfTemplate, Computes, Sequences)
