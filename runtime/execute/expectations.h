// The conditions that a graph expects of a run, judged while it goes on from what is published and from where its
// vehicles truly are.
#pragma once

#include <atomic>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/execute/metric_fold.h"
#include "runtime/record/recorder.h"

namespace jarol {

struct Verdict {
  enum class Outcome { holds, fails, not_judged } outcome = Outcome::holds;
  std::string condition;            // as it was written
  std::optional<double> reached{};  // of a metric, in the unit that follows
  std::string unit{};
  std::string reached_text{};  // "2.981 m", "ground", "at 12.35 s: 0.31 m"
  std::optional<Duration>
      instant{};      // of always and never: the first at which it was broken; of once: at which it held
  std::string why{};  // it fails or can't be judged
};

/// One condition under way.
class ConditionWatch {
 public:
  explicit ConditionWatch(const expect::Condition& condition);

  const expect::Condition& condition() const { return condition_; }
  void set(std::size_t signal, double number);
  /// All that is published at `instant` was set.
  void settle(Duration instant);
  /// `cut_short`: why the run ended before what it was meant to do; else empty.
  Verdict judge(Duration end, const std::string& cut_short) const;
  void serialize(Archive& archive);

 private:
  void hold(Duration to);
  Verdict judge_metric(Duration end, const std::string& cut_short) const;
  Verdict judge_claim(Duration end, const std::string& cut_short) const;
  std::string number_text(double number) const;

  const expect::Condition& condition_;
  std::vector<double> signals_;
  std::vector<bool> known_;
  std::size_t unknown_ = 0;
  bool changed_ = false;
  bool has_value_ = false;
  Duration since_{};  // the value holds
  double value_ = 0;
  MetricFold fold_;
  // of always, never and once: the first instant at which the claim held, and at which it did not, with the value
  std::optional<std::pair<Duration, double>> held_, broken_;
};

/// A sink of the recorder that gets all publications, and as outputs that follow the plan's the true values of each
/// distributer's vehicle.
class Expectations : public RecordSink {
 public:
  /// `outputs`: those of the graph's plan. Graph and conditions outlive it.
  Expectations(const Graph& graph, const std::vector<Output>& outputs, std::span<const expect::Condition> conditions);

  /// What is published from that instant on is not judged. Any thread, before it is published.
  void judge_before(Duration instant) { before_.store(instant.count(), std::memory_order_relaxed); }
  bool wants(std::uint32_t output) const override { return !targets_[output].empty(); }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override { settle(); }

  /// After `finish`, of a run that covered the instants before `end`.
  std::vector<Verdict> judge(Duration end, const std::string& cut_short) const;

  /// Of the same graph, while nothing is handed on.
  void serialize(Archive& archive);

 private:
  struct Target {
    std::size_t watch;
    std::size_t signal;
    const Leaf* leaf;
  };
  void settle();

  std::vector<ConditionWatch> watches_;
  std::vector<std::vector<Target>> targets_;  // per output
  Duration instant_{};
  std::atomic<std::int64_t> before_{std::numeric_limits<std::int64_t>::max()};
};

/// The distributers whose true values a condition of the graph names, or one of those beside them.
std::vector<std::size_t> watched_vehicles(const Graph& graph, std::span<const expect::Condition> beside = {});

}  // namespace jarol
