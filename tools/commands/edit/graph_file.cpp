#include "tools/commands/edit/graph_file.h"

#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "graph/language/read_source.h"
#include "graph/language/yaml.h"
#include "runtime/files/atomic_file.h"

namespace jarol::tools::edit {
namespace {

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) { return false; }
}

// Another file takes its place, which needs the folder's permission alone. The bits count for root, too.
void require_writable(const std::string& path) {
  struct stat there {};
  if (::stat(path.c_str(), &there) != 0) return;
  constexpr mode_t to_write = S_IWUSR | S_IWGRP | S_IWOTH;
  if ((there.st_mode & to_write) == 0 || ::access(path.c_str(), W_OK) != 0)
    throw std::runtime_error("can't write '" + path +
                             "': the file is read-only; allow that it is written, as by chmod u+w, and save again");
}

}  // namespace

std::string hash_of(const std::string& bytes) {
  unsigned char hash[16];
  crypto_generichash(hash, sizeof hash, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), nullptr, 0);
  char text[2 * sizeof hash + 1];
  return sodium_bin2hex(text, sizeof text, hash, sizeof hash);
}

Version GraphFile::read() const {
  const auto source = read_source(path_);
  if (!is_utf8(source->text)) {
    Problems problems;
    problems.add({source, 1, 1}, "the file is no UTF-8, which a page can't show; convert it first");
    problems.throw_if_any();
  }
  return {source->text, hash_of(source->text)};
}

std::optional<Version> GraphFile::write(const std::string& text, const std::string& over) const {
  require_writable(path_);
  // other commands that write the file wait at its lock; what is read behind that is what is replaced
  AtomicFile file(path_, Replaces::all);
  // a file that is gone has no text and no hash
  Version there = std::filesystem::exists(path_) ? read() : Version{};
  if (there.hash != over) return there;
  file.write(text);
  file.commit();
  return std::nullopt;
}

}  // namespace jarol::tools::edit
