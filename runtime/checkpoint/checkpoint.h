// A run between two instants, saved whole: a value, and a file.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "graph/text/errors.h"
#include "graph/values/archive.h"
#include "graph/values/type_of.h"
#include "runtime/checkpoint/run_origin.h"

namespace jarol {

/// No checkpoint, one of something else, or what can't be saved; why, and with a file its name.
struct CheckpointError : InputError {
  using InputError::InputError;
};

class Checkpoint {
 public:
  Checkpoint(std::shared_ptr<const RunOrigin> origin, Duration instant)
      : origin_(std::move(origin)), instant_(instant) {}

  /// What it is of. Throws CheckpointError where it was moved elsewhere.
  const RunOrigin& origin() const;
  /// The instants before it were run.
  Duration instant() const { return instant_; }

  /// Adds the state of something, by a name of its own. Throws CheckpointError.
  template <class T>
  void save(std::string_view part, T& state) {
    Archive archive = Archive::to(parts_.emplace_back(std::string(part), Archive::Bytes()).second);
    try {
      archive(state);
    } catch (const NotSaveable& error) { throw CheckpointError(error.what()); }
  }
  /// False: it has no such part. Throws CheckpointError where that is damaged, and what was half restored is of no use.
  template <class T>
  bool restore(std::string_view part, T& state) const {
    const Archive::Bytes* const bytes = find(part);
    if (bytes == nullptr) return false;
    Archive archive = Archive::from(*bytes);
    try {
      archive(state);
      archive.require_end();
    } catch (const ArchiveError& error) {
      throw CheckpointError("is damaged: what it says of the " + std::string(part) + " " + error.what());
    }
    return true;
  }

  /// The file is there as a whole or not at all. Throws std::system_error.
  void write(const std::string& path) const;
  /// Before a run that is to be saved there. Throws InputError where another file stands, std::system_error
  /// where none can be made.
  static void require_writable(const std::string& path);
  /// Throws CheckpointError.
  static Checkpoint read(const std::string& path);

  /// As in the file, and back. Throws CheckpointError without the name of a file.
  Archive::Bytes to_bytes() const;
  static Checkpoint from_bytes(const Archive::Bytes& bytes);

 private:
  const Archive::Bytes* find(std::string_view part) const;

  std::shared_ptr<const RunOrigin> origin_;
  Duration instant_{};
  std::vector<std::pair<std::string, Archive::Bytes>> parts_;
};

}  // namespace jarol
