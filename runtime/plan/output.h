// An output as trace and digest name it.
#pragma once

#include <chrono>
#include <string>

#include "graph/values/type.h"

namespace jarol {

using Duration = std::chrono::nanoseconds;

struct Output {
  std::string name;  // "task.output" or "communicator"
  const Type* type = nullptr;
};

}  // namespace jarol
