// Where the values of a graph's tasks and communicators lie in one piece of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "graph/model/graph.h"

namespace jarol {

/// What no two tasks have in common: a cache line, or a page of memory too, so that each can be protected by itself.
enum class Spacing { lines, pages };

/// Offsets in bytes from the begin of the memory.
struct Layout {
  static constexpr std::size_t line = 64;    // bytes of a cache line
  static constexpr std::size_t page = 4096;  // bytes

  struct OfTask {
    std::size_t parameters = 0, in = 0, state = 0, out = 0, book = 0, heap = 0, kept = 0;
    std::size_t begin = 0, end = 0;  // with Spacing::pages: all that is written lies between these
  };
  struct OfCommunicator {
    std::size_t value = 0, input = 0, taken = 0;
  };

  /// With the tasks in that order.
  Layout(const Graph& graph, const std::vector<std::uint32_t>& order, Spacing spacing);

  Spacing spacing = Spacing::lines;
  std::vector<OfTask> tasks;                  // per task
  std::vector<OfCommunicator> communicators;  // per communicator
  std::size_t size = 0;

  /// Of a task's state and outputs, which lie next to each other if they may have to be undone.
  std::size_t recoverable_size(const Graph& graph, std::size_t task) const;

 private:
  std::size_t place(std::size_t bytes, std::size_t alignment);
  std::size_t place(const Type& type) { return place(type.size, type.alignment); }
  void place_apart(const Graph& graph, std::uint32_t task);
  void place_heap(const Graph& graph, std::uint32_t task);
  void place_kept(const Graph& graph, std::uint32_t task);
  void place_let_doubles(const Graph& graph, const std::vector<std::uint32_t>& order);
};

/// True if state and outputs are put back after a fault.
inline bool is_recoverable(const Task& task) { return task.on_fault != OnFault::stop; }

inline bool has_heap(const Task& task) { return task.heap > 0 || task.task_class->is_deep(); }

/// True if nobody looks at the outputs, nor need they be undone, before the end of the LET: whether they are finite is
/// seen then, when the processor has long stored them.
inline bool is_checked_at_let_end(const Task& task) {
  return task.let && !is_recoverable(task) && !has_heap(task) && task.task_class->out->in_range == nullptr;
}

/// The same, with outputs that are nothing but doubles. Those of one LET end lie side by side, each from the begin of a
/// cache line, with zeros between, unless tasks lie on pages of their own.
inline bool has_let_doubles(const Task& task) {
  return is_checked_at_let_end(task) && is_made_of_doubles(*task.task_class->out);
}

}  // namespace jarol
