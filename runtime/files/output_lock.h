// One process writes an output at a time.
#pragma once

#include <string>

namespace jarol {

/// Held while it lives, whatever ends the process; no file is left. It is a name of the system's, by the folder and the
/// name of the output: seen by every process of the machine, not by those of other machines or containers.
class OutputLock {
 public:
  OutputLock() = default;
  /// Throws InputError, "can't write 'path': another process does; ...".
  explicit OutputLock(const std::string& path);
  ~OutputLock();
  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&& other) noexcept;

 private:
  int socket_ = -1;
};

}  // namespace jarol
