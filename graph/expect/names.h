// What the names of a condition mean.
#pragma once

#include <string>
#include <vector>

#include "graph/model/condition.h"
#include "graph/model/graph.h"

namespace jarol::expect {

/// What is known of a distributer's vehicle.
struct TrueValues {
  enum class Where { here, elsewhere, nowhere } where = Where::elsewhere;
  const Type* type = nullptr;  // here: a struct of numbers
};

/// A name, and what is wrong with it, if anything is.
struct Found {
  std::optional<Signal> signal;
  std::string wrong;       // without its subject: "has no output 'x'; it has: y"
  std::string not_judged;  // why it can't be
};

/// "task.output.field", "communicator.field", or the end of one of them where there is only one such end. A graph with
/// other problems may give neither a signal nor what is wrong.
Found find_published(const Graph& graph, const std::string& name);

/// A true value of the vehicle of a distributer.
Found find_true(const Graph& graph, const std::vector<TrueValues>& vehicles, const std::string& field,
                const std::string& distributer);

}  // namespace jarol::expect
