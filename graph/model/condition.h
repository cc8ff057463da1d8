// A condition on what a run publishes and where its vehicles truly are: specs/expectations.md has the language.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/language/quantities.h"
#include "graph/model/end.h"
#include "graph/values/bind.h"

namespace jarol::expect {

/// One number that changes over time: a field that is published, or a true value of a simulated vehicle.
struct Signal {
  std::string name;                        // as it was written
  std::optional<End> published;            // a task's output, or a communicator
  std::optional<std::size_t> distributer;  // of a true value
  Leaf leaf;                               // of what is published, or of the vehicle's true values
};

/// One step of an expression in postfix order.
struct Step {
  enum class Kind { signal, constant, add, subtract, negate, absolute, wrap } kind = Kind::signal;
  std::size_t signal = 0;  // of the condition
  double constant = 0;
};

constexpr std::size_t deepest_stack = 16;

/// A value over time: what holds at each instant.
struct Value {
  std::vector<Step> steps;
  std::string unit;
  const Type* type = nullptr;  // of a truth value, an integer or an enumeration; null: a number
};

enum class Reduction { final, min, max, mean, rms, rise_time, overshoot, settling_time };

/// The instants that count: from `from` to before `to`; none: to the end of the run.
struct Window {
  Duration from{};
  std::optional<Duration> to;
};

/// One number of a whole run.
struct Metric {
  Reduction reduction = Reduction::final;
  Value value;
  double target = 0;  // of rise_time, overshoot and settling_time
  double band = 0;    // of settling_time, to either side of the target
  Window window;
  std::string unit;  // of the number
};

struct Comparison {
  enum class Kind { less, at_most, greater, at_least, within, is, is_not } kind = Kind::less;
  double limit = 0;              // within: how far to either side
  double of = 0;                 // within
  std::vector<double> others{};  // is: what it may be instead
};

struct Condition {
  enum class Kind { metric, always, never, once } kind = Kind::metric;  // but for a metric of the value at each instant
  std::string text;
  Location where;
  std::vector<Signal> signals;
  Metric metric;  // its value and window alone count where it is no metric
  Comparison comparison;
  std::string not_judged;  // why it can't be; else empty
};

/// The number that a value has; `signals`: those of the condition.
double calc_value(const Value& value, const std::vector<double>& signals);

/// False for what is not a number.
bool holds(const Comparison& comparison, double number);

/// The number of a field, an enumerator's or truth value's integer, a duration's seconds.
double read_number(const Leaf& leaf, const void* value);
/// The same of the field itself.
double read_number(const Type& type, const void* field);

}  // namespace jarol::expect
