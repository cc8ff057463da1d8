// What is done when something of a plan acts, with the addresses of one run's values: as it is read at each activation.
#pragma once

#include <cstddef>
#include <cstdint>

#include "graph/task.h"

namespace jarol {

/// One transfer along a connection: from a producer's output right into the reader's input.
struct Copy {
  const void* from = nullptr;  // of size 0: a DeepCopy
  std::byte* to = nullptr;
  std::uint32_t size = 0;
  bool read_next = false;  // by the task that runs right after the value was made
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

/// One task of a group, run at its release. What runs its body lies in one cache line.
struct alignas(64) Activation {
  Thunk run = nullptr;
  Body body = nullptr;  // instead, for a task whose outputs are checked at the end of its LET; else null
  TaskMemory memory;    // its fault text is the TaskStatus
  std::uint32_t task = 0;
  std::uint32_t connections = 0;  // to and from others at its release
  Publish publish;                // empty for a task with a LET
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

/// All the outputs of a group that are due at the ends of LETs, in one go.
struct LetOutputs {
  Publish publish;
  Range<double> doubles;        // of tasks that are made of doubles, from cache line to cache line
  ShortRange<LetValue> values;  // of the other tasks that are checked at the ends of their LETs
};

/// A communicator that acts.
struct CommunicatorAction {
  std::uint32_t communicator = 0;
  std::byte* value = nullptr;        // last published
  const std::byte* input = nullptr;  // of an `out`: what its producer last published
  std::byte* taken = nullptr;        // of an `in`: where a new value from outside is tried
  Publish publish;
};

}  // namespace jarol
