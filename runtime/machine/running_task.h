// Which activation a thread runs, for the line that says in which task a program crashed. Each thread writes its own,
// plainly, and only a signal handler of the same thread reads it.
#pragma once

#include <atomic>
#include <cstdint>

#include "graph/task.h"

namespace jarol {

struct RunningTask {
  std::atomic<const TaskMemory*> memory{nullptr};  // its fault text is a TaskStatus; null: no task runs
  std::atomic<const Tick*> tick{nullptr};
  std::uintptr_t stack_end = 0;  // the lowest address of the thread's stack; 0: not known

  // relaxed: one plain store
  void begin(const TaskMemory& of, const Tick& at) {
    tick.store(&at, std::memory_order_relaxed);
    memory.store(&of, std::memory_order_relaxed);
  }
  /// The next one of the same instant.
  void next(const TaskMemory& of) { memory.store(&of, std::memory_order_relaxed); }
  void end() { memory.store(nullptr, std::memory_order_relaxed); }
};

// of the calling thread; at a fixed place from its begin, so that nothing is called to find it
[[gnu::tls_model("initial-exec")]] extern constinit thread_local RunningTask running_task;

}  // namespace jarol
