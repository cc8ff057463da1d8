// The file of a graph that is edited: read, and written only over what was read of it.
#pragma once

#include <optional>
#include <string>

namespace jarol::tools::edit {

struct Version {
  std::string text;
  std::string hash;  // of its bytes
};

/// BLAKE2b in hexadecimal.
std::string hash_of(const std::string& bytes);

class GraphFile {
 public:
  explicit GraphFile(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }

  /// As it is on the disk. Throws SpecError where it can't be read, or is no UTF-8, which a page can't show.
  Version read() const;

  /// Writes the text, if what is on the disk is the version of that hash; else it is left as it is, and returned: a
  /// file that is gone without text and hash. The file is whole at any time, but for one that has other names by hard
  /// links, which is written in place. Throws InputError where it can't be written, is read-only, or no file.
  std::optional<Version> write(const std::string& text, const std::string& over) const;

 private:
  std::string path_;
};

}  // namespace jarol::tools::edit
