// The semantics of specs/running.md a second time: slow, event by event, no plan, no code shared with the runtime.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace jarol::oracle {

struct TaskModel {
  std::string name;
  std::string type;  // Counter, Relay, Sum or Accumulate
  std::int64_t period = 0, offset = 0;
  std::optional<std::int64_t> let;
  double init = 0;  // of its output
};

struct CommunicatorModel {
  std::string name;
  bool in = false;
  std::int64_t period = 0, offset = 0;
  double init = 0;
};

/// Ends are "task.input" or a communicator; starts are "task.out" or a communicator.
struct Model {
  std::vector<TaskModel> tasks;
  std::vector<CommunicatorModel> communicators;
  std::map<std::string, std::string> source_of;  // by end
};

/// In the order of instants, then of names.
using Trace = std::vector<std::tuple<std::int64_t, std::string, double>>;

struct Result {
  Trace trace;
  std::uint64_t digest = 0;
  std::uint64_t activations = 0;
  std::uint64_t instants = 0;
};

/// Interprets the instants 0 <= t < end.
Result interpret(const Model& model, std::int64_t end);

/// Each task's deadline, found by looking at every release of two hyperperiods.
std::map<std::string, std::int64_t> enumerate_deadlines(const Model& model);

}  // namespace jarol::oracle
