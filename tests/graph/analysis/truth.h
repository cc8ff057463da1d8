// What is true of a small task set, by trying everything: each execution time from 0 to the WCET, each release delay up
// to the jitter, each hold-up, each shift where shifts are possible. Shares no code with graph/analysis: it counts
// single units of time and follows states, not schedules, so that what repeats is seen to repeat.
//
// `blocking` is read as graph/analysis/README.md says. In a table and under global EDF an activation just takes so much
// longer. Elsewhere one activation is judged with a hold-up of its own core that strikes once, up to its `blocking`:
// under preemptive policies at any time between its release and its end, under the others begun while the core ran
// nothing. There, on a core by itself, all count that start behind. The producers that it follows at its instant are
// held up too; on its core that is one hold-up for all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/analysis/policies.h"
#include "graph/model/graph.h"

namespace jarol::truth {

struct Task {
  int wcet = 1, period = 2, deadline = 2, offset = 0, jitter = 0, blocking = 0;
  bool let = false;  // then its deadline is the end of its LET, or earlier, and readers don't follow it
  std::optional<int> priority, core;
};

/// Units of time are nanoseconds where a graph is made of it.
struct Set {
  Policy policy = policies::table;
  bool offsets_hold = true;
  int cores = 1;
  std::vector<Task> tasks;                                 // named a, b, c ...
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

/// `core` is the core of each task; it does not matter under global EDF. Up to five tasks on
/// two cores (global EDF: any), no time above 31, jitter and blocking up to 15. Beyond `max_states` it is too large.
Truth truth_of(const Set& set, const std::vector<std::size_t>& core, const Places& places, std::size_t max_states);

}  // namespace jarol::truth
