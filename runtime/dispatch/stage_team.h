// Several workers on the tasks of one level, which are independent of each other. Decides for each level by the
// measured times of its tasks whether that pays; whatever it decides, values, digest and faults are the same.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/dispatch/workers.h"
#include "runtime/machine/histogram.h"
#include "runtime/plan/plan.h"
#include "runtime/state/actions.h"

namespace jarol {

/// When several workers share a level; `measure`: never, all are timed instead.
enum class Sharing { if_it_pays, always, measure };

class StageTeam {
 public:
  StageTeam(std::size_t workers, Sharing sharing, const Plan& plan);

  /// Could it pay to share a level of the groups that are due? If not, the plain walk is the quickest.
  bool may_share(std::span<const std::uint32_t> due);

  /// One task that is due; tick lives as long as the level.
  struct Item {
    const Activation* activation = nullptr;
    const Tick* tick = nullptr;
    Outcome outcome = Outcome::good;
  };

  /// The tasks of the level that comes next: clear, add all, run.
  void clear() { items_.clear(); }
  void add(const Activation& activation, const Tick& tick) { items_.push_back({&activation, &tick, Outcome::good}); }
  std::span<const Item> items() const { return items_; }

  /// Runs all items. What is good and flat is copied to its readers; the digest's part of these publications is
  /// returned if asked for. Left to the caller, in order: deep values, recording, and what was not good.
  std::uint64_t run(bool digest, std::uint64_t instant_term);

  /// With Sharing::measure: how long the activations of a task took, without what preempted them.
  const Histogram& took(std::size_t task) const { return took_[task]; }

  /// What the workers beside the caller run; a null while one begins.
  std::span<const std::atomic<const RunningTask*>> others() const { return workers_.others(); }

  /// How often a level was shared, and how often one worker did it.
  std::uint64_t shared() const { return shared_; }
  std::uint64_t alone() const { return alone_; }

 private:
  struct alignas(64) Part {
    std::size_t first = 0;
    std::size_t last = 0;
    std::uint64_t digest = 0;
  };
  // what an activation of a task takes
  struct Cost {
    std::uint32_t measured = 0;  // how often
    double min = 1e9;            // ns
  };

  double widest_of(const Plan::Group& group, double& known) const;
  bool too_short(double cost) const;
  bool all_known() const;
  std::uint64_t run_measured();
  std::uint64_t run_timed();
  bool divide();
  void run_part(Part& part);
  void run_item(Item& item, std::uint64_t& digest) const;
  double cost_of(const Item& item) const { return costs_[item.activation->task].min; }
  double cost_or_one(const Item& item) const { return sharing_ == Sharing::always ? 1 : cost_of(item); }

  const Plan& plan_;
  Workers workers_;
  Sharing sharing_;
  std::vector<Histogram> took_;  // per task, with Sharing::measure
  Duration between_readings_{};  // of the thread's time
  std::vector<Cost> costs_;      // per task
  std::vector<double> widest_;   // per group: the cost of its costliest level; infinite while not known
  std::size_t unknown_;          // tasks that were not yet measured often enough
  std::vector<Item> items_;
  std::vector<Part> parts_;
  bool digest_ = false;
  std::uint64_t instant_term_ = 0;
  std::uint64_t shared_ = 0;
  std::uint64_t alone_ = 0;
};

}  // namespace jarol
