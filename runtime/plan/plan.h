// The plan of a graph: memory and actions laid out once, so that running is walking.
//
// There is no table over the hyperperiod. All that acts with one period from one first instant forms a group; at an
// instant the groups that are due run step by step, and within the last step stage by stage: a task that is fed by
// another group without a LET stands in a later stage than its producer. Cost and memory hang on the number of tasks
// and connections, never on how their periods relate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/heap.h"
#include "runtime/plan/output.h"

namespace jarol {

/// One transfer along a connection: from a producer's output right into the reader's input.
struct Copy {
  const void* from = nullptr;  // of size 0: a DeepCopy
  std::byte* to = nullptr;
  std::size_t size = 0;
};

/// An input of a task that did not fit its heap when it was last transferred; says why.
struct DeepInput : FaultText {
  bool lost = false;
};

/// A transfer of a deep value.
struct DeepCopy {
  const Type* type = nullptr;
  const std::byte* from = nullptr;
  DeepInput* input = nullptr;  // null: of a communicator, whose memory grows
};

/// A published value as trace and digest know it.
struct Publication {
  const std::byte* value = nullptr;
  std::uint64_t name_hash = 0;
  std::uint64_t (*hash_words)(const void* value) = nullptr;
  std::uint32_t output = 0;  // index into Plan::outputs
  std::uint32_t size = 0;    // of a deep value 0
};

template <class T>
struct Range {
  const T* first = nullptr;
  const T* last = nullptr;
  const T* begin() const { return first; }
  const T* end() const { return last; }
};

/// The same in less room, for what is read at every activation.
template <class T>
struct ShortRange {
  const T* first = nullptr;
  std::uint32_t count = 0;
  const T* begin() const { return first; }
  const T* end() const { return first + count; }
};

/// What is done to make outputs visible.
struct Publish {
  ShortRange<Copy> copies;  // of all outputs together
  ShortRange<Publication> publications;
};

/// What only faults need to know of a task, away from what every activation reads.
struct TaskStatus : FaultText {
  std::uint32_t task = 0;
  std::int64_t activation = 0;  // the faulty one
  bool skip_next = false;       // the next activation is left out
  bool undoable = false;        // state and outputs are kept before each activation
  Thunk run = nullptr;
  PrivateHeap* heap = nullptr;
  Range<DeepInput> deep_inputs;
  std::byte* kept = nullptr;  // as large as state, outputs and heap
  std::size_t size = 0;       // of state and outputs, which lie next to each other

  void keep(const void* state);
  void put_back(void* state);
};

/// One task of a group, run at its release.
struct Activation {
  Thunk run = nullptr;
  Body body = nullptr;  // instead, for a task whose outputs are checked at the end of its LET; else null
  TaskMemory memory;    // its fault text is the TaskStatus
  Publish publish;      // empty for a task with a LET
  std::uint32_t task = 0;
  std::uint32_t connections = 0;  // to and from others at its release
  bool has_let = false;
  bool publishes_deep = false;  // into memory that other producers may write as well
};

/// The outputs of a LET task, due at the end of its LET.
struct LetEnd {
  Publish publish;
  const void* out = nullptr;  // all its outputs
  std::uint32_t task = 0;
};

/// Outputs of a LET task that may not be finite.
struct LetValue {
  const void* value = nullptr;
  bool (*finite)(const void* value) = nullptr;
};

/// A communicator that acts.
struct CommunicatorAction {
  std::uint32_t communicator = 0;
  std::byte* value = nullptr;        // last published
  const std::byte* input = nullptr;  // of an `out`: what its producer last published
  std::byte* taken = nullptr;        // of an `in`: where a new value from outside is tried
  Publish publish;
};

/// Consecutive tasks of one group that may run before the next stage of other groups. Those of one level do not feed
/// each other; and segments of different groups in one stage do not either.
struct Segment {
  std::uint32_t stage = 0;
  bool publishes_deep = false;
  Range<Activation> activations;
  Range<Range<Activation>> levels;  // the same activations, for several workers
};

/// All that acts at `first`, `first + period`, ...
struct Group {
  Duration first{};
  Duration period{};
  Publish let_publish;             // step 1: of all let_ends in one go
  Range<LetEnd> let_ends;          // the same one by one
  Range<double> let_doubles;       // of them those of tasks that are made of doubles, from cache line to cache line
  Range<LetValue> let_values;      // of the other tasks that are checked at the ends of their LETs
  Range<CommunicatorAction> outs;  // step 2
  Range<CommunicatorAction> ins;   // step 3
  Range<Segment> segments;         // step 4
  std::size_t activations = 0;
};

struct Plan {
  /// `for_rest`: with the taps of a graph that states how its vehicle comes to rest.
  explicit Plan(const Graph& graph, bool for_rest = false);
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  std::vector<Group> groups;
  std::vector<Output> outputs;                      // in bytewise order of name
  std::vector<TaskStatus> status;                   // per task
  std::vector<Outcome> outcomes;                    // per task: how the activation ended whose LET is under way
  std::vector<std::unique_ptr<PrivateHeap>> heaps;  // per task, null where it has none
  std::vector<std::byte*> taps;                     // per signal of at_end's condition: the field as last published
  std::vector<std::byte> tap_news;                  // per signal: 1, where that was since somebody put it to 0

 private:
  friend class PlanBuilder;
  struct Release {
    void operator()(std::byte* memory) const;
  };
  // a deep value in the arena whose memory is not a private heap
  struct Destroy {
    const Type* type = nullptr;
    void operator()(std::byte* value) const { type->destroy(value); }
  };
  std::unique_ptr<std::byte, Release> arena_;
  std::pmr::unsynchronized_pool_resource communicator_memory_;  // of deep values; no more than they need
  std::vector<std::unique_ptr<std::byte, Destroy>> owned_;
  std::vector<std::uint64_t> tap_memory_;
  std::vector<DeepCopy> deep_copies_;
  std::vector<DeepInput> deep_inputs_;
  std::vector<Copy> copies_;
  std::vector<Publication> publications_;
  std::vector<Activation> activations_;
  std::vector<LetEnd> let_ends_;
  std::vector<LetValue> let_values_;
  std::vector<CommunicatorAction> outs_;
  std::vector<CommunicatorAction> ins_;
  std::vector<Segment> segments_;
  std::vector<Range<Activation>> levels_;
};

}  // namespace jarol
