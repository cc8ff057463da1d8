#include "tests/graph/analysis/late_truth.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_set>

namespace jarol::truth {
namespace {

constexpr int longest_age = 100;

// A task's activations that have yet to end, oldest first.
struct Queue {
  int since = 0;  // the newest arrival; also of one that has ended
  int left = 0;   // that the oldest may still run
  int wait = 0;   // that the release of the newest may still be delayed
  bool released = false, started = false;
  std::vector<int> ages;
};

using Queues = std::vector<Queue>;

std::string key_of(const Queues& queues) {
  std::string key;
  for (const Queue& q : queues) {
    for (const int part : {q.since, q.left, q.wait, q.released ? 1 : 0, q.started ? 1 : 0})
      key += static_cast<char>(part);
    key += static_cast<char>(q.ages.size());
    for (const int age : q.ages) key += static_cast<char>(age);
  }
  return key;
}

class LateSearch {
 public:
  LateSearch(const Set& set, const std::vector<std::size_t>& core, const Places& places)
      : set_(set), core_(core), places_(places), producers_(set.tasks.size()), longest_(set.tasks.size(), 0) {
    for (const auto& [from, to] : set.feeds)
      if (!set.tasks[from].let) producers_[to].push_back(from);
    preemptive_ = set.policy == policies::fixed_priority || set.policy == policies::edf;
    by_priority_ = set.policy == policies::fixed_priority || set.policy == policies::fixed_priority_nonpreemptive;
  }

  std::optional<std::vector<int>> run(std::size_t max_states) {
    Queues first(set_.tasks.size());
    for (std::size_t i = 0; i < first.size(); ++i)
      first[i].since = set_.offsets_hold ? set_.tasks[i].period - set_.tasks[i].offset : set_.tasks[i].period;
    see(std::move(first));
    while (!open_.empty() && !grows_) {
      if (seen_.size() > max_states) return std::nullopt;
      Queues queues = std::move(open_.back());
      open_.pop_back();
      arrive(std::move(queues), 0);
    }
    return grows_ ? std::nullopt : std::optional(longest_);
  }

 private:
  void see(Queues queues) {
    if (seen_.insert(key_of(queues)).second) open_.push_back(std::move(queues));
  }

  void arrive(Queues queues, std::size_t i) {
    for (; i < queues.size(); ++i) {
      const Task& t = set_.tasks[i];
      Queue& q = queues[i];
      if (q.since < t.period) continue;
      if (!set_.offsets_hold) arrive(queues, i + 1);  // not yet
      grows_ = grows_ || (!q.ages.empty() && !q.released);
      if (q.ages.empty()) begin(q, t);
      q.ages.push_back(0);
      q.since = 0;
      q.wait = t.jitter;
      q.released = false;
    }
    release(std::move(queues), 0);
  }

  static void begin(Queue& q, const Task& t) {
    q.left = t.wcet;
    q.started = false;
  }

  void release(Queues queues, std::size_t i) {
    for (; i < queues.size(); ++i) {
      Queue& q = queues[i];
      if (q.ages.empty() || q.released) continue;
      if (q.wait > 0) {
        Queues other = queues;
        --other[i].wait;
        release(std::move(other), i + 1);
      }
      q.wait = 0;
      q.released = true;
    }
    dispatch(queues, 0);
  }

  bool eligible(const Queues& queues, std::size_t i) const {
    const Queue& q = queues[i];
    if (q.ages.size() == 1 && !q.released) return false;
    return std::none_of(producers_[i].begin(), producers_[i].end(), [&](std::size_t p) {
      const std::vector<int>& ages = queues[p].ages;
      return std::find(ages.begin(), ages.end(), q.ages.front()) != ages.end();
    });
  }

  std::tuple<int, int, std::size_t> urgency(const Queues& queues, std::size_t i) const {
    const Task& t = set_.tasks[i];
    const int age = queues[i].ages.front();
    if (set_.policy == policies::table) return {0, -age, places_.turn[i]};
    if (by_priority_) return {t.priority ? 0 : 1, t.priority.value_or(t.deadline), places_.order[i]};
    return {0, t.deadline - age, places_.order[i]};
  }

  std::vector<std::size_t> picked(const Queues& queues) const {
    std::vector<std::size_t> runs;
    for (std::size_t c = 0; c < static_cast<std::size_t>(set_.cores); ++c) {
      std::optional<std::size_t> best;
      for (std::size_t i = 0; i < queues.size(); ++i) {
        if (core_[i] != c || queues[i].ages.empty()) continue;
        if (set_.policy != policies::table && !eligible(queues, i)) continue;
        if (!preemptive_ && queues[i].started) {
          best = i;
          break;
        }
        if (!best || urgency(queues, i) < urgency(queues, *best)) best = i;
      }
      if (best && eligible(queues, *best)) runs.push_back(*best);
    }
    return runs;
  }

  // Each that runs may have ended before.
  void dispatch(const Queues& queues, unsigned decided) {
    const std::vector<std::size_t> runs = picked(queues);
    for (const std::size_t i : runs) {
      if ((decided >> i & 1) != 0) continue;
      Queues other = queues;
      end(other, i, 0);
      dispatch(other, decided);
      decided |= 1U << i;
    }
    advance(queues, runs);
  }

  void end(Queues& queues, std::size_t i, int later) {
    Queue& q = queues[i];
    longest_[i] = std::max(longest_[i], q.ages.front() + later);
    q.ages.erase(q.ages.begin());
    begin(q, set_.tasks[i]);
    if (q.ages.empty()) q.left = q.wait = q.released = 0;
  }

  void advance(Queues queues, const std::vector<std::size_t>& runs) {
    for (const std::size_t i : runs) {
      queues[i].started = !preemptive_;
      if (--queues[i].left == 0) end(queues, i, 1);
    }
    for (std::size_t i = 0; i < queues.size(); ++i) {
      Queue& q = queues[i];
      q.since = std::min(q.since + 1, set_.tasks[i].period);
      for (int& age : q.ages) grows_ = ++age > longest_age || grows_;
    }
    see(std::move(queues));
  }

  const Set& set_;
  const std::vector<std::size_t>& core_;
  const Places& places_;
  std::vector<std::vector<std::size_t>> producers_;
  bool preemptive_ = false, by_priority_ = false, grows_ = false;
  std::unordered_set<std::string> seen_;
  std::vector<Queues> open_;
  std::vector<int> longest_;
};

// Does a core have more to do than there is time?
bool overloaded(const Set& set, const std::vector<std::size_t>& core) {
  int repetition = 1;
  for (const Task& t : set.tasks) repetition = std::lcm(repetition, t.period);
  std::vector<int> work(static_cast<std::size_t>(set.cores), 0);
  for (std::size_t i = 0; i < core.size(); ++i) work[core[i]] += set.tasks[i].wcet * (repetition / set.tasks[i].period);
  return *std::max_element(work.begin(), work.end()) > repetition;
}

}  // namespace

std::optional<std::vector<int>> late_truth_of(const Set& set, const std::vector<std::size_t>& core,
                                              const Places& places, std::size_t max_states) {
  if (overloaded(set, core)) return std::nullopt;
  return LateSearch(set, core, places).run(max_states);
}

}  // namespace jarol::truth
