// What one function calls, refers to and does, found by following the values in its registers and on its stack.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "graph/isolation/instruction.h"
#include "graph/isolation/object.h"
#include "graph/isolation/values.h"

namespace jarol::isolation {

/// Of rdi, rsi, rdx, rcx, r8, r9: what a function is called with.
using Arguments = std::array<Origin, 6>;
Arguments unknown_arguments();
/// Of a task's thunk: TaskMemory and Tick.
Arguments arguments_of_task();
/// Of a task's `run`: the structs that TaskMemory points to.
Arguments arguments_of_run();

/// What a function holds that no task may.
struct Offence {
  std::string kind;    // "thread-local storage"
  std::string symbol;  // as in "errno"; empty: none
  std::string text;    // "reads the clock"
};

struct Finding {
  enum class What : std::uint8_t { call, reference, import, offence, through_pointer };
  What what = What::call;
  Address at = 0;      // the instruction
  Address to = 0;      // of calls and references
  Arguments with{};    // of calls
  std::string name{};  // of imports
  Offence offence{};
  Origin target{};  // of calls through pointers
};

std::vector<Finding> findings_in(const Object& object, const Symbol& function, const Arguments& arguments);

}  // namespace jarol::isolation
