#include "graph/analysis/fixed_priority.h"

#include <algorithm>
#include <array>
#include <map>

namespace jarol::analysis {
namespace {

constexpr Duration far{std::int64_t{1} << 61};
constexpr std::uint64_t max_steps_of_all = 2'000'000'000;  // of all tasks together
constexpr std::int64_t max_in_period = 1'000'000;          // of one task in a busy period

// What more urgent tasks need, those of equal period and jitter together.
class Interference {
 public:
  void add(const TaskModel& model) {
    const auto [at, added] = index_.emplace(std::pair(model.period, model.jitter), work_.size());
    if (added) work_.push_back({model.period.count(), model.jitter.count(), 0});
    work_[at->second].wcet += model.wcet.count();
  }

  // Work (ns) of all that is released within a window (ns), or at its end, too, where that is closed.
  Wide demand(std::int64_t window, bool closed) const {
    Wide sum = 0;
    for (const Work& w : work_) {
      const std::int64_t reach = window + w.jitter;
      const std::int64_t count = closed ? reach / w.period + 1 : (reach + w.period - 1) / w.period;
      sum += static_cast<Wide>(count) * w.wcet;
    }
    return sum;
  }
  std::size_t size() const { return work_.size() + 1; }

 private:
  struct Work {
    std::int64_t period, jitter, wcet;  // ns
  };
  std::vector<Work> work_;
  std::map<std::pair<Duration, Duration>, std::size_t> index_;  // by period and jitter
};

// The least window that `need` maps to itself, from `start` on; nothing beyond `max`.
template <class Need>
std::optional<Duration> min_fixed_point(Duration start, Duration max, Budget& budget, std::size_t cost,
                                        const Need& need) {
  std::int64_t window = start.count();
  while (true) {
    const Wide next = need(window);
    if (!budget.spend(cost) || next > max.count()) return std::nullopt;
    if (next == window) return Duration(window);
    window = static_cast<std::int64_t>(next);
  }
}

// `repeats`: of activations so much later none responds later, as demand grows no more than time does; else far.
std::optional<Duration> preemptive_response(const TaskModel& model, const Interference& more_urgent, Duration repeats,
                                            Duration& first_window, Budget& budget) {
  // it does not run before the one above it has ended, and runs then
  Duration response{}, window = std::max(model.blocking, first_window) + model.wcet;
  for (std::int64_t q = 0;; ++q) {
    if (q == max_in_period) return std::nullopt;
    const Wide own = static_cast<Wide>(model.blocking.count()) + static_cast<Wide>(q + 1) * model.wcet.count();
    const auto end =
        min_fixed_point(std::max(window, Duration(static_cast<std::int64_t>(own))), far, budget, more_urgent.size(),
                        [&](std::int64_t w) { return own + more_urgent.demand(w, false); });
    if (!end) return std::nullopt;
    window = *end;
    if (q == 0) first_window = model.blocking == Duration{} ? window : first_window + model.wcet;
    response = std::max(response, window - q * model.period + model.jitter);
    if (window + model.jitter <= (q + 1) * model.period) return response;
    if ((q + 1) * model.period > repeats) return response;
  }
}

std::optional<Duration> nonpreemptive_response(const TaskModel& model, const Interference& more_urgent,
                                               Duration blocking, Duration repeats, Budget& budget) {
  Interference busy = more_urgent;
  busy.add(model);
  auto length = min_fixed_point(std::max(Duration(1), blocking), repeats, budget, busy.size(),
                                [&](std::int64_t w) { return blocking.count() + busy.demand(w, false); });
  if (!length && repeats < far) length = repeats;
  if (!length || *length / model.period > max_in_period) return std::nullopt;
  Duration response{}, start = blocking;
  // those that arrive later end at `length` at the latest, so that they respond within their jitter, as the first can't
  for (std::int64_t q = 0; q * model.period < *length; ++q) {
    const Wide own = static_cast<Wide>(blocking.count()) + static_cast<Wide>(q) * model.wcet.count();
    const auto found =
        min_fixed_point(std::max(start, Duration(static_cast<std::int64_t>(own))), far, budget, more_urgent.size(),
                        [&](std::int64_t w) { return own + more_urgent.demand(w, true); });
    if (!found) return std::nullopt;
    start = *found;
    response = std::max(response, start + model.wcet - q * model.period + model.jitter);
  }
  return response;
}

std::vector<std::optional<Duration>> responses_of(std::span<const TaskModel> models, bool preemptive, Budget& budget) {
  std::vector<std::optional<Duration>> responses(models.size());
  // by what has begun and can't be interrupted: at most all but its first nanosecond
  std::vector<Duration> longest_below(models.size());
  for (std::size_t i = models.size(); i-- > 1;)
    longest_below[i - 1] = std::max(longest_below[i], models[i].wcet - Duration(1));
  Interference more_urgent;
  Duration first_window{};
  long double used = 0;
  std::optional<Duration> repeats(1);
  for (std::size_t i = 0; i < models.size(); ++i) {
    used += static_cast<long double>(models[i].wcet.count()) / static_cast<long double>(models[i].period.count());
    // near to one without rounding
    const auto order =
        used < 1 - 1e-9L ? std::optional(std::strong_ordering::less) : compare_utilisation(models.first(i + 1), 1);
    if (!order || *order > 0) break;  // without bound from here on
    if (repeats) repeats = hyperperiod(std::array{TaskModel{.period = *repeats}, models[i]}, far);
    responses[i] = preemptive
                       ? preemptive_response(models[i], more_urgent, repeats.value_or(far), first_window, budget)
                       : nonpreemptive_response(models[i], more_urgent, std::max(longest_below[i], models[i].blocking),
                                                repeats.value_or(far), budget);
    more_urgent.add(models[i]);
  }
  return responses;
}

}  // namespace

std::vector<std::optional<Duration>> fixed_priority_responses(std::span<const TaskModel> models, bool preemptive,
                                                              Budget& budget) {
  return within(budget, max_steps_of_all, [&](Budget& own) { return responses_of(models, preemptive, own); });
}

}  // namespace jarol::analysis
