// The tasks that are released at an instant, in the order of the plan: stage by stage, and within a stage by group.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "runtime/dispatch/rows.h"
#include "runtime/run/run.h"

namespace jarol {

class Releases {
 public:
  explicit Releases(Run& run)
      : run_(run),
        one_stage_(std::ranges::all_of(run.plan.segments, [](const Plan::Segment& s) { return s.stage == 0; })),
        cursors_(run.plan.groups.size()),
        ticks_(run.plan.groups.size()),
        rows_(run.plan, !one_stage_) {
    in_stage_.reserve(run.plan.groups.size());
  }

  /// Calls run_row(tasks, tick) for rows of tasks of the groups that are due, in their order.
  template <class RunRow>
  [[gnu::always_inline]] void each_row(const Now& now, RunRow run_row) {
    if (one_stage_ || now.due.size() == 1) {
      for (const std::uint32_t group : now.due) {
        const Tick tick = begin(group, now.instant);
        run_row(run_.plan.groups[group].tasks, tick);
      }
      return;
    }
    for (std::size_t i = 0; i < now.due.size(); ++i) ticks_[i] = begin(now.due[i], now.instant);
    const auto rows = rows_.of(now.due, [&](auto add) {
      each_stage_of(now.due, [&](const std::vector<Released>& released) {
        for (const Released& r : released) add(r.segment->tasks, static_cast<std::uint32_t>(r.tick - ticks_.data()));
      });
    });
    for (const Row& row : rows) run_row(row.tasks, ticks_[row.due]);
  }

  struct Released {
    const Plan::Segment* segment = nullptr;
    const Tick* tick = nullptr;
  };

  /// Calls run_stage(segments) for each stage, with those of the groups that are due.
  template <class RunStage>
  void each_stage(const Now& now, RunStage run_stage) {
    for (std::size_t i = 0; i < now.due.size(); ++i) ticks_[i] = begin(now.due[i], now.instant);
    each_stage_of(now.due, run_stage);
  }

  /// Calls release(activation, tick) for each task of the groups that are due, group by group.
  template <class Release>
  void each_task(const Now& now, Release release) {
    for (const std::uint32_t group : now.due) {
      const Tick tick = begin(group, now.instant);
      for (const Activation& activation : run_.plan.groups[group].tasks.of(run_.state.activations))
        release(activation, tick);
    }
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  // what of a group is still to be run
  struct Cursor {
    const Plan::Segment* next = nullptr;
    const Plan::Segment* last = nullptr;
  };

  Tick begin(std::uint32_t g, Duration instant) {
    const Plan::Group& group = run_.plan.groups[g];
    run_.report.activations += group.tasks.count;
    return {instant, run_.state.releases[g]++, group.period};
  }

  template <class RunStage>
  void each_stage_of(std::span<const std::uint32_t> due, RunStage run_stage) {
    for (std::size_t i = 0; i < due.size(); ++i) {
      const auto segments = run_.plan.segments_of(run_.plan.groups[due[i]]);
      cursors_[i] = {segments.data(), segments.data() + segments.size()};
    }
    for (std::uint32_t stage = 0; stage != none;) {
      std::uint32_t next = none;
      in_stage_.clear();
      for (std::size_t i = 0; i < due.size(); ++i) {
        Cursor& cursor = cursors_[i];
        if (cursor.next != cursor.last && cursor.next->stage == stage) in_stage_.push_back({cursor.next++, &ticks_[i]});
        if (cursor.next != cursor.last) next = std::min(next, cursor.next->stage);
      }
      run_stage(in_stage_);
      stage = next;
    }
  }

  Run& run_;
  const bool one_stage_;            // nobody waits for another group
  std::vector<Cursor> cursors_;     // of the groups due now
  std::vector<Tick> ticks_;         // of the groups due now
  std::vector<Released> in_stage_;  // of the stage under way
  Rows rows_;
};

}  // namespace jarol
