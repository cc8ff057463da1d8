#include "graph/analysis/simulate.h"

#include <algorithm>
#include <tuple>

namespace jarol::analysis {
namespace {

struct Arrival {
  std::int64_t time;
  std::size_t task;
  std::int64_t activation;
  bool operator>(const Arrival& other) const { return std::tie(time, task) > std::tie(other.time, other.task); }
};

struct Ready {
  std::int64_t urgency;  // less first
  std::size_t task;
  std::int64_t activation;
  std::int64_t release;
  std::int64_t left;
  bool operator>(const Ready& other) const {
    return std::tie(urgency, task, activation) > std::tie(other.urgency, other.task, other.activation);
  }
};

}  // namespace

Simulation simulate(std::span<const Load> loads, Order order, bool preemptive, std::int64_t until,
                    std::uint64_t most_activations) {
  Simulation result;
  result.responses.resize(loads.size(), 0);
  LeastFirst<Arrival> arrivals;
  LeastFirst<Ready> ready;
  for (std::size_t i = 0; i < loads.size(); ++i) arrivals.push({loads[i].offset, i, 0});
  std::int64_t now = 0;
  const auto arrive = [&](std::int64_t time) {
    while (!arrivals.empty() && arrivals.top().time <= time && arrivals.top().time < until &&
           result.activations <= most_activations) {
      const Arrival a = arrivals.top();
      arrivals.pop();
      const Load& l = loads[a.task];
      const std::int64_t urgency =
          order == Order::by_priority ? static_cast<std::int64_t>(a.task) : a.time + l.deadline;
      ready.push({urgency, a.task, a.activation, a.time, l.wcet});
      arrivals.push({a.time + l.period, a.task, a.activation + 1});
      ++result.activations;
    }
  };
  while (true) {
    arrive(now);
    if (result.activations > most_activations) {
      result.whole = false;
      return result;
    }
    if (ready.empty()) {
      if (arrivals.empty() || arrivals.top().time >= until) return result;
      now = arrivals.top().time;
      continue;
    }
    Ready running = ready.top();
    ready.pop();
    const std::int64_t end = now + running.left;
    const std::int64_t next = arrivals.empty() || arrivals.top().time >= until ? end : arrivals.top().time;
    const std::int64_t stop = preemptive ? std::min(end, next) : end;
    if (result.slices.size() >= 2 * most_slices)
      result.slices.erase(result.slices.begin(), result.slices.begin() + most_slices);
    if (!result.slices.empty() && result.slices.back().task == running.task &&
        result.slices.back().activation == running.activation && result.slices.back().end == now) {
      result.slices.back().end = stop;
    } else {
      result.slices.push_back({running.task, running.activation, now, stop});
    }
    running.left -= stop - now;
    now = stop;
    if (running.left > 0) {
      ready.push(running);
      continue;
    }
    const std::int64_t deadline = running.release + loads[running.task].deadline;
    std::int64_t& response = result.responses[running.task];
    response = std::max(response, now - running.release);
    if (now > deadline) {
      result.late = Late{running.task, running.activation, running.release, now, deadline};
      return result;
    }
  }
}

}  // namespace jarol::analysis
