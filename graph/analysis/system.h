// A whole graph as the analysis sees it.
#pragma once

#include <string>

#include "graph/analysis/policies.h"
#include "graph/analysis/task_model.h"
#include "graph/model/graph.h"

namespace jarol::analysis {

struct System {
  Policy policy = policies::table;
  std::int64_t cores = 1;
  bool offsets_hold = true;  // else every shift of the tasks against each other is possible
  // per task, in the order of the graph
  TaskModels models;
  std::vector<std::optional<std::int64_t>> priority;
  std::vector<std::optional<std::int64_t>> core;
  std::vector<std::size_t> rank;  // in data-flow order
  std::vector<std::size_t> turn;  // as one thread runs those that are released at one instant
  // data-flow connections between tasks that are released at one instant at times: the second follows the first
  std::vector<std::pair<std::size_t, std::size_t>> follows;
};

/// Of a valid graph; WCETs include the platform's overheads. A task without a WCET has 0 here.
System system_of(const Graph& graph);

/// A core that the tasks that state it fill beyond all time, whatever goes beside them; the first of several.
std::optional<std::size_t> overfull_core(const System& system);

enum class Verdict { schedulable, not_schedulable, unknown };

/// What a verdict rests on: a test that decides both ways; a sufficient one, which may refuse what would hold; a run
/// that found a late activation; or, where it is unknown, nothing.
enum class Evidence { none, proof, safe, by_run };

}  // namespace jarol::analysis
