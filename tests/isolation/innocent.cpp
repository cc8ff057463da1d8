// Tasks that reach nothing but their own, in all the ways that look as if they did.
// In one file: a list, compiled as one library.
#include <algorithm>
#include <any>
#include <array>
#include <atomic>
#include <bit>
#include <bitset>
#include <charconv>
#include <cmath>
#include <complex>
#include <functional>
#include <list>
#include <map>
#include <memory_resource>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "tests/isolation/task.h"

[[gnu::weak]] double weak(double x) { return x + 1; }

extern "C" {
[[gnu::visibility("hidden")]] double picked_always(double x) { return x + 1; }
[[gnu::visibility("hidden")]] double (*resolve_innocent())(double) { return picked_always; }
[[gnu::ifunc("resolve_innocent"), gnu::visibility("hidden")]] double picked_innocent(double x);
}

namespace {

using namespace std::string_view_literals;

constexpr std::array<double, 5> gains{0.1, 0.2, 0.4, 0.8, 1.6};
constexpr const char* names[] = {"none", "some", "all"};
constinit const double scale = 3.5;

using Function = double (*)(double);
double half(double x) { return x / 2; }
double twice(double x) { return x * 2; }
constexpr Function functions[] = {half, twice, half};
[[gnu::noinline]] double apply(Function function, double x) { return function(x); }
[[gnu::noinline]] double apply_any(const std::function<double(double)>& function, double x) { return function(x); }
[[gnu::noinline]] double recursive(double x) { return x < 1 ? x : 1 + recursive(x / 2); }

struct Shape {
  virtual ~Shape() = default;
  virtual double area() const = 0;
  virtual double edge() const { return 1; }
};
struct Square final : Shape {
  explicit Square(double of) : side(of) {}
  double area() const override { return side * side; }
  double side;
};
struct Circle final : Shape {
  explicit Circle(double of) : radius(of) {}
  double area() const override { return std::numbers::pi * radius * radius; }
  double edge() const override { return 0; }
  double radius;
};
[[gnu::noinline]] double area_of(const Shape& shape) { return shape.area() + shape.edge(); }

struct Named {
  virtual double number() const { return 1; }
};
struct Both final : Named, Shape {
  double number() const override { return 2; }
  double area() const override { return 3; }
};
[[gnu::noinline]] double number_of(const Named& named) { return named.number(); }

struct TooLarge : std::runtime_error {
  explicit TooLarge(double by) : std::runtime_error("too large"), much(by) {}
  double much;
};

struct Counter {
  double& count;
  explicit Counter(double& of) : count(of) {}
  ~Counter() { count += 1; }
};

TASK(Nothing, {})
TASK(Adds, { out.out = in.in + 1; })
TASK(Integrates, { out.out = state.kept += in.in * std::chrono::duration<double>(tick.period).count(); })
TASK(Mathematics, {
  const double x = in.in;
  out.out = std::sin(x) + std::cos(x) + std::tan(x) + std::exp(x) + std::log(x) + std::pow(x, 0.3) +
            std::atan2(x, 2.0) + std::hypot(x, 1.0) + std::fmod(x, 3.0) + std::cbrt(x) + std::remainder(x, 2.0) +
            std::tgamma(x) + std::erf(x);
})
TASK(SinglePrecision, { out.out = std::sin(static_cast<float>(in.in)) + std::pow(static_cast<float>(in.in), 0.3F); })
TASK(LongDouble, { out.out = static_cast<double>(std::sin(static_cast<long double>(in.in)) * 3.0L); })
TASK(LongDoubleToInteger, { out.out = static_cast<double>(static_cast<long>(static_cast<long double>(in.in) * 3.0L)); })
TASK(Complex, { out.out = std::abs(std::exp(std::complex<double>(in.in, 1)) * std::complex<double>(in.in, 2)); })
TASK(ConstantTable, { out.out = gains[static_cast<std::size_t>(tick.activation) % gains.size()] * scale; })
TASK(TextTable, { out.out = static_cast<double>(std::string_view(names[tick.activation % 3]).size()); })
TASK(LocalConstants, {
  static constexpr double steps[] = {1, 2, 4, 8};
  static const int first = 3;
  out.out = steps[tick.activation & 3] + first;
})
TASK(FunctionTable, { out.out = functions[tick.activation % 3](in.in); })
TASK(FunctionPointer, { out.out = apply(tick.activation > 3 ? half : twice, in.in); })
TASK(StdFunction, { out.out = apply_any([&](double x) { return x + in.in; }, in.in); })
TASK(Bind, {
  const auto add = std::bind(std::plus<>(), std::placeholders::_1, in.in);
  asm volatile("" : : "r"(&std::placeholders::_1));  // by reference, as without optimisation
  out.out = add(1.0);
})
TASK(Lambdas, {
  const auto add = [&, by = in.in](double x) { return x + by; };
  out.out = add(add(1));
})
TASK(Virtual, {
  const Square square(in.in);
  const Circle circle(in.in);
  out.out = area_of(tick.activation > 3 ? static_cast<const Shape&>(square) : circle);
})
TASK(PickedShape, {
  const Square square(in.in);
  const Circle circle(in.in);
  const Square large(9);
  const Shape* const shapes[] = {&square, &circle, &large};
  out.out = shapes[tick.activation % 3]->area();
})
TASK(AllShapes, {
  const Square square(in.in);
  const Circle circle(in.in);
  const std::array<const Shape*, 2> shapes{&square, &circle};
  for (const Shape* const shape : shapes) out.out += shape->area();
})
// may be rejected at -O0: clang swaps through pointers that come from a call
TASK(PickedFunction, {
  Function table[] = {half, twice};
  if (in.in > 3) std::swap(table[0], table[1]);
  out.out = table[tick.activation & 1](in.in);
})
TASK(MultipleInheritance, {
  const Both both;
  out.out = area_of(both) + number_of(both);
})
TASK(DynamicCast, {
  const Both both;
  const Named& named = tick.activation > 3 ? static_cast<const Named&>(both) : Named();
  out.out = dynamic_cast<const Both*>(&named) != nullptr ? 1 : 0;
})
// may be rejected at -O0: clang chooses the member by a branch, and the address is no constant
TASK(MemberPointer, {
  double (Shape::*const member)() const = tick.activation > 3 ? &Shape::area : &Shape::edge;
  const Square square(in.in);
  out.out = (square.*member)();
})
TASK(Switch, {
  switch (tick.activation % 9) {
    case 0: out.out = std::sin(in.in); break;
    case 1: out.out = std::exp(in.in); break;
    case 2: out.out = std::log(in.in); break;
    case 3: out.out = std::tan(in.in); break;
    case 4: out.out = std::cbrt(in.in); break;
    case 5: out.out = half(in.in) + apply(twice, in.in); break;
    case 6: throw std::out_of_range("six");
    default: out.out = recursive(in.in); break;
  }
})
TASK(ComputedGoto, {
  static const void* const labels[] = {&&first, &&second, &&third};
  goto* labels[tick.activation % 3];
first:
  out.out += 1;
second:
  out.out += std::sin(in.in);
third:
  out.out += 1;
})
TASK(Throws, {
  if (in.in > 3) throw std::runtime_error("more than three");
  if (in.in < -3) throw TooLarge(in.in);
  out.out = in.in;
})
TASK(Catches, {
  try {
    if (in.in > 3) throw TooLarge(in.in);
    out.out = std::vector<int, std::pmr::polymorphic_allocator<int>>(std::pmr::null_memory_resource()).at(3);
  } catch (const TooLarge& error) { out.out = error.much; } catch (const std::exception& error) {
    out.out = static_cast<double>(std::string_view(error.what()).size());
  } catch (...) { throw; }
})
TASK(Destructors, {
  const Counter one(out.out);
  const Counter two(state.kept);
  if (in.in > 3) throw TooLarge(in.in);
})
TASK(Sort, {
  std::array<double, 40> all{};
  std::iota(all.begin(), all.end(), in.in);
  std::sort(all.begin(), all.end(), [](double a, double b) { return std::sin(a) < std::sin(b); });
  std::nth_element(all.begin(), all.begin() + 5, all.end());
  std::reverse(all.begin(), all.end());
  out.out = *std::lower_bound(all.begin(), all.end(), 3.0);
})
TASK(SortByPointer, {
  std::array<double, 40> all{in.in, 3, 2, 1};
  bool (*const less)(double, double) = [](double a, double b) { return a < b; };
  std::sort(all.begin(), all.end(), less);
  out.out = all[0];
})
TASK(Heap, {
  std::array<double, 20> all{in.in, 3, 2, 1};
  std::make_heap(all.begin(), all.end());
  std::pop_heap(all.begin(), all.end());
  out.out = std::accumulate(all.begin(), all.end(), 0.0) + std::inner_product(all.begin(), all.end(), all.begin(), 0.0);
})
TASK(PmrVector, {
  std::array<std::byte, 1024> room;
  std::pmr::monotonic_buffer_resource memory(room.data(), room.size(), std::pmr::null_memory_resource());
  std::pmr::vector<double> all(&memory);
  for (int i = 0; i < 10; ++i) all.push_back(in.in * i);
  out.out = all.back();
})
TASK(PmrScratch, {
  std::pmr::vector<double> all(jarol::memory_of_now());
  all.resize(static_cast<std::size_t>(tick.activation), in.in);
  out.out = all.empty() ? 0 : all.back();
})
TASK(PmrText, {
  std::pmr::string text(jarol::memory_of_now());
  text.append("some text that is too long for the place within");
  text += 'x';
  out.out = static_cast<double>(text.find("is"));
})
TASK(PmrMap, {
  std::pmr::map<double, double> all(jarol::memory_of_now());
  all[in.in] = 3;
  all[2] = 1;
  all.erase(2);
  out.out = all.begin()->second;
})
TASK(PmrList, {
  std::pmr::list<double> all(jarol::memory_of_now());
  all.push_back(in.in);
  all.push_front(3);
  out.out = all.back();
})
TASK(PmrHashed, {
  std::pmr::unordered_map<int, double> all(jarol::memory_of_now());
  all[3] = in.in;
  out.out = all.contains(3) ? 1 : 0;
})
TASK(Scratch, {
  jarol::Sequence<double> all;
  for (int i = 0; i < 5; ++i) all.push_back(in.in);
  all.resize(3);
  out.out = all[2];
})
TASK(SequenceElement, {
  jarol::Sequence<double> all;
  all.push_back(in.in);
  out.out = all.at(static_cast<std::size_t>(tick.activation));
})
TASK(Text, {
  jarol::String text;
  text = "depth";
  out.out = static_cast<double>(text.size());
})
TASK(ToChars, {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), in.in).ptr;
  out.out = static_cast<double>(end - text.data());
})
TASK(FromChars, {
  constexpr auto text = "2.75e3"sv;
  std::from_chars(text.data(), text.data() + text.size(), out.out);
  int whole = 0;
  std::from_chars(text.data(), text.data() + 1, whole);
  out.out += whole;
})
TASK(Optional, {
  std::optional<double> maybe;
  if (in.in > 3) maybe = in.in;
  out.out = maybe.value_or(1) + (in.in > 5 ? maybe.value() : 0);
})
TASK(Variant, {
  std::variant<int, double> either = 3;
  if (in.in > 3) either = in.in;
  out.out = std::visit([](auto x) { return static_cast<double>(x); }, either);
})
TASK(VariantGet, {
  std::variant<int, double> either = 3;
  if (in.in > 3) either = in.in;
  out.out = std::get<double>(either);
})
TASK(Bits, {
  out.out = std::popcount(static_cast<unsigned>(tick.activation)) + std::bit_width(7U) + std::bitset<9>(5).count();
})
TASK(RandomBySeed, {
  std::mt19937 random(static_cast<unsigned>(tick.activation));
  out.out = static_cast<double>(random()) + std::generate_canonical<double, 53>(random);
})
TASK(Distribution, {
  std::minstd_rand random(static_cast<unsigned>(tick.activation + 1));
  out.out = std::normal_distribution<double>(0, 1)(random);
})
TASK(LocalAtomic, {
  std::atomic<int> local{3};
  local += static_cast<int>(tick.activation);
  out.out = local;
})
TASK(Volatile, {
  volatile double seen = in.in;
  out.out = seen + seen;
})
TASK(ConstCast, {
  double own = in.in;
  const double& seen = own;
  const_cast<double&>(seen) = 3;
  out.out = own;
})
TASK(Copies, {
  std::array<double, 100> from{in.in};
  std::array<double, 100> to;
  std::memcpy(&to, &from, sizeof to);
  std::memmove(&to[1], &to[0], sizeof to - sizeof(double));
  std::memset(&from, static_cast<int>(tick.activation), sizeof from);
  out.out = to[3] + from[3] + std::memcmp(&from, &to, sizeof to);
})
TASK(Assembly, {
  double root;
  asm("sqrtsd %1, %0" : "=x"(root) : "x"(in.in));
  out.out = root;
})
TASK(WeakFunction, { out.out = weak(in.in); })
TASK(Resolver, { out.out = picked_innocent(in.in); })
struct Law {
  Function function;
  double gain;
};
constexpr Law laws[] = {{half, 1}, {recursive, 2}};
TASK(LawTable, {
  const Law& law = laws[tick.activation % 2];
  out.out = law.gain * law.function(in.in);
})
TASK(SmallAny, {
  std::any any = 3;
  if (in.in > 1) any = 5;
  out.out = std::any_cast<int>(any);
})
TASK(Asserts, {
  assert(in.in < 1e9);
  out.out = in.in;
})
TASK(Span, {
  std::array<double, 8> all{in.in};
  const std::span<double> part = std::span(all).subspan(2, 3);
  out.out = std::accumulate(part.begin(), part.end(), 1.0);
})
TASK(WideIntegers, {
  const __int128 wide = static_cast<__int128>(in.in * 1e30);
  out.out = static_cast<double>(wide / (tick.activation + 1));
})
TASK(TailCall, { out.out = in.in > 3 ? recursive(in.in) : apply(half, in.in); })
TASK(Vectors, {
  using Four [[gnu::vector_size(32)]] = double;
  const Four four{in.in, 2, 3, 4};
  const Four sum = four * four + 1.0;
  out.out = sum[0] + sum[3];
})

}  // namespace

JAROL_PLUGIN(Nothing, Adds, Integrates, Mathematics, SinglePrecision, LongDouble, LongDoubleToInteger, Complex,
             ConstantTable, TextTable, LocalConstants, FunctionTable, FunctionPointer, StdFunction, Bind, Lambdas,
             Virtual, PickedShape, AllShapes, PickedFunction, MultipleInheritance, DynamicCast, MemberPointer, Switch,
             ComputedGoto, Throws, Catches, Destructors, Sort, SortByPointer, Heap, PmrVector, PmrScratch, PmrText,
             PmrMap, PmrList, PmrHashed, Scratch, SequenceElement, Text, ToChars, FromChars, Optional, Variant,
             VariantGet, Bits, RandomBySeed, Distribution, LocalAtomic, LawTable, SmallAny, Volatile, ConstCast, Copies,
             Assembly, WeakFunction, Resolver, Asserts, Span, WideIntegers, TailCall, Vectors)
