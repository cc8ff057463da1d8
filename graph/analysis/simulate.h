// What happens on one core when every activation takes its WCET and arrives as the offsets say.
#pragma once

#include <functional>
#include <queue>

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

enum class Order { by_priority, by_deadline };

/// The first activation that ends after its deadline.
struct DeadlineMiss {
  std::size_t task = 0;
  std::int64_t activation = 0;
  Duration release{};
  Duration finish{};
  Duration deadline{};  // absolute
  bool ended = true;    // else it had not by `finish`, where the run ended
};

/// A piece of one activation without interruption.
struct Slice {
  std::size_t task = 0;
  std::int64_t activation = 0;
  Duration begin{};
  Duration end{};
};

template <class T>
using MinFirst = std::priority_queue<T, std::vector<T>, std::greater<>>;

inline constexpr std::size_t max_slices = 200;  // before what is late

/// Drops so many of the first; of what ran from `from` on none is missing afterwards.
void drop_first(std::vector<Slice>& slices, std::size_t n, Duration& from);

struct Simulation {
  bool whole = true;  // reached its end
  std::uint64_t activations = 0;
  std::optional<DeadlineMiss> late;
  std::vector<Duration> responses;  // per task, the longest of those that ended
  std::vector<Slice> slices;        // the last ones before the late activation ended
  Duration slices_from{};           // of what ran later none is missing there
};

/// Until all that was released before `until` has ended, what is released meanwhile with it, up to 20,000; or up to the
/// first late activation, or so many. Of these one may be late that has not ended by then. Ties: the task that stands
/// first.
Simulation simulate(std::span<const TaskModel> models, Order order, bool preemptive, Duration until,
                    std::uint64_t max_activations = 2'000'000);

/// Interrupting, until one hyperperiod after all offsets leaves the same work as the one before: responses are of all
/// activations there will ever be. Up to the first late activation, unless `beyond_late`: what is late runs to its end.
Simulation simulate_repetition(std::span<const TaskModel> models, Order order, bool beyond_late,
                               std::uint64_t max_activations);

}  // namespace jarol::analysis
