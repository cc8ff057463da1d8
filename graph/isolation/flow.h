// What one function calls, refers to and does, found by following the values in its registers and on its stack.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "graph/isolation/instruction.h"
#include "graph/isolation/object.h"

namespace jarol::isolation {

/// Where a value comes from, as far as that decides what a call through it may reach.
struct Origin {
  enum class Kind : std::uint8_t {
    nothing,  // no path was followed that computes it
    any,      // unknown, or of several origins
    number,   // `at`
    address,  // of code or data in the object, `at`
    table,    // loaded from constant data; `at`: where the table begins
    task,     // read from the memory of the task, its values and what they hold, or computed with that
    library,  // returned by a function outside
    frame,    // an address on the stack, `at` bytes from where the function began
  };
  Kind kind = Kind::nothing;
  std::int64_t at = 0;
  std::int64_t loaded = -1;  // the displacement of the load that it comes from
  int depth = 0;             // of what is the task's: how many loads lead there from TaskMemory

  friend bool operator==(const Origin&, const Origin&) = default;
};

/// Of both paths that meet.
Origin join(const Origin& a, const Origin& b);

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
