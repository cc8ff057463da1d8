#include "runtime/execute/expectations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jarol {
namespace {

using expect::Comparison;
using expect::Condition;
using expect::Reduction;

// What was reached can't change for the better any more.
bool is_final(const Condition& condition) {
  const Comparison::Kind kind = condition.comparison.kind;
  const Reduction reduction = condition.metric.reduction;
  const bool upper = kind == Comparison::Kind::less || kind == Comparison::Kind::at_most;
  const bool lower = kind == Comparison::Kind::greater || kind == Comparison::Kind::at_least;
  if (reduction == Reduction::max || reduction == Reduction::overshoot) return upper;
  return reduction == Reduction::min && lower;
}

}  // namespace

ConditionWatch::ConditionWatch(const Condition& condition)
    : condition_(condition),
      signals_(condition.signals.size()),
      known_(condition.signals.size()),
      unknown_(condition.signals.size()),
      fold_(condition.metric) {}

void ConditionWatch::set(std::size_t signal, double number) {
  signals_[signal] = number;
  changed_ = true;
  if (known_[signal]) return;
  known_[signal] = true;
  --unknown_;
}

void ConditionWatch::settle(Duration instant) {
  if (!changed_ || unknown_ > 0) return;
  changed_ = false;
  hold(instant);
  value_ = expect::calc_value(condition_.metric.value, signals_);
  since_ = instant;
  has_value_ = true;
}

void ConditionWatch::serialize(Archive& archive) {
  for (double& signal : signals_) archive(signal);
  archive.same(known_.size(), "is of other conditions");
  for (std::size_t i = 0; i < known_.size(); ++i) {
    bool known = known_[i];
    archive(known);
    known_[i] = known;
  }
  unknown_ = static_cast<std::size_t>(std::count(known_.begin(), known_.end(), false));
  archive(changed_, has_value_, since_, value_, fold_, held_, broken_);
}

void ConditionWatch::hold(Duration to) {
  if (!has_value_) return;
  if (condition_.kind == Condition::Kind::metric) return fold_.hold(since_, to, value_);
  const auto [from, until] = clip(condition_.metric.window, since_, to);
  if (from >= until) return;
  auto& first = expect::holds(condition_.comparison, value_) ? held_ : broken_;
  if (!first) first.emplace(from, value_);
}

std::string ConditionWatch::number_text(double number) const {
  const Type* type = condition_.metric.value.type;
  if (type != nullptr && type->kind == Kind::boolean) return number == 0 ? "false" : "true";
  if (type != nullptr && type->kind == Kind::enumeration)
    for (const auto& [name, its] : type->enumerators)
      if (static_cast<double>(its) == number) return name;
  const std::string& unit = condition_.metric.unit;
  if (std::abs(number) < 1e-9) number = 0;  // what rounding left
  if (unit == "rad") return fmt::format("{:.5g} deg", number * 180.0 / std::numbers::pi);
  return fmt::format("{:.5g}{}{}", number, unit.empty() ? "" : " ", unit);
}

Verdict ConditionWatch::judge(Duration end, const std::string& cut_short) const {
  Verdict verdict;
  verdict.condition = condition_.text;
  verdict.why = condition_.not_judged;
  verdict.outcome = Verdict::Outcome::not_judged;
  if (!verdict.why.empty()) return verdict;
  if (condition_.metric.window.from >= end) {
    verdict.why =
        "the run ended at " + seconds_text(end) + " s, before " + seconds_text(condition_.metric.window.from) + " s";
    // it is never looked at in a run that was as long as it was to be
    if (cut_short.empty()) {
      verdict.outcome = Verdict::Outcome::fails;
      verdict.why = "was never looked at: " + verdict.why;
    }
    return verdict;
  }
  ConditionWatch whole = *this;
  whole.hold(end);
  // nothing that would have come changes a window that is over
  const std::string open = condition_.metric.window.to && *condition_.metric.window.to <= end ? "" : cut_short;
  Verdict judged =
      condition_.kind == Condition::Kind::metric ? whole.judge_metric(end, open) : whole.judge_claim(end, open);
  judged.condition = condition_.text;
  judged.unit = condition_.metric.unit;
  return judged;
}

Verdict ConditionWatch::judge_metric(Duration, const std::string& cut_short) const {
  Verdict verdict;
  verdict.reached = fold_.result();
  const bool good = verdict.reached && expect::holds(condition_.comparison, *verdict.reached);
  if (verdict.reached) verdict.reached_text = number_text(*verdict.reached);
  if (!cut_short.empty() && (good || !verdict.reached || !is_final(condition_))) {
    verdict.outcome = Verdict::Outcome::not_judged;
    verdict.why = cut_short;
  } else if (!good) {
    verdict.outcome = Verdict::Outcome::fails;
    verdict.why = verdict.reached ? "reached " + verdict.reached_text : fold_.why_none();
  }
  return verdict;
}

Verdict ConditionWatch::judge_claim(Duration, const std::string& cut_short) const {
  Verdict verdict;
  const bool once = condition_.kind == Condition::Kind::once;
  const auto& decisive = condition_.kind == Condition::Kind::always ? broken_ : held_;
  const bool known = held_ || broken_;
  if (decisive) {
    verdict.instant = decisive->first;
    verdict.reached_text = "at " + seconds_text(decisive->first) + " s: " + number_text(decisive->second);
  }
  if (!cut_short.empty() && !decisive) {
    verdict.outcome = Verdict::Outcome::not_judged;
    verdict.why = cut_short;
  } else if (!known) {
    verdict.outcome = Verdict::Outcome::fails;
    verdict.why = "was never published";
  } else if (once != decisive.has_value()) {
    verdict.outcome = Verdict::Outcome::fails;
    verdict.why = "was not so";
    if (decisive)
      verdict.why = (condition_.kind == Condition::Kind::never ? "was so " : "was not so ") + verdict.reached_text;
  }
  return verdict;
}

Expectations::Expectations(const Graph& graph, const std::vector<Output>& outputs,
                           std::span<const expect::Condition> conditions)
    : targets_(outputs.size() + graph.distributers.size()) {
  const auto output_of = [&](const expect::Signal& signal) -> std::size_t {
    if (signal.distributer) return outputs.size() + *signal.distributer;
    const std::string name = end_name(graph, *signal.published, true);
    return static_cast<std::size_t>(
        std::lower_bound(outputs.begin(), outputs.end(), name,
                         [](const Output& output, const std::string& wanted) { return output.name < wanted; }) -
        outputs.begin());
  };
  watches_.reserve(conditions.size());
  for (const Condition& condition : conditions) {
    if (condition.not_judged.empty())
      for (std::size_t i = 0; i < condition.signals.size(); ++i)
        targets_[output_of(condition.signals[i])].push_back({watches_.size(), i, &condition.signals[i].leaf});
    watches_.emplace_back(condition);
  }
}

void Expectations::take(Duration instant, std::uint32_t output, const void* value) {
  if (instant.count() >= before_.load(std::memory_order_relaxed)) return;
  if (instant != instant_) settle();
  instant_ = instant;
  for (const Target& target : targets_[output])
    watches_[target.watch].set(target.signal, expect::read_number(*target.leaf, value));
}

void Expectations::serialize(Archive& archive) {
  archive.same(watches_.size(), "is of other conditions");
  for (ConditionWatch& watch : watches_) archive(watch);
  archive(instant_);
}

void Expectations::settle() {
  for (ConditionWatch& watch : watches_) watch.settle(instant_);
}

std::vector<Verdict> Expectations::judge(Duration end, const std::string& cut_short) const {
  std::vector<Verdict> verdicts;
  for (const ConditionWatch& watch : watches_) verdicts.push_back(watch.judge(end, cut_short));
  return verdicts;
}

std::vector<std::size_t> watched_vehicles(const Graph& graph, std::span<const Condition> beside) {
  std::vector<std::size_t> watched;
  for (const std::span<const Condition> conditions : {std::span<const Condition>(graph.expectations), beside})
    for (const Condition& condition : conditions)
      for (const expect::Signal& signal : condition.signals)
        if (signal.distributer && condition.not_judged.empty()) watched.push_back(*signal.distributer);
  std::sort(watched.begin(), watched.end());
  watched.erase(std::unique(watched.begin(), watched.end()), watched.end());
  return watched;
}

}  // namespace jarol
