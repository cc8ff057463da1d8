#include "runtime/dispatch/stage_team.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "runtime/machine/running_task.h"
#include "runtime/machine/thread_time.h"
#include "runtime/run/publisher.h"

namespace jarol {
namespace {

constexpr std::uint32_t measurements = 8;  // of each task, of which the least counts

// What sharing costs (measured on two processors): waking and waiting, and each value that crosses between caches.
constexpr double handover = 700;             // ns
constexpr double crossing = 60;              // ns
constexpr double margin = 2;                 // gain over cost, at least
constexpr std::size_t parts_per_worker = 4;  // so that who is done first can help
constexpr double min_part = 2000;            // ns, unless there would be fewer parts than workers

constexpr double clock_cost = 25;  // ns, of reading the clock

double now() {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

StageTeam::StageTeam(std::size_t workers, Sharing sharing, const Plan& plan)
    : plan_(plan),
      workers_(workers, parts_per_worker * workers),
      sharing_(sharing),
      took_(sharing == Sharing::measure ? plan.order.size() : 0),
      costs_(plan.order.size()),
      widest_(plan.groups.size(), std::numeric_limits<double>::infinity()),
      unknown_(costs_.size()),
      parts_(workers_.parts()) {
  items_.reserve(plan.order.size());
  if (sharing == Sharing::measure) between_readings_ = thread_time_between_readings();
}

std::uint64_t StageTeam::run(bool digest, std::uint64_t instant_term) {
  if (items_.empty()) return 0;
  digest_ = digest;
  instant_term_ = instant_term;
  if (sharing_ == Sharing::measure) return run_timed();
  if (sharing_ == Sharing::if_it_pays && unknown_ > 0 && !all_known()) return run_measured();
  if (!divide()) {
    ++alone_;
    Part all{0, items_.size(), 0};
    run_part(all);
    return all.digest;
  }
  ++shared_;
  workers_.run(
      [](void* team, std::size_t part) {
        auto& self = *static_cast<StageTeam*>(team);
        self.run_part(self.parts_[part]);
      },
      this);
  std::uint64_t sum = 0;
  for (const Part& part : parts_) sum += part.digest;
  return sum;
}

bool StageTeam::may_share(std::span<const std::uint32_t> due) {
  if (sharing_ == Sharing::measure) return true;
  double cost = 0;
  for (const std::uint32_t g : due) cost += widest_of(plan_.groups[g], widest_[g]);
  if (!too_short(cost)) return true;
  ++alone_;
  return false;
}

double StageTeam::widest_of(const Plan::Group& group, double& known) const {
  if (known < std::numeric_limits<double>::infinity()) [[likely]]
    return known;
  double widest = 0;
  for (const Plan::Segment& segment : plan_.segments_of(group))
    for (const Indices& level : segment.levels.of(plan_.levels)) {
      double sum = 0;
      for (const std::uint32_t task : level.of(plan_.order)) {
        if (costs_[task].measured < measurements) return known;
        sum += costs_[task].min;
      }
      widest = std::max(widest, sum);
    }
  return known = widest;
}

bool StageTeam::too_short(double cost) const {
  return sharing_ == Sharing::if_it_pays && (workers_.count() == 1 || cost <= 2 * margin * handover);
}

bool StageTeam::all_known() const {
  return std::all_of(items_.begin(), items_.end(),
                     [&](const Item& item) { return costs_[item.activation->task].measured == measurements; });
}

std::uint64_t StageTeam::run_measured() {
  ++alone_;
  std::uint64_t digest = 0;
  double before = now();
  for (Item& item : items_) {
    run_item(item, digest);
    const double after = now();
    Cost& cost = costs_[item.activation->task];
    const double took = std::max(1.0, after - before - clock_cost);
    cost.min = std::min(cost.min, took);
    if (cost.measured < measurements && ++cost.measured == measurements) --unknown_;
    before = after;
  }
  return digest;
}

// The wall clock is quick to read but goes on while the thread is preempted, the thread's own does not: the less of the
// two is the closer.
std::uint64_t StageTeam::run_timed() {
  ++alone_;
  std::uint64_t digest = 0;
  for (Item& item : items_) {
    const Duration own_before = thread_time();
    const double before = now();
    run_item(item, digest);
    const double wall = now() - before - clock_cost;
    const Duration own = thread_time() - own_before - between_readings_;
    const Duration took = std::min(own, Duration(static_cast<std::int64_t>(std::ceil(wall))));
    took_[item.activation->task].add(std::max(Duration(1), took));
  }
  return digest;
}

// Parts of about equal time, in order, so that neighbours stay together. False: one worker is better.
bool StageTeam::divide() {
  double total = 0, largest = 0, connections = 0;
  for (const Item& item : items_) {
    total += cost_or_one(item);
    largest = std::max(largest, cost_or_one(item));
    connections += item.activation->connections;
  }
  const auto count = static_cast<double>(workers_.count());
  std::size_t parts = parts_.size();
  if (sharing_ == Sharing::if_it_pays) {
    if (items_.size() < 2 || too_short(total)) return false;
    const double gain = total - std::max(total / count, largest);
    if (gain <= margin * (handover + crossing * connections * (count - 1) / count)) return false;
    parts = std::clamp(static_cast<std::size_t>(total / min_part), workers_.count(), parts_.size());
  }
  for (Part& part : parts_) part = {};
  double sum = 0;
  std::size_t item = 0;
  for (std::size_t p = 0; p < parts; ++p) {
    Part& part = parts_[p * parts_.size() / parts];
    part.first = item;
    const double until = total * static_cast<double>(p + 1) / static_cast<double>(parts);
    for (; item < items_.size() && (p + 1 == parts || sum + 0.5 * cost_or_one(items_[item]) < until); ++item)
      sum += cost_or_one(items_[item]);
    part.last = item;
  }
  return true;
}

void StageTeam::run_part(Part& part) {
  std::uint64_t digest = 0;
  for (std::size_t i = part.first; i < part.last; ++i) run_item(items_[i], digest);
  part.digest = digest;
}

inline void StageTeam::run_item(Item& item, std::uint64_t& digest) const {
  const Activation& activation = *item.activation;
  running_task.begin(activation.memory, *item.tick);
  item.outcome = activation.run(activation.memory, *item.tick);
  running_task.end();
  if (item.outcome != Outcome::good || activation.publishes_deep) return;
  digest +=
      digest_ ? make_visible<true>(activation.publish, instant_term_) : make_visible<false>(activation.publish, 0);
}

}  // namespace jarol
