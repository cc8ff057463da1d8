#include "graph/expect/value_reader.h"

#include "graph/expect/reductions.h"

namespace jarol::expect {
namespace {

std::string unit_text(const std::string& unit) { return unit.empty() ? "no unit" : unit; }

}  // namespace

// Brackets within brackets are read by a function within a function.
struct ValueReader::Level {
  explicit Level(ValueReader& reader) : depth(reader.depth_) {
    if (++depth > deepest_stack) reader.in_.fail(reader.in_.now(), "this is nested too deeply");
  }
  ~Level() { --depth; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;
  std::size_t& depth;
};

Value ValueReader::read() {
  Value value = read_term();
  while (in_.is("+") || in_.is("-")) {
    const Token& sign = in_.now();
    in_.go_on();
    require_number(sign, value);
    if (in_.now().kind == Token::Kind::number) {
      value.steps.push_back({Step::Kind::constant, 0, in_.read_number(value.unit)});
    } else {
      const Token& begin = in_.now();
      const Value other = read_term();
      require_number(begin, other);
      if (other.unit != value.unit && !in_.is_lenient)
        in_.fail(begin, "this is in " + unit_text(other.unit) + ", what stands before it in " + unit_text(value.unit));
      value.steps.insert(value.steps.end(), other.steps.begin(), other.steps.end());
    }
    value.steps.push_back({sign.text == "+" ? Step::Kind::add : Step::Kind::subtract});
    value.type = nullptr;
  }
  check_depth(value);
  return value;
}

void ValueReader::require_number(const Token& token, const Value& value) const {
  if (value.type != nullptr && (value.type->kind == Kind::boolean || value.type->kind == Kind::enumeration))
    in_.fail(token, "only numbers can be computed with; write 'is' to compare a choice or a truth value");
}

void ValueReader::check_depth(const Value& value) const {
  std::size_t depth = 0;
  for (const Step& step : value.steps) {
    if (step.kind == Step::Kind::signal || step.kind == Step::Kind::constant) ++depth;
    if (step.kind == Step::Kind::add || step.kind == Step::Kind::subtract) --depth;
    if (depth > deepest_stack) in_.fail(in_.first(), "this is nested too deeply");
  }
}

Value ValueReader::read_term() {
  const Level level(*this);
  const Token& token = in_.now();
  if (in_.accept("-")) return apply(Step::Kind::negate, token, read_term());
  if (in_.accept("(")) {
    Value value = read();
    in_.require(")", "'('");
    return value;
  }
  if (token.kind == Token::Kind::number) in_.fail(token, "a number can't stand first; begin with what is judged");
  if (token.kind != Token::Kind::word || is_keyword(token.text))
    in_.fail(token, "the name of what is judged is needed here" + in_.but());
  in_.go_on();
  return in_.accept("(") ? read_call(token) : read_name(token);
}

Value ValueReader::read_call(const Token& function) {
  const std::string name(function.text);
  if (name != "abs" && name != "wrap") {
    if (find_reduction(name) != nullptr)
      in_.fail(function, "'" + name + "' stands first, around all that it is taken of");
    in_.fail(function, "there is no function '" + name + "'; there are: abs, wrap, " + reduction_names);
  }
  Value value = read();
  if (name == "wrap" && value.unit != "rad" && !in_.is_lenient)
    in_.fail(function, "'wrap' needs an angle, in rad, not what is in " + unit_text(value.unit));
  in_.require(")", "'" + name + "'");
  return apply(name == "abs" ? Step::Kind::absolute : Step::Kind::wrap, function, std::move(value));
}

Value ValueReader::apply(Step::Kind kind, const Token& token, Value value) const {
  require_number(token, value);
  value.steps.push_back({kind});
  value.type = nullptr;
  return value;
}

Value ValueReader::read_name(const Token& token) {
  Found found;
  if (in_.accept("of")) {
    const Token& distributer = in_.now();
    if (distributer.kind != Token::Kind::word)
      in_.fail(distributer, "the name of a distributer is needed here" + in_.but());
    if (vehicles_ == nullptr) in_.fail(token, "true values are not available to an operator; name what is published");
    in_.go_on();
    found = find_true(graph_, *vehicles_, std::string(token.text), std::string(distributer.text));
  } else {
    found = find_published(graph_, std::string(token.text));
  }
  if (!found.wrong.empty()) in_.fail(token, found.wrong);
  if (!found.signal) throw Stop{};  // reported elsewhere
  if (!found.not_judged.empty()) {
    in_.is_lenient = true;
    condition_.not_judged = found.not_judged;
  }
  Value value;
  const Type* type = found.signal->leaf.type;
  value.unit = found.signal->leaf.unit;
  if (type != nullptr && type->kind != Kind::floating && type->kind != Kind::duration) value.type = type;
  value.steps.push_back({Step::Kind::signal, condition_.signals.size()});
  condition_.signals.push_back(std::move(*found.signal));
  return value;
}

}  // namespace jarol::expect
