#include "graph/expect/parse.h"

#include <array>

#include "graph/expect/tokens.h"

namespace jarol::expect {
namespace {

// Ends the reading of a text in which something was wrong, which was reported.
struct Stop {};

struct NamedReduction {
  std::string_view name;
  Reduction reduction;
};

constexpr std::array reductions{NamedReduction{"final", Reduction::final},
                                NamedReduction{"min", Reduction::min},
                                NamedReduction{"max", Reduction::max},
                                NamedReduction{"mean", Reduction::mean},
                                NamedReduction{"rms", Reduction::rms},
                                NamedReduction{"rise_time", Reduction::rise_time},
                                NamedReduction{"overshoot", Reduction::overshoot},
                                NamedReduction{"settling_time", Reduction::settling_time}};

constexpr const char* reduction_names = "final, min, max, mean, rms, rise_time, overshoot, settling_time";

class Parser {
 public:
  /// Without vehicles no true value is known.
  Parser(const Yaml& yaml, const std::string& key, const Graph& graph, const std::vector<TrueValues>* vehicles,
         Problems& problems)
      : yaml_(yaml), key_(key), graph_(graph), vehicles_(vehicles), problems_(problems), tokens_(tokens_of(yaml.text)) {
    condition_.text = yaml.text;
    condition_.where = yaml.where;
  }

  Condition condition() {
    read_kind();
    read_metric();
    read_comparison();
    read_window();
    end();
    return std::move(condition_);
  }

  Measured measured() {
    Measured made;
    if (is("time") && tokens_[at_ + 1].text == "of") {
      at_ += 2;
      made.is_instant = true;
      condition_.kind = Condition::Kind::once;
    } else {
      read_kind();
    }
    read_metric();
    made.is_limit = !made.is_instant && (now().kind != Token::Kind::end || condition_.kind != Condition::Kind::metric);
    if (made.is_instant || made.is_limit) read_comparison();
    read_window();
    // what has to be so before an instant
    if (metric_.window.to) made.is_limit = made.is_limit || made.is_instant;
    end();
    made.condition = std::move(condition_);
    return made;
  }

  Condition state() {
    const Token& begin = now();
    for (const std::string_view word : {"always", "never", "once"})
      if (is(word)) fail(begin, "it is asked at each instant; leave '" + std::string(word) + "' out");
    if (is_at_reduction())
      fail(begin, "'" + std::string(begin.text) + "' is one number of a whole run; this is asked at each instant");
    condition_.kind = Condition::Kind::once;
    metric_.value = read_value();
    metric_.unit = metric_.value.unit;
    read_comparison();
    if (is("after") || is("before") || is("between"))
      fail(now(), "a window of time does not belong here; it is asked at each instant");
    end();
    return std::move(condition_);
  }

 private:
  const Token& now() const { return tokens_[at_]; }
  bool is(std::string_view text) const { return now().kind != Token::Kind::end && now().text == text; }
  bool accept(std::string_view text) {
    if (!is(text)) return false;
    ++at_;
    return true;
  }

  [[noreturn]] void fail(const Token& token, const std::string& text) {
    Location where = yaml_.where;
    where.column += static_cast<int>(token.column) + (yaml_.quoted ? 1 : 0);
    problems_.add(where, key_ + ": " + text);
    throw Stop{};
  }

  // "but '...' stands there", "but it ends there"
  std::string but() const {
    return now().kind == Token::Kind::end ? ", but it ends there" : ", not '" + std::string(now().text) + "'";
  }

  void require(std::string_view text, const std::string& need) {
    if (!accept(text)) fail(now(), need + " needs '" + std::string(text) + "' here" + but());
  }

  void read_kind() {
    if (accept("always"))
      condition_.kind = Condition::Kind::always;
    else if (accept("never"))
      condition_.kind = Condition::Kind::never;
    else if (accept("once"))
      condition_.kind = Condition::Kind::once;
  }

  std::string kind_text() const {
    if (metric_.value.type == nullptr) return "number";
    return metric_.value.type->kind == Kind::boolean ? "truth value" : "choice";
  }

  bool is_at_reduction() const {
    if (now().kind != Token::Kind::word || tokens_[at_ + 1].text != "(") return false;
    for (const NamedReduction& r : reductions)
      if (r.name == now().text) return true;
    return false;
  }

  void read_metric() {
    const Token& begin = now();
    if (!is_at_reduction()) {
      metric_.value = read_value();
      metric_.unit = metric_.value.unit;
      read_window();
      return;
    }
    if (condition_.kind != Condition::Kind::metric)
      fail(begin, "'" + std::string(begin.text) +
                      "' is one number of the whole run; leave 'always', 'never' and "
                      "'once' out, or the '" +
                      std::string(begin.text) + "'");
    for (const NamedReduction& r : reductions)
      if (r.name == begin.text) metric_.reduction = r.reduction;
    at_ += 2;
    metric_.value = read_value();
    metric_.unit = metric_.value.unit;
    if (metric_.value.type != nullptr && metric_.reduction != Reduction::final)
      fail(begin, "'" + std::string(begin.text) + "' needs a number, not a " + kind_text());
    if (metric_.reduction >= Reduction::rise_time) {
      require("to", "'" + std::string(begin.text) + "'");
      metric_.target = read_number(metric_.value.unit);
      if (metric_.reduction == Reduction::settling_time) {
        require("within", "'settling_time'");
        metric_.band = read_number(metric_.value.unit);
      }
      if (metric_.reduction != Reduction::overshoot) metric_.unit = "s";
    }
    require(")", "'" + std::string(begin.text) + "'");
    read_window();
  }

  void read_window() {
    const Token& begin = now();
    if (!is("after") && !is("before") && !is("between")) return;
    if (has_window_) fail(begin, "there is a window of time already; leave one out");
    has_window_ = true;
    Window& window = metric_.window;
    if (accept("after")) {
      window.from = read_time();
    } else if (accept("before")) {
      window.to = read_time();
    } else {
      ++at_;
      window.from = read_time();
      require("and", "'between'");
      window.to = read_time();
    }
    if (window.to && *window.to <= window.from) fail(begin, "no instant is in that window; its end is after its begin");
  }

  Duration read_time() {
    const Token token = now();
    if (token.kind != Token::Kind::number) fail(token, "an instant is needed here, as in 30s" + but());
    Duration time{};
    const std::string wrong = parse_duration(token.text, time);
    if (!wrong.empty()) fail(token, "'" + std::string(token.text) + "' " + wrong);
    if (time > longest_duration) fail(token, "'" + std::string(token.text) + "' is longer than ten years");
    ++at_;
    return time;
  }

  double read_number(const std::string& unit) {
    const Token first = now();
    const bool negative = accept("-");
    const Token token = now();
    if (token.kind != Token::Kind::number) fail(token, "a number is needed here" + but());
    ++at_;
    if (is_lenient_) return 0;
    double number = 0;
    const std::string wrong = parse_number(token.text, unit, number);
    if (!wrong.empty()) fail(first, "'" + std::string(token.text) + "' " + wrong);
    return negative ? -number : number;
  }

  void read_comparison() {
    const Token token = now();
    const Type* type = metric_.value.type;
    Comparison& comparison = condition_.comparison;
    const bool ordered = is("<") || is("<=") || is(">") || is(">=") || is("within");
    if (ordered && type != nullptr && type->kind != Kind::signed_integer && type->kind != Kind::unsigned_integer)
      fail(token, "a " + kind_text() + " is not compared by '" + std::string(token.text) + "'; write 'is'");
    if (accept("is")) return read_is();
    const std::array<std::string_view, 4> signs{"<", "<=", ">", ">="};
    for (std::size_t i = 0; i < signs.size(); ++i)
      if (accept(signs[i])) {
        comparison.kind = static_cast<Comparison::Kind>(i);
        comparison.limit = read_number(metric_.unit);
        return;
      }
    if (accept("within")) {
      comparison.kind = Comparison::Kind::within;
      comparison.limit = read_number(metric_.unit);
      require("of", "'within'");
      comparison.of = read_number(metric_.unit);
      return;
    }
    if ((type != nullptr && type->kind == Kind::boolean) || is_lenient_) {  // alone: that it is true
      comparison.kind = Comparison::Kind::is;
      comparison.limit = 1;
      return;
    }
    fail(token, std::string("a comparison is needed here: ") +
                    (type != nullptr ? "is or is not" : "<, <=, >, >= or within") + but());
  }

  void read_is() {
    condition_.comparison.kind = accept("not") ? Comparison::Kind::is_not : Comparison::Kind::is;
    condition_.comparison.limit = read_word();
    while (is("or")) {
      if (condition_.comparison.kind == Comparison::Kind::is_not)
        fail(now(), "'is not' takes one word; write a condition for each");
      ++at_;
      condition_.comparison.others.push_back(read_word());
    }
  }

  // The number of an enumerator, a truth value or an integer.
  double read_word() {
    const Token token = now();
    const Type* type = metric_.value.type;
    if (type == nullptr && !is_lenient_)
      fail(token, "a number with a unit or a fraction 'is' nothing exactly; write within, as in 'within 0.1 of 3'");
    if (token.kind != Token::Kind::word && token.kind != Token::Kind::number)
      fail(token, "a word is needed here" + but());
    ++at_;
    if (is_lenient_) return 0;
    jarol::Value value(*type);
    const std::string wrong = parse_scalar(*type, std::string(token.text), "", value.data());
    if (!wrong.empty())
      fail(token, "'" + std::string(token.text) + "' " + wrong_word(*type, std::string(token.text), wrong));
    return expect::read_number(*type, value.data());
  }

  static std::string wrong_word(const Type& type, const std::string& word, const std::string& wrong) {
    if (type.kind != Kind::enumeration) return wrong;
    std::vector<std::string> names;
    for (const auto& [name, number] : type.enumerators) names.push_back(name);
    return "is none of its values" + did_you_mean(word, names) + "; they are: " + list_of(names);
  }

  // A sum; only what is a number on both sides can be in it.
  Value read_value() {
    Value value = read_term();
    while (is("+") || is("-")) {
      const Token sign = now();
      ++at_;
      require_number(sign, value);
      if (now().kind == Token::Kind::number) {
        add(value, {Step::Kind::constant, 0, read_number(value.unit)});
      } else {
        const Token begin = now();
        const Value other = read_term();
        require_number(begin, other);
        if (other.unit != value.unit && !is_lenient_)
          fail(begin, "this is in " + unit_text(other.unit) + ", what stands before it in " + unit_text(value.unit));
        value.steps.insert(value.steps.end(), other.steps.begin(), other.steps.end());
      }
      add(value, {sign.text == "+" ? Step::Kind::add : Step::Kind::subtract});
      value.type = nullptr;
    }
    check_depth(value);
    return value;
  }

  static std::string unit_text(const std::string& unit) { return unit.empty() ? "no unit" : unit; }
  static void add(Value& value, Step step) { value.steps.push_back(step); }

  void require_number(const Token& token, const Value& value) {
    if (value.type != nullptr && (value.type->kind == Kind::boolean || value.type->kind == Kind::enumeration))
      fail(token, "only numbers can be computed with; write 'is' to compare a choice or a truth value");
  }

  void check_depth(const Value& value) {
    std::size_t depth = 0;
    for (const Step& step : value.steps) {
      if (step.kind == Step::Kind::signal || step.kind == Step::Kind::constant) ++depth;
      if (step.kind == Step::Kind::add || step.kind == Step::Kind::subtract) --depth;
      if (depth > deepest_stack) fail(tokens_.front(), "this is nested too deeply");
    }
  }

  // Brackets within brackets are read by a function within a function.
  struct Level {
    explicit Level(Parser& parser) : depth(parser.depth_) {
      if (++depth > deepest_stack) parser.fail(parser.now(), "this is nested too deeply");
    }
    ~Level() { --depth; }
    std::size_t& depth;
  };

  Value read_term() {
    const Level level(*this);
    const Token token = now();
    if (accept("-")) return apply(Step::Kind::negate, token, read_term());
    if (accept("(")) {
      Value value = read_value();
      require(")", "'('");
      return value;
    }
    if (token.kind == Token::Kind::number) fail(token, "a number can't stand first; begin with what is judged");
    if (token.kind != Token::Kind::word || is_keyword(token.text))
      fail(token, "the name of what is judged is needed here" + but());
    ++at_;
    if (!accept("(")) return read_name(token);
    if (token.text != "abs" && token.text != "wrap") {
      for (const NamedReduction& r : reductions)
        if (r.name == token.text)
          fail(token, "'" + std::string(token.text) + "' stands first, around all that it is taken of");
      fail(token, "there is no function '" + std::string(token.text) + "'; there are: abs, wrap, " + reduction_names);
    }
    Value value = read_value();
    if (token.text == "wrap" && value.unit != "rad" && !is_lenient_)
      fail(token, "'wrap' needs an angle, in rad, not what is in " + unit_text(value.unit));
    require(")", "'" + std::string(token.text) + "'");
    return apply(token.text == "abs" ? Step::Kind::absolute : Step::Kind::wrap, token, std::move(value));
  }

  Value apply(Step::Kind kind, const Token& token, Value value) {
    require_number(token, value);
    add(value, {kind});
    value.type = nullptr;
    return value;
  }

  Value read_name(const Token& token) {
    Found found;
    if (accept("of")) {
      const Token distributer = now();
      if (distributer.kind != Token::Kind::word) fail(distributer, "the name of a distributer is needed here" + but());
      if (vehicles_ == nullptr) fail(token, "a true value is not known to who steers; name what is published");
      ++at_;
      found = find_true(graph_, *vehicles_, std::string(token.text), std::string(distributer.text));
    } else {
      found = find_published(graph_, std::string(token.text));
    }
    if (!found.wrong.empty()) fail(token, found.wrong);
    if (!found.signal) throw Stop{};  // reported elsewhere
    if (!found.not_judged.empty()) {
      is_lenient_ = true;
      condition_.not_judged = found.not_judged;
    }
    Value value;
    const Type* type = found.signal->leaf.type;
    value.unit = found.signal->leaf.unit;
    if (type != nullptr && type->kind != Kind::floating && type->kind != Kind::duration) value.type = type;
    add(value, {Step::Kind::signal, condition_.signals.size()});
    condition_.signals.push_back(std::move(*found.signal));
    return value;
  }

  void end() {
    if (now().kind != Token::Kind::end)
      fail(now(), "'" + std::string(now().text) + "' is more than a condition needs; leave it out");
  }

  const Yaml& yaml_;
  const std::string& key_;
  const Graph& graph_;
  const std::vector<TrueValues>* vehicles_;
  Problems& problems_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
  Condition condition_;
  Metric& metric_ = condition_.metric;
  bool has_window_ = false;
  bool is_lenient_ = false;  // something can't be judged: units are not known
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

std::vector<Condition> read_expectations(const Maybe<Yaml>& list, const Graph& graph,
                                         const std::vector<TrueValues>& vehicles, Problems& problems) {
  std::vector<Condition> conditions;
  if (!list || list->value.kind == Yaml::Kind::null) return conditions;
  if (list->value.kind != Yaml::Kind::sequence) {
    problems.add(list->where, "'expect' needs a list of conditions, not " + std::string(kind_name(list->value)));
    return conditions;
  }
  for (const Yaml& text : list->value.children)
    if (auto condition = parse_condition(text, graph, vehicles, problems)) conditions.push_back(std::move(*condition));
  return conditions;
}

}  // namespace jarol::expect
