// What is true of a small task set, by trying everything: each execution time from 0 to the WCET, each release delay up
// to the jitter, each hold-up, each shift where shifts are possible. Shares no code with graph/analysis: it counts single
// units of time and follows states, not schedules, so that what repeats is seen to repeat.
//
// How `blocking` is read. Under `table` an activation that is held up keeps its turn, as if it took so much longer, and
// all behind it wait. Elsewhere each activation is judged with its own hold-up, in all up to `blocking` between release
// and end while its core does nothing else, and those of the producers that it follows at its instant, in full;
// hold-ups of others that are merely more urgent count in its own `blocking`, as in the literature.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/graph.h"

namespace jarol::truth {

struct Task {
  int wcet = 1, period = 2, deadline = 2, offset = 0, jitter = 0, blocking = 0;
  bool let = false;  // then its deadline is the end of its LET, or earlier, and readers don't follow it
  std::optional<int> priority, core;
};

/// Units of time are nanoseconds where a graph is made of it.
struct Set {
  Policy policy = Policy::table;
  bool offsets_hold = true;
  int cores = 1;
  std::vector<Task> tasks;  // named a, b, c ...
  std::vector<std::pair<std::size_t, std::size_t>> feeds;  // data flow: from, to
};

/// In which order tasks of one instant run (`turn`), and which is more urgent of equals (`order`): both per task.
struct Places {
  std::vector<std::size_t> turn, order;
};

struct Truth {
  enum class Answer { schedulable, late, too_large } answer = Answer::too_large;
  std::vector<int> longest;  // response per task, from the arrival; of all activations if schedulable
  std::string witness;       // a line for each unit of time
};

/// `core` is the core of each task; it does not matter under global EDF. Up to five tasks, no
/// number above 31, WCET and blocking together neither. Beyond `most_states` it is too large.
Truth truth_of(const Set& set, const std::vector<std::size_t>& core, const Places& places, std::size_t most_states);

}  // namespace jarol::truth
