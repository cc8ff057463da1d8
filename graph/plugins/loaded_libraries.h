// The libraries with tasks that a process has loaded, which stay: how the loader is asked for one more, and what that
// would share with them.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace jarol {

class LoadedLibraries {
 public:
  /// Those of this process.
  static LoadedLibraries& of_process();

  /// Why a library can't be loaded beside the others, in words that follow its name; empty: it can.
  std::string find_conflict(const std::string& path) const;

  /// The name by which the loader takes the file that stands there now, not an earlier build that stood there.
  std::string place_of(const std::string& path) const;

  /// It is loaded from now on, by that name.
  void add(const std::string& path, const std::string& place);

  /// The names of all.
  std::vector<std::string> places() const;

 private:
  // the loader takes two files of one device and number for one
  struct File {
    dev_t device = 0;
    ino_t number = 0;
    bool operator==(const File&) const = default;
  };
  struct State {
    off_t size = 0;
    std::int64_t changed = 0;  // ns
    bool operator==(const State&) const = default;
  };
  struct Library {
    std::string path, place;
    File file;
    State state;
    std::vector<std::string> shared;  // symbols, sorted
  };

  static bool look_at(const std::string& path, File& file, State& state);
  static std::vector<std::string> shared_symbols(const std::string& path);

  mutable std::mutex mutex_;
  std::vector<Library> all_;
};

}  // namespace jarol
