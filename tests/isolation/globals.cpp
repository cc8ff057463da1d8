// Tasks that reach writable data which is not theirs.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "tests/isolation/task.h"

extern "C" {
// of a section that begins as one that is constant does; in the names of functions g is a type
[[gnu::section(".init_array_of_mine")]] double g = 1;
// may be executed, too
extern double in_code;
// goes on in what lies behind it
void without_end();
// from its own begin to what leads to a counter
struct Behind {
  double* count;
};
extern const int distances[2];
double count_behind = 0;
[[gnu::used, gnu::visibility("hidden")]] extern const Behind behind_distance{&count_behind};
}
asm(R"(
  .text
  .type without_end, @function
without_end:
  nop
  .size without_end, .-without_end
  .type add_in_assembly, @function
add_in_assembly:
  incq kept_in_assembly(%rip)
  ret
  .size add_in_assembly, .-add_in_assembly
  .pushsection .changes_itself,"awx",@progbits
  .type in_code, @object
  .size in_code, 8
  .globl in_code
in_code: .quad 0
  .popsection
  .pushsection .rodata
  .type distances, @object
  .size distances, 8
  .hidden distances
distances: .long behind_distance - distances, behind_distance - distances
  .popsection
  .bss
  .type kept_in_assembly, @object
  .size kept_in_assembly, 8
kept_in_assembly: .zero 8
  .text
)");

namespace {

double counter = 0;
thread_local double per_thread = 0;
const double first_value = std::sqrt(static_cast<double>(reinterpret_cast<std::uintptr_t>(&counter) % 7));
// parts of functions that only the unwinder enters, as compilers name them that lay out each block by itself
double unwound(double) asm("unwound"), in_part() asm("unwound.__part.7");
double caught(double) asm("caught"), in_landing_pad() asm("caught.eh");
[[gnu::noinline]] double unwound(double x) { return x * 3; }
[[gnu::noinline, gnu::used]] double in_part() { return counter += 2; }
[[gnu::noinline]] double caught(double x) { return x * 4; }
[[gnu::noinline, gnu::used]] double in_landing_pad() { return counter += 3; }
double bumped = 0;
double bump(double) { return bumped += 1; }
double add_one(double x) { return x + 1; }
double twice(double x) { return x * 2; }
struct Law {
  double (*apply)(double);
  double gain;
};
const Law first_law{add_one, 1}, second_law{twice, 2}, last_law{bump, 1};
[[gnu::noinline]] const Law& law_of(int which) {
  switch (which) {
    case 1: return second_law;
    case 2: return first_law;
    case 3: return second_law;
    case 4: return last_law;
    case 5: return last_law;
    default: return first_law;
  }
}

double (*hook)(double) = ::sin;
double (*hooks[2])(double) = {::sin, ::cos};
double* const address_of_counter = &counter;
constexpr std::array<double*, 2> table_of_counters{&counter, &counter};

[[gnu::noinline]] void add_to_counter(double by) { counter += by; }
[[gnu::noinline]] void add_twice(double by) {
  add_to_counter(by);
  add_to_counter(by);
}

template <class T>
struct Shared {
  static inline T value{};
};

template <class T>
[[gnu::noinline]] T next_of_type() {
  static T value = 0;
  return value += 1;
}

struct Meter {
  Meter() : level(counter) {}
  double level;
};
[[gnu::noinline]] const Meter& the_meter() {
  static const Meter meter;
  return meter;
}

struct Shape {
  virtual double area() const = 0;
};
struct Square final : Shape {
  double area() const override { return side * side; }
  double side = 1;
};
struct Counted final : Shape {
  double area() const override { return counter; }
};
[[gnu::noinline]] double area_of(const Shape& shape) { return shape.area(); }

using Function = double (*)(double);
double identity(double x) { return x; }
double counted(double x) { return x + counter; }
constexpr Function functions[] = {identity, counted};
[[gnu::noinline]] double apply(Function function, double x) { return function(x); }

}  // namespace

[[gnu::weak]] double weak_value = 1;
[[gnu::weak]] double weak_function(double x) { return x + weak_value; }

extern "C" {
[[gnu::visibility("hidden")]] double pick_a(double x) { return x + counter; }
[[gnu::visibility("hidden")]] double (*resolve_picked())(double) { return pick_a; }
[[gnu::ifunc("resolve_picked"), gnu::visibility("hidden")]] double picked(double x);
}

namespace {
// offends: a writable global: counter: Plain::run
TASK(Plain, { out.out = counter += in.in; })
// offends: a writable global: counter: Calls::run > add_twice > add_to_counter
TASK(Calls, { add_twice(in.in); })
// offends: thread-local storage: per_thread: PerThread::run
TASK(PerThread, { out.out = per_thread += in.in; })
// offends: a writable global: FunctionStatic::run::calls: FunctionStatic::run
TASK(FunctionStatic, {
  static double calls = 0;
  out.out = calls += 1;
})
// offends: a function-local static: the_meter::meter: GuardedStatic::run > the_meter
TASK(GuardedStatic, { out.out = the_meter().level; })
// offends: a writable global: next_of_type<double>::value: InTemplate::run > next_of_type<double>
TASK(InTemplate, { out.out = next_of_type<double>(); })
// offends: a writable global: Shared<double>::value: InlineVariable::run
TASK(InlineVariable, { out.out = Shared<double>::value += 1; })
// offends: a writable global: first_value: DynamicInitialiser::run
TASK(DynamicInitialiser, { out.out = first_value; })
// offends: a writable global: counter: ThroughConstantPointer::run
TASK(ThroughConstantPointer, { out.out = *address_of_counter; })
// offends: a writable global: counter: ThroughTable::run > table_of_counters
TASK(ThroughTable, { out.out = *table_of_counters[static_cast<std::size_t>(tick.activation & 1)]; })
// offends: a writable global: counter: ConstCast::run
TASK(ConstCast, {
  const double& seen = counter;
  const_cast<double&>(seen) = in.in;
})
// offends: a writable global: counter: InLambda::run > InLambda::run::{lambda}::operator()
TASK(InLambda, {
  const auto add = [&]() __attribute__((noinline)) { return counter += in.in; };
  out.out = add();
})
// offends: a writable global: counter: InStdFunction::run > InStdFunction::run::{lambda}::operator()
TASK(InStdFunction, {
  const std::function<double(double)> add = [](double x) { return counter += x; };
  out.out = add(in.in);
})
// offends: a writable global: counter: VirtualCall::run > vtable for Counted > Counted::area
TASK(VirtualCall, {
  const Counted shape;
  const Square square;
  out.out = area_of(tick.activation > 3 ? static_cast<const Shape&>(shape) : square);
})
// offends: a writable global: counter: FunctionTable::run > functions > counted
TASK(FunctionTable, { out.out = functions[tick.activation & 1](in.in); })
// offends: a writable global: counter: FunctionPointer::run > counted
TASK(FunctionPointer, { out.out = apply(tick.activation > 3 ? counted : identity, in.in); })
// offends: a writable global: weak_value: WeakSymbol::run > weak_function
TASK(WeakSymbol, { out.out = weak_function(in.in); })
// offends: a writable global: counter: Sorts::run > Sorts::run::{lambda}::operator()
TASK(Sorts, {
  std::array<double, 8> all{in.in, 3, 2};
  std::sort(all.begin(), all.end(), [](double a, double b) { return a * counter < b; });
  out.out = all[0];
})
// offends: a writable global: counter: TailCall::run > add_twice > add_to_counter
TASK(TailCall, { return add_twice(in.in + 7); })
// offends: a writable global: counter: InCatch::run
TASK(InCatch, {
  try {
    if (in.in > 3) throw 3;
  } catch (int) { counter = 1; }
})
// offends: a writable global: counter: ...
TASK(InPart, { out.out = unwound(in.in); })
// offends: a writable global: counter: ...
TASK(InLandingPads, { out.out = caught(in.in); })
// offends: a writable global: counter: InDestructor::run > InDestructor::run::Adds::~Adds
TASK(InDestructor, {
  const struct Adds {
    ~Adds() { counter += 1; }
  } adds;
  if (in.in > 3) throw std::runtime_error("more than three");
})
// offends: a writable global: counter: InAssembly::run
TASK(InAssembly, { asm volatile("movsd %0, %%xmm7" : : "m"(counter) : "xmm7"); })
// offends: a writable global: counter: ComputedGoto::run
TASK(ComputedGoto, {
  static const void* const labels[] = {&&good, &&bad};
  goto* labels[tick.activation & 1];
bad:
  counter += 1;
good:
  out.out = 1;
})
// offends: a writable global: counter: Switch::run
TASK(Switch, {
  switch (tick.activation % 8) {
    case 0: out.out = std::sin(in.in); break;
    case 1: out.out = std::exp(in.in); break;
    case 2: out.out = in.in * counter; break;
    case 3: out.out = std::log(in.in); break;
    case 4: out.out = std::tan(in.in); break;
    case 5: out.out = std::cbrt(in.in); break;
    default: out.out = 3; break;
  }
})
// offends: a writable global: counter: MemberPointer::run > MemberPointer::run::Both::bad
TASK(MemberPointer, {
  struct Both {
    double good() const { return 1; }
    double bad() const { return counter * 2; }
  };
  double (Both::*const member)() const = tick.activation > 3 ? &Both::bad : &Both::good;
  out.out = (Both{}.*member)();
})
// offends: a writable global: counter: Resolver::run > picked > pick_a
TASK(Resolver, { out.out = picked(in.in); })
// offends: a writable global: g: InOddSection::run
TASK(InOddSection, { out.out = g += in.in; })
// offends: a writable global: in_code: InCode::run
TASK(InCode, { out.out = in_code += in.in; })
// offends: a writable global: counter: MaskedRead::run
TASK(MaskedRead, { asm volatile("vaddpd %0, %%zmm0, %%zmm1%{%%k1%}" : : "m"(counter) : "memory"); })
// offends: a writable global: kept_in_assembly: FallsOut::run > without_end > add_in_assembly
TASK(FallsOut, { without_end(); })
// offends: a writable global: count_behind: ...
TASK(ByDistance, {
  const char* const place = reinterpret_cast<const char*>(distances) + distances[tick.activation & 1];
  out.out = *reinterpret_cast<const Behind*>(place)->count += in.in;
})
// by distances from a table's begin, as clang lays out what a switch returns
// offends: a writable global: bumped: ...
TASK(PicksLaw, {
  const Law& law = law_of(static_cast<int>(in.in) % 6);
  out.out = law.apply(in.in) * law.gain;
})
// what the loader fills with the address of an import is written to all the same
// offends: a writable global: hook: SwapsHook::run
TASK(SwapsHook, {
  out.out = hook(in.in);
  hook = ::cos;
})
// offends: a writable global: hooks: SwapsFirstHook::run
TASK(SwapsFirstHook, {
  out.out = hooks[tick.activation & 1](in.in);
  hooks[0] = ::tan;
})
// offends: a writable global: SwapsLaw::run::law: SwapsLaw::run
TASK(SwapsLaw, {
  static double (*law)(double) = ::sin;
  out.out = law(in.in);
  if (in.in > 1) law = ::cos;
})

}  // namespace

JAROL_PLUGIN(Plain, Calls, PerThread, FunctionStatic, GuardedStatic, InTemplate, InlineVariable, DynamicInitialiser,
             ThroughConstantPointer, ThroughTable, ConstCast, InLambda, InStdFunction, VirtualCall, FunctionTable,
             FunctionPointer, WeakSymbol, Sorts, TailCall, InCatch, InPart, InLandingPads, InDestructor, InAssembly,
             ComputedGoto, Switch, MemberPointer, Resolver, InOddSection, ByDistance, PicksLaw, InCode, MaskedRead,
             FallsOut, SwapsHook, SwapsFirstHook, SwapsLaw)
