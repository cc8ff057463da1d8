// The outputs of a graph as trace and digest name them.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "graph/language/duration.h"
#include "graph/values/type.h"

namespace jarol {

struct Graph;

struct Output {
  std::string name;  // "task.output" or "communicator"
  const Type* type = nullptr;
};

/// In bytewise order of name; what is published names an output by its index here.
std::vector<Output> outputs_of(const Graph& graph);

}  // namespace jarol
