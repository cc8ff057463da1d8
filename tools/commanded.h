// What an operator commanded beside what the vehicle reports: fields of one name that come in and go out through one
// distributer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/graph.h"
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

}  // namespace jarol::tools
