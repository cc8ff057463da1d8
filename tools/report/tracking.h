// What an operator commanded beside what the vehicle reports: fields of one name that come in and go out through one
// distributer.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/true_state.h"
#include "graph/model/graph.h"
#include "graph/values/bind.h"

namespace jarol::tools {

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

/// A table of what was commanded, reported as reached and truly reached last; `last_value` gives the newest value of a
/// communicator.
std::string reached_text(const Graph& graph, const std::function<const void*(std::size_t)>& last_value,
                         const std::vector<TrueState>& true_states);

/// All true values by the names of distributers.
nlohmann::ordered_json to_json(const std::vector<TrueState>& true_states);

}  // namespace jarol::tools
