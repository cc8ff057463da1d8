#include "graph/expect/parse.h"

#include <array>

#include "graph/expect/reductions.h"
#include "graph/expect/value_reader.h"

namespace jarol::expect {
namespace {

class Parser {
 public:
  /// Without vehicles no true value is known.
  Parser(const Yaml& yaml, const std::string& key, const Graph& graph, const std::vector<TrueValues>* vehicles,
         Problems& problems)
      : in_(yaml, key, problems), value_(in_, graph, vehicles, condition_) {
    condition_.text = yaml.text;
    condition_.where = yaml.where;
  }

  Condition condition() {
    read_kind();
    read_metric();
    read_comparison();
    read_window();
    in_.require_end();
    return std::move(condition_);
  }

  Measured measured() {
    Measured made;
    if (in_.is("time") && in_.next().text == "of") {
      in_.go_on();
      in_.go_on();
      made.is_instant = true;
      condition_.kind = Condition::Kind::once;
    } else {
      read_kind();
    }
    read_metric();
    made.is_limit =
        !made.is_instant && (in_.now().kind != Token::Kind::end || condition_.kind != Condition::Kind::metric);
    if (made.is_instant || made.is_limit) read_comparison();
    read_window();
    // what has to be so before an instant
    if (metric_.window.to) made.is_limit = made.is_limit || made.is_instant;
    in_.require_end();
    made.condition = std::move(condition_);
    return made;
  }

  Condition state() {
    const Token& begin = in_.now();
    for (const std::string_view word : {"always", "never", "once"})
      if (in_.is(word))
        in_.fail(begin, "this condition is evaluated at each instant; leave '" + std::string(word) + "' out");
    if (is_at_reduction())
      in_.fail(begin, "'" + std::string(begin.text) +
                          "' is one number of a whole run; this condition is evaluated at each instant");
    condition_.kind = Condition::Kind::once;
    metric_.value = value_.read();
    metric_.unit = metric_.value.unit;
    read_comparison();
    if (in_.is("after") || in_.is("before") || in_.is("between"))
      in_.fail(in_.now(), "this condition is evaluated at each instant; leave the window of time out");
    in_.require_end();
    return std::move(condition_);
  }

 private:
  void read_kind() {
    if (in_.accept("always"))
      condition_.kind = Condition::Kind::always;
    else if (in_.accept("never"))
      condition_.kind = Condition::Kind::never;
    else if (in_.accept("once"))
      condition_.kind = Condition::Kind::once;
  }

  std::string kind_text() const {
    if (metric_.value.type == nullptr) return "number";
    return metric_.value.type->kind == Kind::boolean ? "truth value" : "choice";
  }

  bool is_at_reduction() const {
    if (in_.now().kind != Token::Kind::word || in_.next().text != "(") return false;
    return find_reduction(in_.now().text) != nullptr;
  }

  void read_metric() {
    const Token& begin = in_.now();
    if (!is_at_reduction()) {
      metric_.value = value_.read();
      metric_.unit = metric_.value.unit;
      read_window();
      return;
    }
    if (condition_.kind != Condition::Kind::metric)
      in_.fail(begin, "'" + std::string(begin.text) +
                          "' is one number of the whole run; leave 'always', 'never' and "
                          "'once' out, or the '" +
                          std::string(begin.text) + "'");
    metric_.reduction = find_reduction(begin.text)->reduction;
    in_.go_on();
    in_.go_on();
    metric_.value = value_.read();
    metric_.unit = metric_.value.unit;
    const bool whole = metric_.value.type != nullptr && (metric_.value.type->kind == Kind::signed_integer ||
                                                         metric_.value.type->kind == Kind::unsigned_integer);
    if (whole && metric_.reduction != Reduction::final) metric_.value.type = nullptr;
    if (metric_.value.type != nullptr && metric_.reduction != Reduction::final)
      in_.fail(begin, "'" + std::string(begin.text) + "' needs a number, not a " + kind_text());
    if (metric_.reduction >= Reduction::rise_time) {
      in_.require("to", "'" + std::string(begin.text) + "'");
      metric_.target = in_.read_number(metric_.value.unit);
      if (metric_.reduction == Reduction::settling_time) {
        in_.require("within", "'settling_time'");
        metric_.band = read_width(metric_.value.unit);
      }
      if (metric_.reduction != Reduction::overshoot) metric_.unit = "s";
    }
    in_.require(")", "'" + std::string(begin.text) + "'");
    read_window();
  }

  // Behind `within`.
  double read_width(const std::string& unit) {
    const Token token = in_.now();
    const double width = in_.read_number(unit);
    if (width < 0) in_.fail(token, "the tolerance is below zero; write how far it may be off");
    return width;
  }

  void read_window() {
    const Token& begin = in_.now();
    if (!in_.is("after") && !in_.is("before") && !in_.is("between")) return;
    if (has_window_) in_.fail(begin, "there is a window of time already; leave one out");
    has_window_ = true;
    Window& window = metric_.window;
    if (in_.accept("after")) {
      window.from = in_.read_time();
    } else if (in_.accept("before")) {
      window.to = in_.read_time();
    } else {
      in_.go_on();
      window.from = in_.read_time();
      in_.require("and", "'between'");
      window.to = in_.read_time();
    }
    if (window.to && *window.to <= window.from)
      in_.fail(begin, "no instant is in that window; its end is after its begin");
  }

  void read_comparison() {
    const Token& token = in_.now();
    const Type* type = metric_.value.type;
    Comparison& comparison = condition_.comparison;
    const bool ordered = in_.is("<") || in_.is("<=") || in_.is(">") || in_.is(">=") || in_.is("within");
    if (ordered && type != nullptr && type->kind != Kind::signed_integer && type->kind != Kind::unsigned_integer)
      in_.fail(token, "a " + kind_text() + " is not compared by '" + std::string(token.text) + "'; write 'is'");
    if (in_.accept("is")) return read_is();
    const std::array<std::string_view, 4> signs{"<", "<=", ">", ">="};
    for (std::size_t i = 0; i < signs.size(); ++i)
      if (in_.accept(signs[i])) {
        comparison.kind = static_cast<Comparison::Kind>(i);
        comparison.limit = in_.read_number(metric_.unit);
        return;
      }
    if (in_.accept("within")) {
      comparison.kind = Comparison::Kind::within;
      comparison.limit = read_width(metric_.unit);
      in_.require("of", "'within'");
      comparison.of = in_.read_number(metric_.unit);
      return;
    }
    if ((type != nullptr && type->kind == Kind::boolean) || in_.is_lenient) {  // alone: that it is true
      comparison.kind = Comparison::Kind::is;
      comparison.limit = 1;
      return;
    }
    in_.fail(token, std::string("a comparison is needed here: ") +
                        (type != nullptr ? "is or is not" : "<, <=, >, >= or within") + in_.but());
  }

  void read_is() {
    condition_.comparison.kind = in_.accept("not") ? Comparison::Kind::is_not : Comparison::Kind::is;
    condition_.comparison.limit = read_word();
    while (in_.is("or")) {
      if (condition_.comparison.kind == Comparison::Kind::is_not)
        in_.fail(in_.now(), "'is not' takes one word; write a condition for each");
      in_.go_on();
      condition_.comparison.others.push_back(read_word());
    }
  }

  // The number of an enumerator, a truth value or an integer.
  double read_word() {
    const Token& token = in_.now();
    const Type* type = metric_.value.type;
    if (type == nullptr && !in_.is_lenient)
      in_.fail(token, "a number with a unit or a fraction 'is' nothing exactly; write within, as in 'within 0.1 of 3'");
    if (token.kind != Token::Kind::word && token.kind != Token::Kind::number)
      in_.fail(token, "a word is needed here" + in_.but());
    in_.go_on();
    if (in_.is_lenient) return 0;
    jarol::Value value(*type);
    const std::string wrong = parse_scalar(*type, std::string(token.text), "", value.data());
    if (!wrong.empty())
      in_.fail(token, "'" + std::string(token.text) + "' " + wrong_word(*type, std::string(token.text), wrong));
    return expect::read_number(*type, value.data());
  }

  static std::string wrong_word(const Type& type, const std::string& word, const std::string& wrong) {
    if (type.kind != Kind::enumeration) return wrong;
    std::vector<std::string> names;
    for (const auto& [name, number] : type.enumerators) names.push_back(name);
    return "is none of its values" + did_you_mean(word, names) + "; they are: " + list_of(names);
  }

  Condition condition_;
  Metric& metric_ = condition_.metric;
  bool has_window_ = false;
  TokenReader in_;
  ValueReader value_;
};

const std::string expect_key = "'expect'";

bool is_text(const Yaml& yaml, const std::string& need, Problems& problems) {
  if (yaml.kind == Yaml::Kind::scalar) return true;
  problems.add(yaml.where, need + ", not " + std::string(kind_name(yaml)));
  return false;
}

const char* const expect_need = "'expect' needs conditions, as in 'depth of dune within 0.1 of 3'";

}  // namespace

std::optional<Condition> parse_condition(const Yaml& text, const Graph& graph, const std::vector<TrueValues>& vehicles,
                                         Problems& problems) {
  if (!is_text(text, expect_need, problems)) return std::nullopt;
  try {
    return Parser(text, expect_key, graph, &vehicles, problems).condition();
  } catch (const Stop&) { return std::nullopt; }
}

std::optional<Measured> parse_measured(const Yaml& text, const std::string& key, const Graph& graph,
                                       const std::vector<TrueValues>& vehicles, Problems& problems) {
  if (!is_text(text, key + " needs a metric, as in 'max(depth of dune)'", problems)) return std::nullopt;
  try {
    return Parser(text, key, graph, &vehicles, problems).measured();
  } catch (const Stop&) { return std::nullopt; }
}

std::optional<Condition> parse_state(const Yaml& text, const std::string& key, const Graph& graph, Problems& problems) {
  if (!is_text(text, key + " needs a condition, as in 'state is ground'", problems)) return std::nullopt;
  try {
    return Parser(text, key, graph, nullptr, problems).state();
  } catch (const Stop&) { return std::nullopt; }
}

bool expects_nothing(const Maybe<Yaml>& list) {
  return list && list->value.kind == Yaml::Kind::scalar && list->value.text == "nothing";
}

std::vector<Condition> read_expectations(const Maybe<Yaml>& list, const Graph& graph,
                                         const std::vector<TrueValues>& vehicles, Problems& problems) {
  std::vector<Condition> conditions;
  if (!list || expects_nothing(list)) return conditions;
  if (list->value.kind != Yaml::Kind::sequence) {
    problems.add(list->where, "'expect' needs a list of conditions, not " + std::string(kind_name(list->value)));
    return conditions;
  }
  for (const Yaml& text : list->value.children)
    if (auto condition = parse_condition(text, graph, vehicles, problems)) conditions.push_back(std::move(*condition));
  return conditions;
}

}  // namespace jarol::expect
