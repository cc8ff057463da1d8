// A file that appears whole or not at all: it is written under another name until it is committed.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace jarol::tools {

class WholeFile {
 public:
  /// Throws std::runtime_error, "can't write 'path': reason", if the file can't be made; so do the others.
  explicit WholeFile(std::string path);
  /// What was not committed is gone.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view text);
  void commit();

 private:
  std::string partial() const { return path_ + ".part"; }

  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace jarol::tools
