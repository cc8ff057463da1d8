// A file that appears whole or not at all: it is written under another name until it is committed. What is no regular
// file, as a device or a FIFO, is written in place.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/files/output_lock.h"

namespace jarol {

/// What may stand where a file is written: nothing; a file, but for those that the process has read; any.
enum class Replaces { nothing, outputs, all };

class AtomicFile {
 public:
  /// Links are followed, and what they lead to is replaced; it keeps its permissions.
  /// Throws std::system_error, "can't write 'path': reason", if the file can't be made; so do the others.
  explicit AtomicFile(std::string path, Replaces replaces = Replaces::outputs);
  /// What was not committed is gone, also if a signal ends the program.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);
  void commit();

 private:
  void open_partial();
  bool put_in_place() const;

  std::string path_;              // as the user calls it
  std::filesystem::path target_;  // where links lead
  OutputLock lock_;
  std::string partial_;  // what it is called until then; empty: written in place
  Replaces replaces_;
  std::FILE* file_ = nullptr;
};

/// Where a link leads, also where nothing stands there yet.
std::filesystem::path target_of(const std::string& path);

/// Throws InputError, "can't write 'path': ...", where that is a file that the process has read.
void require_no_input(const std::string& path);

}  // namespace jarol
