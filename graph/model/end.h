// One end of a connection.
#pragma once

#include <cstddef>

namespace jarol {

/// One end of a connection: a field of a task's In or Out, or a communicator.
struct End {
  enum class Kind { task, communicator } kind = Kind::task;
  std::size_t index = 0;
  std::size_t field = 0;  // of a task
};

}  // namespace jarol
