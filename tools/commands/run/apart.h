// Files that a command names: none replaces another, or has the name of something else.
#pragma once

#include <string>
#include <vector>

namespace jarol::tools {

/// A file of a command: the option that names it, as "--trace" or "FILE", and its path; none where that is empty.
struct NamedFile {
  std::string option;
  std::string path;
};

/// Throws InputError where an output would replace an input or another output.
void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws InputError where the name of an output promises something else than what it will hold, as "p.png"
/// for an SVG picture; one without an extension promises nothing. `what`: "an SVG picture".
void require_extension(const NamedFile& output, const std::string& extension, const std::string& what);

}  // namespace jarol::tools
