#include "graph/analysis/simulate.h"

#include <algorithm>
#include <tuple>

namespace jarol::analysis {
namespace {

constexpr Duration no_time = Duration::max();
constexpr Duration end_of_time{std::int64_t{1} << 62};
constexpr std::uint64_t max_meanwhile = 20'000;  // activations that a run waits for the end of those before

struct Arrival {
  Duration time;
  std::size_t task;
  std::int64_t activation;
  bool operator>(const Arrival& other) const { return std::tie(time, task) > std::tie(other.time, other.task); }
};

struct Ready {
  std::int64_t urgency;  // less first
  std::size_t task;
  std::int64_t activation;
  Duration release;
  Duration left;
  bool operator>(const Ready& other) const {
    return std::tie(urgency, task, activation) > std::tie(other.urgency, other.task, other.activation);
  }
};

struct CoreRules {
  Order order = Order::by_priority;
  bool preemptive = true;
  bool beyond_late = false;
  Duration last = no_time;  // the run ends with what arrives before
  std::uint64_t max_activations = 0;
};

class CoreSimulator {
 public:
  CoreSimulator(std::span<const TaskModel> models, const CoreRules& rules) : loads_(models), rules_(rules) {
    result_.responses.resize(models.size());
    for (std::size_t i = 0; i < models.size(); ++i) arrivals_.push({models[i].offset, i, 0});
  }

  // Up to what arrives at that instant. False if an activation is late that ends the run, or there are too many.
  bool run_until(Duration end) {
    while (now_ < end) {
      arrive();
      if (result_.activations > rules_.max_activations || meanwhile_ > max_meanwhile) return give_up();
      if (open_ == 0 && next_arrival() >= rules_.last) return true;
      if (ready_.empty()) {
        now_ = std::min(end, next_arrival());
        continue;
      }
      Ready running = ready_.top();
      ready_.pop();
      const Duration finish = now_ + running.left;
      const Duration stop = rules_.preemptive ? std::min({finish, next_arrival(), end}) : finish;
      if (!result_.late) add_slice(running, stop);
      running.left -= stop - now_;
      now_ = stop;
      if (running.left > Duration{}) {
        ready_.push(running);
      } else if (!close(running)) {
        return false;
      }
    }
    return true;
  }

  // Activations that have yet to end, and their work: with the arrivals all that the future depends on, as those of one
  // task run in turn.
  std::vector<std::pair<std::int64_t, Duration>> left() const {
    std::vector<std::pair<std::int64_t, Duration>> sum(loads_.size());
    for (MinFirst<Ready> ready = ready_; !ready.empty(); ready.pop()) {
      ++sum[ready.top().task].first;
      sum[ready.top().task].second += ready.top().left;
    }
    return sum;
  }

  bool is_open() const { return open_ > 0; }

  // Late is then what has not ended, and whose deadline is longest past.
  bool give_up() {
    result_.whole = false;
    if (result_.late) return false;
    for (MinFirst<Ready> ready = ready_; !ready.empty(); ready.pop()) {
      const Ready& r = ready.top();
      const Duration deadline = r.release + loads_[r.task].deadline;
      if (deadline < (result_.late ? result_.late->deadline : now_))
        result_.late = DeadlineMiss{r.task, r.activation, r.release, now_, deadline, false};
    }
    return false;
  }

  Simulation& result() { return result_; }

 private:
  Duration next_arrival() const { return arrivals_.empty() ? no_time : arrivals_.top().time; }

  void arrive() {
    while (next_arrival() <= now_ && result_.activations <= rules_.max_activations) {
      const Arrival a = arrivals_.top();
      arrivals_.pop();
      const TaskModel& m = loads_[a.task];
      const std::int64_t urgency =
          rules_.order == Order::by_priority ? static_cast<std::int64_t>(a.task) : (a.time + m.deadline).count();
      ready_.push({urgency, a.task, a.activation, a.time, m.wcet});
      arrivals_.push({a.time + m.period, a.task, a.activation + 1});
      ++result_.activations;
      ++(a.time < rules_.last ? open_ : meanwhile_);
    }
  }

  void add_slice(const Ready& running, Duration stop) {
    std::vector<Slice>& slices = result_.slices;
    if (slices.size() >= 2 * max_slices) drop_first(slices, max_slices, result_.slices_from);
    if (!slices.empty() && slices.back().task == running.task && slices.back().activation == running.activation &&
        slices.back().end == now_) {
      slices.back().end = stop;
    } else {
      slices.push_back({running.task, running.activation, now_, stop});
    }
  }

  bool close(const Ready& ended) {
    const Duration deadline = ended.release + loads_[ended.task].deadline;
    if (ended.release < rules_.last) --open_;
    Duration& response = result_.responses[ended.task];
    response = std::max(response, now_ - ended.release);
    if (now_ > deadline && !result_.late)
      result_.late = DeadlineMiss{ended.task, ended.activation, ended.release, now_, deadline};
    return !result_.late || rules_.beyond_late;
  }

  std::span<const TaskModel> loads_;
  const CoreRules rules_;
  Duration now_{};
  MinFirst<Arrival> arrivals_;
  MinFirst<Ready> ready_;
  std::uint64_t open_ = 0;       // that arrived before the last instant and have not ended
  std::uint64_t meanwhile_ = 0;  // that arrived from then on
  Simulation result_;
};

}  // namespace

void drop_first(std::vector<Slice>& slices, std::size_t n, Duration& from) {
  const auto end = slices.begin() + static_cast<std::ptrdiff_t>(n);
  for (auto s = slices.begin(); s != end; ++s) from = std::max(from, s->end);
  slices.erase(slices.begin(), end);
}

Simulation simulate(std::span<const TaskModel> models, Order order, bool preemptive, Duration until,
                    std::uint64_t max_activations) {
  CoreSimulator simulator(models, {order, preemptive, false, until, max_activations});
  if (simulator.run_until(end_of_time) && simulator.is_open()) simulator.give_up();
  return std::move(simulator.result());
}

Simulation simulate_repetition(std::span<const TaskModel> models, Order order, bool beyond_late,
                               std::uint64_t max_activations) {
  CoreSimulator simulator(models, {order, true, beyond_late, no_time, max_activations});
  const auto lcm = hyperperiod(models, max_time / 4);
  Duration end{};
  for (const TaskModel& m : models) end = std::max(end, m.offset);
  bool on = lcm && simulator.run_until(end), repeats = false;
  for (auto before = simulator.left(); on && !repeats && end <= max_time - *lcm;) {
    end += *lcm;
    on = simulator.run_until(end);
    auto after = simulator.left();
    repeats = on && after == before;
    before = std::move(after);
  }
  simulator.result().whole = repeats;
  return std::move(simulator.result());
}

}  // namespace jarol::analysis
