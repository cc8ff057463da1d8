// What an operator commanded beside what the vehicle reports: fields of one name that come in and go out through one
// distributer; and where that ended.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/true_state.h"
#include "distributers/session/verdict.h"
#include "graph/model/graph.h"
#include "graph/values/bind.h"
#include "runtime/run/report.h"
#include "runtime/state/run_state.h"

namespace jarol {

/// A field that is reported to an operator, and the command of the same name where there is one.
struct Reported {
  std::string title;
  std::size_t communicator = 0;  // an `out`
  Leaf leaf;
  struct Command {
    std::size_t communicator = 0;  // an `in`
    Leaf leaf;
  };
  std::optional<Command> command;
};

/// The fields of every `out` communicator that answers at least one command.
std::vector<Reported> find_reported(const Graph& graph);

/// How a run ended, beside others.
struct RunColumn {
  std::uint64_t digest = 0;
  std::uint64_t fault_count = 0;
  std::string stopped{};  // the fault that stopped it; empty: none did
  struct Reached {
    std::string title;  // of what was commanded and reported
    std::string unit;
    double value = 0;
    bool is_true = false;  // where the vehicle truly was
  };
  std::vector<Reached> reached{};
  RunVerdict verdict{};
};

RunColumn column_of(const RunState& state, const Report& report, const std::vector<TrueState>& truth,
                    const RunVerdict& verdict);

}  // namespace jarol
