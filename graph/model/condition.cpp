#include "graph/model/condition.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::expect {

double calc_value(const Value& value, const std::vector<double>& signals) {
  std::array<double, deepest_stack> stack{};
  std::size_t top = 0;  // the number of values on it
  for (const Step& step : value.steps) {
    switch (step.kind) {
      case Step::Kind::signal: stack[top++] = signals[step.signal]; break;
      case Step::Kind::constant: stack[top++] = step.constant; break;
      case Step::Kind::negate: stack[top - 1] = -stack[top - 1]; break;
      case Step::Kind::absolute: stack[top - 1] = std::abs(stack[top - 1]); break;
      case Step::Kind::wrap: stack[top - 1] = wrapped(stack[top - 1]); break;
      case Step::Kind::add: --top, stack[top - 1] += stack[top]; break;
      case Step::Kind::subtract: --top, stack[top - 1] -= stack[top]; break;
    }
  }
  return stack[0];
}

bool holds(const Comparison& comparison, double number) {
  switch (comparison.kind) {
    case Comparison::Kind::less: return number < comparison.limit;
    case Comparison::Kind::at_most: return number <= comparison.limit;
    case Comparison::Kind::greater: return number > comparison.limit;
    case Comparison::Kind::at_least: return number >= comparison.limit;
    case Comparison::Kind::within: return std::abs(number - comparison.of) <= comparison.limit;
    case Comparison::Kind::is:
      return number == comparison.limit ||
             std::find(comparison.others.begin(), comparison.others.end(), number) != comparison.others.end();
    case Comparison::Kind::is_not: return number < comparison.limit || number > comparison.limit;
  }
  return false;
}

double read_number(const Leaf& leaf, const void* value) {
  return read_number(*leaf.type, static_cast<const std::byte*>(value) + leaf.offset);
}

double read_number(const Type& type, const void* field) {
  if (type.kind == Kind::floating) return read_floating(type, field);
  const std::int64_t integer = read_integer(type, field);
  if (type.kind == Kind::duration) return static_cast<double>(integer) * 1e-9;
  return static_cast<double>(integer);
}

}  // namespace jarol::expect
