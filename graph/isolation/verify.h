// Are tasks isolated, as their machine code shows it? From the functions that the runtime calls on, every call and
// every reference to data is followed; what reaches anything that is not the task's own offends.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "graph/isolation/object.h"

namespace jarol::isolation {

/// Of code and constant data that no symbol names.
inline constexpr std::string_view without_name = "what has no name";

/// One on the way from a task to what offends: a function, or constant data that points to the next.
struct Step {
  std::string name;      // as in the source
  Address at = 0;        // of what leads to the next; 0: in data
  bool is_part = false;  // of the one before: what is rarely executed of it
};

struct Violation {
  std::string kind;    // "a clock"
  std::string symbol;  // as in the source, "clock_gettime"; empty: it has none
  std::string text;    // "calls 'clock_gettime', a clock"
  std::vector<Step> path;
};

struct Root {
  std::string task;
  std::vector<Address> entries;
};

struct Verdict {
  std::string task;
  std::vector<Violation> violations;  // each thing once, by its shortest path; empty: isolated
  std::vector<std::string> notes;     // what it is besides
};

/// The tasks of a library with JAROL_PLUGIN, in bytewise order: what the form of a task makes of them, by its symbols.
std::vector<Root> find_tasks(const Object& object);

/// `own`: the object holds Jarol itself, whose library for tasks is not followed.
std::vector<Verdict> verify(const Object& object, const std::vector<Root>& roots, bool own = false);

/// What no verdict speaks of, a line each.
const std::vector<std::string>& unseen();

}  // namespace jarol::isolation
