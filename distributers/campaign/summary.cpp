#include "distributers/campaign/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "graph/campaign/columns.h"
#include "graph/text/escape.h"

namespace jarol::campaign {
namespace {

using expect::Comparison;

// How far a number lies towards what a limit forbids; none: there is no limit that says.
std::optional<double> badness(const expect::Condition& condition, double number) {
  switch (condition.comparison.kind) {
    case Comparison::Kind::less:
    case Comparison::Kind::at_most: return number;
    case Comparison::Kind::greater:
    case Comparison::Kind::at_least: return -number;
    case Comparison::Kind::within: return std::abs(number - condition.comparison.of);
    case Comparison::Kind::is:
    case Comparison::Kind::is_not: break;
  }
  return std::nullopt;
}

// What is no number is worse than any.
double rank_of(double badness) { return std::isnan(badness) ? HUGE_VAL : badness; }

// What is no number lies at no end, where there are others.
template <class Order>
bool is_beyond(const std::optional<Case>& end, double number, Order order) {
  return !end || order(number, end->value) || (std::isnan(end->value) && !std::isnan(number));
}

// Does a run break the limit by having no value? Of always and never none is good: it is the instant of a breach.
bool needs_value(const Metric& metric, const expect::Condition& condition) {
  using Kind = expect::Condition::Kind;
  return metric.is_limit && (condition.kind == Kind::metric || condition.kind == Kind::once);
}

class MetricFolder {
 public:
  MetricFolder(const Metric& metric, const expect::Condition& condition) : metric_(metric), condition_(condition) {
    made_.name = metric.name;
    made_.unit = condition.kind == expect::Condition::Kind::metric ? condition.metric.unit : "s";
  }

  void add(const Result& result, const Reached& reached) {
    const std::uint64_t index = result.index;
    if (!reached.word.empty()) ++made_.words[reached.word];
    if (!reached.number && reached.word.empty()) miss(result);
    if (!reached.number) return;
    const double number = *reached.number;
    ++made_.count;
    numbers_.push_back(number);
    // the first of equals
    if (is_beyond(made_.min, number, std::less<>())) made_.min = Case{index, number};
    if (is_beyond(made_.max, number, std::greater<>())) made_.max = Case{index, number};
    if (!metric_.is_limit || condition_.kind != expect::Condition::Kind::metric) return;
    const std::optional<double> bad = badness(condition_, number);
    if (!bad || (made_.worst && rank_of(*bad) <= worst_)) return;
    made_.worst = Case{index, number};
    worst_ = rank_of(*bad);
  }

  void miss(const Result& result) {
    ++made_.missing;
    if (result.outcome != Outcome::bad || !needs_value(metric_, condition_)) return;
    ++made_.bad_without;
    if (!made_.first_bad_without) made_.first_bad_without = result.index;
  }

  MetricSummary finish() {
    if (made_.count == 0) return std::move(made_);
    const auto count = static_cast<double>(made_.count);
    double sum = 0, squares = 0;
    for (const double number : numbers_) sum += number;
    made_.mean = sum / count;
    for (const double number : numbers_) squares += (number - made_.mean) * (number - made_.mean);
    made_.deviation = made_.count > 1 ? std::sqrt(squares / (count - 1)) : 0;
    // what is no number comes last
    std::sort(numbers_.begin(), numbers_.end(),
              [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
    for (std::size_t i = 0; i < percents.size(); ++i) {
      const std::uint64_t rank = (made_.count * static_cast<std::uint64_t>(percents[i]) + 99) / 100;  // from 1
      made_.percentiles[i] = numbers_[rank - 1];
    }
    return std::move(made_);
  }

 private:
  const Metric& metric_;
  const expect::Condition& condition_;
  MetricSummary made_;
  std::vector<double> numbers_;  // of the runs that have one, in their order
  double worst_ = 0;
};

// No number of one is no number of the other, too.
bool is_same(const Result& a, const Result& b) {
  const auto same = [](const Reached& left, const Reached& right) {
    return left == right || (left.number && right.number && std::isnan(*left.number) && std::isnan(*right.number));
  };
  return a.digest == b.digest && a.outcome == b.outcome &&
         std::equal(a.metrics.begin(), a.metrics.end(), b.metrics.begin(), b.metrics.end(), same);
}

std::string text_of(const Reached& reached) { return reached.number ? number_text(*reached.number) : reached.word; }

}  // namespace

Summary summarise(const Results& results, const Measures& measures, const RunRange& range) {
  Summary summary;
  std::vector<MetricFolder> folders;
  for (std::size_t i = 0; i < measures.metrics.size(); ++i)
    folders.emplace_back(measures.metrics[i], measures.conditions[i]);
  std::optional<Result> first;
  const auto add = [&](const Result& result) {
    if (!first) first = result;
    summary.all_same = summary.runs++ == 0 ? result.digest.has_value() : summary.all_same && is_same(result, *first);
    ++summary.outcomes[static_cast<std::size_t>(result.outcome)];
    if (result.outcome != Outcome::good && summary.not_good.size() < max_not_good) summary.not_good.push_back(result);
    if (result.outcome != Outcome::good && result.outcome != Outcome::refused && !summary.first_failed)
      summary.first_failed = result;
    if (result.outcome == Outcome::good && result.not_judged > 0 && summary.not_judged++ == 0)
      summary.first_not_judged = result;
    for (std::size_t i = 0; i < folders.size(); ++i) folders[i].add(result, result.metrics[i]);
  };
  results.for_each(add, range);
  summary.all_same = summary.all_same && summary.runs > 1;
  for (MetricFolder& folder : folders) summary.metrics.push_back(folder.finish());
  return summary;
}

void write_csv(const Results& results, const Campaign& campaign, const Draws& draws,
               const std::function<void(std::string_view)>& write, const RunRange& range) {
  std::string line;
  for (const std::string_view name : first_table_columns) line += (line.empty() ? "" : ",") + std::string(name);
  for (const Variation& v : campaign.vary)
    if (v.path != "seed") line += "," + csv_text(v.path);
  for (const Metric& metric : campaign.measures.metrics) line += "," + metric.name;
  for (const std::string_view name : last_table_columns) line += "," + std::string(name);
  write(line + "\n");
  const auto add = [&](const Result& result) {
    const Start start = draws.at(result.index);
    line = std::to_string(result.index) + "," + std::to_string(start.seed);
    for (const std::string& change : start.set) line += "," + csv_text(change.substr(change.find('=') + 1));
    for (const Reached& reached : result.metrics) line += "," + csv_text(text_of(reached));
    line += fmt::format(",{},{},{},{},{},{}\n", word_of(result.outcome), result.faults, seconds_text(result.simulated),
                        result.digest ? fmt::format("0x{:016x}", *result.digest) : "", csv_text(result.why),
                        result.not_judged);
    write(line);
  };
  results.for_each(add, range);
}

}  // namespace jarol::campaign
