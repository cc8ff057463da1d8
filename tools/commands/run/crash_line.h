// What is said when a task, or a thread that it has started, ends the whole process: by exit, quick_exit, _exit, abort,
// a segmentation fault, an overflow of its stack.
#pragma once

#include <string>

#include "graph/model/graph.h"
#include "runtime/machine/signal_stack.h"

namespace jarol::distributers {
class Guardian;
}

namespace jarol::tools {

/// While it lives, a crash writes one line to stderr, with the task, its activation and the cause, another with what to
/// do with the log, if there is one, and wakes the guardian; then the process ends, by the signal that it was, or with
/// 3 after exit. There is one at a time; all that it is given outlives it. No cost until then: who runs is known from
/// `running_task`.
class CrashLine {
 public:
  explicit CrashLine(const Graph& graph, const distributers::Guardian* guardian = nullptr, const std::string& log = "");
  ~CrashLine();
  CrashLine(const CrashLine&) = delete;
  CrashLine& operator=(const CrashLine&) = delete;

 private:
  SignalStack stack_;  // of the thread that made it, which runs tasks too
};

/// Ends the process where threads run that never end, and is no crash: what was printed goes out, nothing else is
/// waited for.
[[noreturn]] void end_at_once(int exit_code);

}  // namespace jarol::tools
