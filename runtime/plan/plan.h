// The plan of a graph: who acts when and in which order, and where each value lies. It is made once and never changes,
// so that any number of runs share it; what changes while one runs is its RunState.
//
// It holds no table over the hyperperiod. All that acts with one period from one first instant forms a group; at an
// instant the groups that are due run step by step, and within the last step stage by stage: a task that is fed by
// another group without a LET stands in a later stage than its producer. Cost and memory depend on the number of tasks
// and connections, never on how their periods relate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "graph/model/graph.h"
#include "graph/model/stages.h"
#include "runtime/plan/layout.h"
#include "runtime/plan/output.h"

namespace jarol {

/// Consecutive elements of a vector that the plan says.
struct Indices {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t last() const { return first + count; }

  template <class T, class A>
  std::span<const T> of(const std::vector<T, A>& all) const {
    return {all.data() + first, count};
  }
};

struct Plan {
  /// The graph outlives the plan.
  explicit Plan(const Graph& graph, Spacing spacing = Spacing::lines);
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  /// Consecutive tasks of one group that may run before the next stage of other groups. Those of one level do not feed
  /// each other; and segments of different groups in one stage do not either.
  struct Segment {
    std::uint32_t stage = 0;
    bool publishes_deep = false;
    Indices tasks;   // in `order`
    Indices levels;  // the same tasks, for several workers
  };

  /// All that acts at `first`, `first + period`, ...
  struct Group {
    Duration first{};
    Duration period{};
    Indices let_ends;  // step 1
    Indices outs;      // step 2
    Indices ins;       // step 3
    Indices tasks;     // step 5, in `order`
    Indices segments;  // of the same tasks
  };

  /// What is published, as trace and digest know it.
  struct Published {
    std::uint64_t name_hash = 0;
    std::uint32_t output = 0;  // index into `outputs`
  };

  /// A task or a communicator that publishes.
  struct Publisher {
    Indices published;
    Indices readers;  // the connections from it
  };

  std::span<const Segment> segments_of(const Group& group) const { return group.segments.of(segments); }

  const Graph& graph;
  std::vector<Output> outputs;           // in bytewise order of name
  std::vector<std::uint32_t> order;      // of tasks: by group, and in each as they run
  Layout layout;                         // of the values
  std::vector<Group> groups;             // in the order in which they act at one instant
  std::vector<Segment> segments;         // of all groups
  std::vector<Indices> levels;           // of all segments: tasks in `order`
  std::vector<std::uint32_t> let_ends;   // of all groups: tasks whose outputs become visible
  std::vector<std::uint32_t> outs, ins;  // of all groups: communicators
  std::vector<Publisher> tasks;          // per task
  std::vector<Publisher> communicators;  // per communicator
  std::vector<Published> published;      // of all publishers
  std::vector<std::uint32_t> readers;    // of all publishers: connections

 private:
  Plan(const Graph& graph, const GroupDeadlines& deadlines, Spacing spacing);
};

/// The plan of a run: one that others share and that outlives it, or one of its own, of a graph that is run once.
class PlanOfRun {
 public:
  PlanOfRun(const Plan& shared) : plan_(&shared) {}
  PlanOfRun(const Plan&&) = delete;
  PlanOfRun(const Graph& graph, Spacing spacing = Spacing::lines)
      : own_(std::make_unique<const Plan>(graph, spacing)), plan_(own_.get()) {}

  const Plan& operator*() const { return *plan_; }
  const Plan* operator->() const { return plan_; }

 private:
  std::unique_ptr<const Plan> own_;
  const Plan* plan_;
};

}  // namespace jarol
