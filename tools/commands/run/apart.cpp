#include "tools/commands/run/apart.h"

#include <filesystem>

#include "graph/text/errors.h"
#include "runtime/files/atomic_file.h"

namespace jarol::tools {
namespace {

namespace fs = std::filesystem;

bool are_same(const std::string& a, const std::string& b) {
  std::error_code none;
  // a device or a FIFO takes what several write
  if (fs::is_other(fs::status(a, none))) return false;
  // "./z" and "z" are one file, also where that is not there yet
  const auto place = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(target_of(path), none), none);
  };
  return fs::equivalent(a, b, none) || place(a) == place(b);
}

}  // namespace

void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].path.empty()) continue;
    // standard input is another file than standard output
    for (const NamedFile& input : inputs)
      if (!input.path.empty() && input.path != "-" && are_same(outputs[i].path, input.path))
        throw InputError(outputs[i].option + " '" + outputs[i].path + "' would replace what " + input.option +
                         " names; choose another file");
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].path.empty() && are_same(outputs[i].path, outputs[k].path))
        throw InputError(outputs[k].option + " and " + outputs[i].option + " both name '" + outputs[i].path +
                         "'; choose another file for one of them");
  }
}

void require_extension(const NamedFile& output, const std::string& extension, const std::string& what) {
  const fs::path path(output.path);
  if (path.extension().empty() || path.extension() == extension || path.string().starts_with("/dev/")) return;
  throw InputError(output.option + ": '" + output.path + "' would hold " + what + "; name it " +
                   fs::path(path).replace_extension(extension).string());
}

}  // namespace jarol::tools
