// How the processes of one campaign talk: by messages of bytes, each as a whole and in the order in which one process
// sends them to another.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace jarol::campaign {

/// Used by one thread at a time.
class Messages {
 public:
  virtual ~Messages() = default;
  /// From 0; the first one has the results.
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  virtual void send(int to, const std::vector<std::byte>& bytes) = 0;
  /// One that has come, and from whom; none: there is none now.
  virtual std::optional<std::pair<int, std::vector<std::byte>>> receive() = 0;
};

/// What the library beside the program exports that talks by MPI: `jarol_mpi_messages`.
using MakeMessages = Messages* (*)();

}  // namespace jarol::campaign
