// Files that a command names: none replaces another.
#pragma once

#include <string>
#include <vector>

namespace jarol::tools {

/// A file of a command: the option that names it, as "--trace" or "FILE", and its path; none where that is empty.
struct NamedFile {
  std::string option;
  std::string path;
};

/// Throws std::invalid_argument where an output would replace an input or another output.
void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace jarol::tools
