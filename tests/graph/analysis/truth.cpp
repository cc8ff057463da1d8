// In one file: one search, whose steps share the state.
#include "tests/graph/analysis/truth.h"

#include <algorithm>
#include <tuple>

#include "tests/graph/analysis/truth_states.h"

namespace jarol::truth {
namespace {

class Search {
 public:
  Search(const Set& set, const std::vector<std::size_t>& core, const Places& places)
      : set_(set), core_(core), places_(places), producers_(set.tasks.size()), n_(set.tasks.size()) {
    using namespace policies;
    const Policy& policy = set.policy;
    by_table_ = policy == table;
    by_priority_ = policy == fixed_priority || policy == fixed_priority_nonpreemptive;
    global_ = policy == global_edf;
    preemptive_ = policy == fixed_priority || policy == edf || global_;
    for (const auto& [from, to] : set.feeds)
      if (!set.tasks[from].let) producers_[to].push_back(from);
    truth_.longest.resize(n_, 0);
    nonpreemptive_ = !takes_longer() && !preemptive_ &&
                     std::any_of(set.tasks.begin(), set.tasks.end(), [](const Task& t) { return t.blocking > 0; });
  }

  Truth run(std::size_t max_states) {
    State first;
    for (std::size_t i = 0; i < n_; ++i) {
      const Task& t = set_.tasks[i];
      first.slots[i].age = static_cast<std::uint8_t>(set_.offsets_hold ? t.period - t.offset : t.period);
    }
    seen_.add(key_of(first), root);
    // depth first finds a late activation soon; the newest states stand last
    std::vector<std::size_t> open{0};
    while (!open.empty() && !late_) {
      if (seen_.size() > max_states) return truth_;
      from_ = open.back();
      open.pop_back();
      const std::size_t before = seen_.size();
      const State s = state_of(seen_[from_].key);
      if (nonpreemptive_) begin_piece(s, 0);
      arrive(s, 0);
      for (std::size_t i = before; i < seen_.size(); ++i) open.push_back(i);
    }
    if (late_) {
      truth_.answer = Truth::Answer::late;
    } else if (!lost_) {
      truth_.answer = Truth::Answer::schedulable;
    }
    return truth_;
  }

 private:
  // Where it is time of the core, an activation that is held up just takes longer.
  bool takes_longer() const { return by_table_ || global_; }

  // 0. under a non-preemptive policy something holds up a core that ran nothing just before: the judged, or a producer
  // that it follows there
  void begin_piece(const State& s, std::size_t first_core) {
    for (std::size_t c = first_core; c < static_cast<std::size_t>(set_.cores); ++c) {
      if (s.busy[c] || s.whose[c] != nobody) continue;
      for (std::size_t task = 0; task < n_; ++task) {
        if (s.judged != nobody && s.judged != task) continue;
        for (std::size_t whose = 0; whose < n_; ++whose) {
          if (core_[whose] != c || set_.tasks[whose].blocking == 0 || !follows(task, whose)) continue;
          State held = s;
          held.judged = task;
          held.others = is_by_itself(c);
          held.piece[c] = static_cast<std::uint8_t>(set_.tasks[whose].blocking);
          held.whose[c] = static_cast<std::uint8_t>(whose);
          begin_piece(held, c + 1);
          arrive(held, 0);
        }
      }
    }
  }
  bool follows(std::size_t task, std::size_t producer) const {
    return task == producer || std::any_of(producers_[task].begin(), producers_[task].end(),
                                           [&](std::size_t p) { return follows(p, producer); });
  }

  bool is_judged(const State& s, std::size_t task) const {
    return s.judged == task || (s.others && core_[task] == core_[s.judged]);
  }
  // Nobody there waits for other cores, or they for it.
  bool is_by_itself(std::size_t core) const {
    return set_.cores == 1 || std::none_of(set_.feeds.begin(), set_.feeds.end(), [&](const auto& feed) {
             return !set_.tasks[feed.first].let && (core_[feed.first] == core || core_[feed.second] == core);
           });
  }

  // 1. who arrives
  void arrive(State s, std::size_t i) {
    for (; i < n_; ++i) {
      const Task& t = set_.tasks[i];
      Slot& slot = s.slots[i];
      if (slot.age < t.period) continue;
      if (slot.pending) {  // only beside a hold-up, which judges another
        lost_ = true;
        return;
      }
      if (!set_.offsets_hold) arrive(s, i + 1);  // not yet
      slot = {};
      slot.pending = true;
      slot.left = static_cast<std::uint8_t>(t.wcet + (takes_longer() ? t.blocking : 0));
      slot.wait = static_cast<std::uint8_t>(t.jitter);
    }
    if (!takes_longer() && preemptive_ && s.judged == nobody)
      for (std::size_t held = 0; held < n_; ++held)
        if (s.slots[held].pending && s.slots[held].age == 0) hold_up(s, held);
    release(s, 0);
  }

  // 2. whether it is this activation that is held up, with its producers
  void hold_up(State s, std::size_t task) {
    s.judged = task;
    if (give_budget(s, task) > 0) release(s, 0);
  }
  int give_budget(State& s, std::size_t task) {
    int all = set_.tasks[task].blocking;
    s.slots[task].budget = static_cast<std::uint8_t>(all);
    for (const std::size_t p : producers_[task])
      if (s.slots[p].pending && s.slots[p].age == 0) all += give_budget(s, p);
    return all;
  }

  // 3. who is released
  void release(State s, std::size_t i) {
    for (; i < n_; ++i) {
      Slot& slot = s.slots[i];
      if (!slot.pending || slot.released) continue;
      if (slot.wait > 0) {
        --slot.wait;
        release(s, i + 1);
        ++slot.wait;
      }
      slot.wait = 0;
      slot.released = true;
    }
    dispatch(s, 0, 0);
    if (s.judged == nobody || preemptive_) return;
    for (std::size_t c = 0; c < max_cores; ++c)  // what holds up may end sooner
      if (s.piece[c] > 0) {
        s.piece[c] = 0;
        dispatch(s, 0, 0);
      }
  }

  bool eligible(const State& s, std::size_t i) const {
    if (!s.slots[i].pending || !s.slots[i].released) return false;
    return std::none_of(producers_[i].begin(), producers_[i].end(),
                        [&](std::size_t p) { return s.slots[p].pending && s.slots[p].age == s.slots[i].age; });
  }

  using Urgency = std::tuple<int, int, std::size_t>;  // smaller is more urgent
  Urgency urgency(const State& s, std::size_t i) const {
    const Task& t = set_.tasks[i];
    if (by_table_) return {0, -s.slots[i].age, places_.turn[i]};
    if (by_priority_) return {t.priority ? 0 : 1, t.priority.value_or(t.deadline), places_.order[i]};
    return {0, t.deadline - s.slots[i].age, global_ ? i : places_.order[i]};
  }

  // The tasks that the policy runs now, as bits.
  unsigned picked(const State& s) const {
    unsigned bits = 0;
    for (int c = 0; c < set_.cores; ++c) {
      if (s.piece[static_cast<std::size_t>(c)] > 0) continue;
      std::size_t best = nobody;
      for (std::size_t i = 0; i < n_; ++i) {
        if (!s.slots[i].pending || (bits >> i & 1) != 0) continue;
        if (!global_ && core_[i] != static_cast<std::size_t>(c)) continue;
        if (!by_table_ && !eligible(s, i)) continue;
        if (!preemptive_ && s.slots[i].started) {
          best = i;
          break;
        }
        if (best == nobody || urgency(s, i) < urgency(s, best)) best = i;
      }
      if (best != nobody && eligible(s, best)) bits |= 1U << best;
    }
    return bits;
  }

  // 4. who runs for the next unit, who is held up, who has ended before
  void dispatch(const State& s, unsigned decided, unsigned held) {
    const unsigned runs = picked(s);
    for (std::size_t i = 0; i < n_; ++i) {
      if ((runs >> i & 1) == 0 || (decided >> i & 1) != 0) continue;
      State other = s;
      if (s.slots[i].budget > 0) {
        for (std::size_t j = 0; j < n_; ++j)  // it strikes a core once, and holds up all that it can there
          if (core_[j] == core_[i] && other.slots[j].budget > 0) --other.slots[j].budget;
        dispatch(other, decided | 1U << i, held | 1U << i);
        other = s;
      }
      if (end(other, i, s.slots[i].age)) dispatch(other, decided, held);
      return dispatch(s, decided | 1U << i, held);
    }
    advance(s, runs & ~held);
  }

  // False where there is nothing more to see.
  bool end(State& s, std::size_t task, int response) {
    if (s.judged == nobody || (is_judged(s, task) && counts(s)))
      truth_.longest[task] = std::max(truth_.longest[task], response);
    const std::uint8_t age = s.slots[task].age;
    s.slots[task] = {};
    s.slots[task].age = age;
    return s.judged != task || nonpreemptive_;
  }

  // 5. a unit of time
  void advance(State s, unsigned runs) {
    if (late_) return;
    if (nonpreemptive_) {
      s.busy = {};
      for (std::size_t i = 0; i < n_; ++i)
        if ((runs >> i & 1) != 0) s.busy[core_[i]] = true;
      for (std::size_t c = 0; c < max_cores; ++c)
        if (s.piece[c] > 0) {
          s.others = s.others && !would_interrupt(s, c);
          --s.piece[c];
          s.busy[c] = true;
        }
    }
    for (std::size_t i = 0; i < n_; ++i) {
      if ((runs >> i & 1) == 0) continue;
      s.slots[i].started = !preemptive_;
      if (--s.slots[i].left == 0 && !end(s, i, s.slots[i].age + 1)) return;
    }
    bool late = false;
    for (std::size_t i = 0; i < n_; ++i) {
      Slot& slot = s.slots[i];
      if (slot.age < set_.tasks[i].period + (nonpreemptive_ ? 1 : 0)) ++slot.age;
      late = late || (slot.pending && slot.age >= set_.tasks[i].deadline && (s.judged == nobody || is_judged(s, i)));
    }
    if (s.judged != nobody && nonpreemptive_ && over(s)) return;
    if (late && counts(s)) {
      late_ = true;
      report(s);
    } else {
      seen_.add(key_of(s), from_);
    }
  }

  // Somebody waits for what holds up a core who can't be held up for so long, and for nobody who can.
  bool would_interrupt(const State& s, std::size_t c) const {
    const Slot& held = s.slots[s.judged];
    for (std::size_t i = 0; i < n_; ++i) {
      if (core_[i] != c || i == s.judged || !s.slots[i].pending || !s.slots[i].released) continue;
      const bool waits_for_held = held.pending && held.released && urgency(s, s.judged) < urgency(s, i);
      if (!waits_for_held && set_.tasks[i].blocking < set_.tasks[s.whose[c]].blocking) return true;
    }
    return false;
  }

  // Nothing of what held up a core is felt any more where the judged runs.
  bool over(const State& s) const {
    for (std::size_t c = 0; c < static_cast<std::size_t>(set_.cores); ++c) {
      if (s.busy[c]) return false;
      for (std::size_t p = 0; p < n_ && s.whose[c] == nobody; ++p)
        if (core_[p] == c && set_.tasks[p].blocking > 0 && follows(s.judged, p)) return false;
    }
    return true;
  }
  // Only who arrives with its reader, and all between them, holds it up.
  bool counts(const State& s) const {
    return s.judged == nobody || std::all_of(s.whose.begin(), s.whose.end(), [&](std::size_t whose) {
             return whose == nobody || follows_now(s, s.judged, whose);
           });
  }
  bool follows_now(const State& s, std::size_t task, std::size_t producer) const {
    return task == producer || std::any_of(producers_[task].begin(), producers_[task].end(), [&](std::size_t p) {
             return s.slots[p].age == s.slots[task].age && follows_now(s, p, producer);
           });
  }

  void report(const State& last) {
    std::vector<State> states{last};
    for (std::size_t i = from_; i != root; i = seen_[i].from) states.push_back(state_of(seen_[i].key));
    std::reverse(states.begin(), states.end());
    for (std::size_t time = 0; time < states.size(); ++time) {
      truth_.witness += std::to_string(time) + ":";
      for (std::size_t i = 0; i < n_; ++i) {
        const Slot& slot = states[time].slots[i];
        if (!slot.pending) continue;
        truth_.witness += std::string(" ") + static_cast<char>('a' + i) + " since " + std::to_string(slot.age) +
                          (slot.released ? " left " + std::to_string(slot.left) : " not released");
        if (slot.budget > 0) truth_.witness += " hold-up left " + std::to_string(slot.budget);
      }
      for (std::size_t c = 0; c < max_cores; ++c)
        if (states[time].piece[c] > 0)
          truth_.witness += " core " + std::to_string(c) + " held up for " + std::to_string(states[time].piece[c]);
      truth_.witness += "\n";
    }
  }

  const Set& set_;
  const std::vector<std::size_t>& core_;
  const Places& places_;
  std::vector<std::vector<std::size_t>> producers_;
  std::size_t n_;
  bool by_table_ = false, by_priority_ = false, preemptive_ = false, global_ = false;
  bool nonpreemptive_ = false;  // and something may hold up
  Seen seen_;
  std::size_t from_ = 0;
  bool late_ = false, lost_ = false;
  Truth truth_;
};

}  // namespace

Truth truth_of(const Set& set, const std::vector<std::size_t>& core, const Places& places, std::size_t max_states) {
  return Search(set, core, places).run(max_states);
}

}  // namespace jarol::truth
