// The state of one run: the memory of a plan's values, what acts on it, and how far the run has come. Runs of one plan
// share nothing but the plan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/archive.h"
#include "graph/values/heap.h"
#include "runtime/machine/large_pages.h"
#include "runtime/plan/plan.h"
#include "runtime/state/actions.h"
#include "runtime/state/release_queue.h"
#include "runtime/state/task_status.h"

namespace jarol {

class RunState {
 public:
  /// As before the first instant. The plan outlives it, and so do the signals, of which it keeps the last values that
  /// were published: its taps.
  explicit RunState(const Plan& plan, std::span<const expect::Signal> tapped = {});
  RunState(const RunState&) = delete;
  RunState& operator=(const RunState&) = delete;

  /// Of a plan with Spacing::pages: whole pages with all of the task but its parameters.
  std::span<std::byte> pages_of(std::size_t task) const {
    return {at(plan.layout.tasks[task].begin), at(plan.layout.tasks[task].end)};
  }
  std::span<const std::byte> parameters_of(std::size_t task) const {
    return {at(plan.layout.tasks[task].parameters), plan.graph.tasks[task].task_class->parameters->size};
  }

  /// Before the first instant: other parameters of that task than the plan's graph has.
  void start_with(std::size_t task, const void* parameters);

  /// What changes while the run goes on, between two instants; those before `covered` were run. Restored, the state
  /// is that of the same plan but for parameters.
  void serialize(Archive& archive, Duration covered);

  const Plan& plan;

  // with addresses, in the order of the plan
  LargeVector<Activation> activations;
  LargeVector<LetEnd> let_ends;
  LargeVector<LetOutputs> let_outputs;  // per group
  std::vector<CommunicatorAction> outs, ins;

  std::vector<TaskStatus> status;      // per task
  std::vector<Outcome> outcomes;       // per task: how the activation ended whose LET is under way
  std::size_t bad_outcomes = 0;        // among these
  std::vector<PrivateHeap*> heaps;     // per task, null where it has none; owns nothing beyond the arena
  std::vector<const std::byte*> last;  // per communicator: what it last published, or its initial value
  std::vector<std::byte*> taps;        // per tapped signal: the field as last published
  std::vector<std::byte> tap_news;     // per tapped signal: 1, where that was since somebody put it to 0
  std::vector<std::vector<std::int64_t>> recent_faults;  // per task: activations that count for its fault_limit
  ReleaseQueue release_queue;                            // when each group is due
  LargeVector<std::int64_t> releases;                    // per group: how often it was due

 private:
  // a deep value in the arena whose memory is not a private heap
  struct Destroy {
    const Type* type = nullptr;
    void operator()(std::byte* value) const { type->destroy(value); }
  };

  std::byte* at(std::size_t place) const { return arena_.get() + place; }
  const std::byte* source_of(const End& end) const;
  std::byte* target_of(const End& end) const;

  // values as before the first instant
  void make_task(std::size_t i);
  void make_communicator(std::size_t i);
  void make_private(const Type& type, std::size_t place, PrivateHeap* heap);
  void make_owned(const Type& type, std::size_t place, std::pmr::memory_resource* memory);
  void make_deep_inputs();
  void make_taps();

  // in an archive
  void serialize_task(Archive& archive, std::size_t i);
  void serialize_communicator(Archive& archive, std::size_t i);
  void go_to(Duration covered);

  // actions
  void reserve_actions();
  void make_group(const Plan::Group& group);
  Activation make_activation(std::uint32_t task);
  CommunicatorAction make_action(std::uint32_t communicator);
  void add_let_output(LetOutputs& outputs, std::uint32_t task);
  Publish publish_of(End::Kind kind, std::uint32_t index);
  bool is_read_next(const Connection& c) const;
  void add_copy(std::uint32_t connection);
  void add_taps(End::Kind kind, std::size_t index);
  Copy tap_of(std::size_t i) const;

  std::span<const expect::Signal> tapped_;
  LargeMemory arena_;
  std::pmr::unsynchronized_pool_resource communicator_memory_;  // of deep values; no more than they need
  std::vector<std::unique_ptr<std::byte, Destroy>> owned_;
  std::vector<std::uint64_t> tap_memory_;
  std::vector<Value> first_states_;  // of tasks that are restarted, where they are deep
  std::vector<DeepInput> deep_inputs_;
  std::vector<DeepInput*> deep_input_of_;  // per connection, if there are any
  LargeVector<Copy> copies_;
  std::vector<DeepCopy> deep_copies_;
  LargeVector<Publication> publications_;
  LargeVector<LetValue> let_values_;
};

}  // namespace jarol
