// A file that appears whole or not at all: it is written under another name until it is committed. What is no regular
// file, as a device or a FIFO, is written in place.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jarol::tools {

class WholeFile {
 public:
  /// Links are followed, and what they lead to is replaced; it keeps its permissions.
  /// Throws std::runtime_error, "can't write 'path': reason", if the file can't be made; so do the others.
  explicit WholeFile(std::string path);
  /// What was not committed is gone, also if a signal ends the program.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view text);
  void commit();

 private:
  std::string partial() const { return target_.string() + ".part"; }

  std::string path_;              // as the user calls it
  std::filesystem::path target_;  // where links lead
  bool in_place_ = false;
  std::FILE* file_ = nullptr;
};

/// A file of a command: the option that names it, as "--trace" or "FILE", and its path; none where that is empty.
struct NamedFile {
  std::string option;
  std::string path;
};

/// Throws std::invalid_argument where an output would replace an input or another output.
void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace jarol::tools
