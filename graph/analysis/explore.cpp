#include "graph/analysis/explore.h"

#include <algorithm>
#include <map>

#include "graph/analysis/readiness.h"

namespace jarol::analysis {
namespace {

// When the core may be free next.
struct Free {
  Duration earliest{}, latest{};
  std::int64_t repetitions = 0;  // that were taken off
};

// What holds up, once: it has not begun; it goes on, and those that it can't hold up interrupt it; it is over.
enum HoldUp : std::int64_t { before, under_way, over };
using Started = std::vector<std::int64_t>;  // per task, how many of its activations; at the end the HoldUp
using States = std::map<Started, std::vector<Free>>;

// Unites what meets; false if that was known already.
bool add(std::vector<Free>& intervals, Free added) {
  for (const Free& f : intervals)
    if (f.earliest <= added.earliest && added.latest <= f.latest) return false;
  for (std::size_t i = 0; i < intervals.size();) {
    const Free& f = intervals[i];
    if (f.latest + Duration(1) < added.earliest || added.latest + Duration(1) < f.earliest) {
      ++i;
      continue;
    }
    added.earliest = std::min(added.earliest, f.earliest);
    added.latest = std::max(added.latest, f.latest);
    intervals.erase(intervals.begin() + static_cast<std::ptrdiff_t>(i));
  }
  intervals.push_back(added);
  return true;
}

class Explorer {
 public:
  Explorer(const CoreTasks& tasks, Order order, Budget& budget)
      : loads_(tasks.models),
        order_(order),
        budget_(budget),
        producers_(tasks.models.size()),
        inherited_(inheriting_loads(tasks)),
        ready_at_(tasks) {
    result_.responses.resize(loads_.size());
    jitters_ = std::any_of(loads_.begin(), loads_.end(), [](const TaskModel& m) { return m.jitter > Duration{}; });
    for (const auto& [producer, reader] : tasks.follows) producers_[reader].push_back(producer);
  }

  Exploration run() {
    const auto lcm = hyperperiod(loads_, max_time / 8);
    if (!lcm || loads_.empty()) return std::move(result_);
    repetition_ = *lcm;
    std::vector<Duration> lengths{Duration{}};
    for (const TaskModel& m : loads_)
      if (std::find(lengths.begin(), lengths.end(), m.blocking) == lengths.end()) lengths.push_back(m.blocking);
    // first who is late for sure by what may hold up itself, then whoever may be late by what holds up others
    for (const bool all_count : {false, true})
      for (const Duration length : lengths) {
        if (all_count && length == Duration{}) continue;
        all_count_ = all_count;
        if (!run_with(length)) return std::move(result_);
      }
    result_.whole = true;
    return std::move(result_);
  }

 private:
  // Held up once, for `blocking`: that is what is left of it at most when one starts that waited for it.
  bool run_with(Duration blocking) {
    blocking_ = blocking;
    known_.clear();
    // idle before it began
    States now{{Started(loads_.size() + 1, 0), {Free{Duration(-1), Duration(-1), 0}}}};
    while (!now.empty()) {
      next_.clear();
      for (const auto& [started, intervals] : now)
        for (const Free& free : intervals)
          if (!go_on(started, free)) return false;
      now.swap(next_);
    }
    return true;
  }

  struct Next {
    std::size_t task;
    Duration arrival, latest;
    std::int64_t urgency;  // less first
  };

  // Those that may start next: of each task the first, where what it follows has started.
  void find_candidates(const Started& started) {
    candidates_.clear();
    for (std::size_t i = 0; i < loads_.size(); ++i) {
      const TaskModel& m = loads_[i];
      const Duration arrival = m.offset + started[i] * m.period;
      const auto waits_for = [&](std::size_t p) {
        const Duration since = arrival - loads_[p].offset;
        return since >= Duration{} && since % loads_[p].period == Duration{} && started[p] <= since / loads_[p].period;
      };
      if (std::any_of(producers_[i].begin(), producers_[i].end(), waits_for)) continue;
      candidates_.push_back(
          {i, arrival, arrival + m.jitter,
           order_ == Order::by_priority ? static_cast<std::int64_t>(i) : (arrival + m.deadline).count()});
    }
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Next& a, const Next& b) { return std::pair(a.urgency, a.task) < std::pair(b.urgency, b.task); });
  }

  // Everything that can start when the core is free; false if one may be late, or there is no more effort.
  bool go_on(const Started& started, const Free& free) {
    if (!budget_.spend(20 * loads_.size())) return false;
    find_candidates(started);
    Duration any = max_time;  // by then one is released for sure
    for (const Next& c : candidates_) any = std::min(any, c.latest);
    const std::int64_t hold_up = started.back();
    if (blocking_ > Duration{} && hold_up == before && any > free.earliest) {
      Started held = started;
      held.back() = under_way;
      put(std::move(held), {free.earliest + Duration(1), all_count_ ? any : any + blocking_, free.repetitions});
    }
    const auto is_held_up = [&](const Next& c) {
      return hold_up == under_way && blocking_ <= inherited_[c.task].blocking;
    };
    // who is less urgent than one that waits does not interrupt
    Duration one_interrupts = max_time, one_waits = max_time;
    for (const Next& c : candidates_) {
      if (is_held_up(c))
        one_waits = std::min(one_waits, c.latest);
      else if (c.latest < one_waits)
        one_interrupts = std::min(one_interrupts, c.latest);
    }
    // by then one starts that waited for it, or one that interrupts it
    const Duration waited = std::max(free.latest, any) + blocking_;
    const Duration interrupted = std::max(free.latest, std::min(one_interrupts, waited));
    Duration more_urgent = max_time;  // by then one that goes before is
    for (const Next& c : candidates_) {
      const bool waits = all_count_ && is_held_up(c);
      const Duration busy = !all_count_ || hold_up != under_way ? std::max(free.latest, any)
                            : waits                             ? waited
                                                                : interrupted;
      const Duration from = std::max(free.earliest, c.arrival), to = std::min(busy, more_urgent - Duration(1));
      more_urgent = std::min(more_urgent, c.latest);
      if (from > to) continue;
      const TaskModel& m = loads_[c.task];
      const Duration finish = to + m.wcet;
      const bool counts = all_count_ || hold_up == before || is_held_up(c);
      if (counts) result_.responses[c.task] = std::max(result_.responses[c.task], finish - c.arrival);
      if (counts && finish > c.arrival + m.deadline) {
        // for sure only by what holds up those of its instant
        const Duration sure = jitters_ ? m.blocking : ready_at_(c.task, c.arrival).blocking;
        if (hold_up != before && (all_count_ || blocking_ > sure)) return !(doubtful_ = true);
        const Duration shift = free.repetitions * repetition_;
        result_.late = DeadlineMiss{c.task, started[c.task] + shift / m.period, c.arrival + shift, finish + shift,
                                    c.arrival + m.deadline + shift};
        result_.whole = true;
        return false;
      }
      Started next = started;
      ++next[c.task];
      if (waits) next.back() = over;
      put(std::move(next), {from, finish, free.repetitions});
    }
    return true;
  }

  void put(Started started, Free free) {
    const auto done = [&](std::size_t i) { return started[i] >= repetition_ / loads_[i].period; };
    bool all = true;
    for (std::size_t i = 0; i < loads_.size() && all; ++i) all = done(i);
    if (all) {
      for (std::size_t i = 0; i < loads_.size(); ++i) started[i] -= repetition_ / loads_[i].period;
      free = {free.earliest - repetition_, free.latest - repetition_, free.repetitions + 1};
    }
    if (add(known_[started], free)) add(next_[started], free);
  }

  TaskModels loads_;
  Order order_;
  Budget& budget_;
  std::vector<std::vector<std::size_t>> producers_;
  std::vector<Next> candidates_;
  Duration repetition_{}, blocking_{};
  TaskModels inherited_;
  ReadinessAt ready_at_;
  bool jitters_ = false, doubtful_ = false, all_count_ = false;
  States known_, next_;
  Exploration result_;
};

}  // namespace

Exploration explore(const CoreTasks& tasks, Order order, Budget& budget) {
  constexpr std::uint64_t max_steps = 30'000'000;
  return within(budget, max_steps, [&](Budget& own) { return Explorer(tasks, order, own).run(); });
}

}  // namespace jarol::analysis
