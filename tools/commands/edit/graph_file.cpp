#include "tools/commands/edit/graph_file.h"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "distributers/links/descriptor.h"
#include "graph/language/read_source.h"
#include "graph/language/yaml.h"
#include "graph/text/errors.h"
#include "runtime/files/atomic_file.h"
#include "runtime/files/output_lock.h"

namespace jarol::tools::edit {
namespace {

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) { return false; }
}

[[noreturn]] void fail(const std::string& path, int reason) {
  throw std::system_error(reason, std::generic_category(), "can't write '" + path + "'");
}

// Another file takes its place, which needs the folder's permission alone. The bits count for root, too.
void require_writable(const std::string& path) {
  struct stat there {};
  if (::stat(path.c_str(), &there) != 0) return;
  // whoever reads a FIFO would be waited for
  if (!S_ISREG(there.st_mode))
    throw InputError("can't write '" + path + "': there is no regular file any more; move away what is there");
  constexpr mode_t to_write = S_IWUSR | S_IWGRP | S_IWOTH;
  if ((there.st_mode & to_write) == 0 || ::access(path.c_str(), W_OK) != 0)
    throw InputError("can't write '" + path +
                     "': the file is read-only; allow that it is written, as by chmod u+w, and save again");
}

// By a hard link, which another file in its place would cut.
bool has_other_names(const std::string& path) {
  struct stat there {};
  return ::stat(path.c_str(), &there) == 0 && there.st_nlink > 1;
}

bool put(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::pwrite(file, text.data() + at, text.size() - at, static_cast<off_t>(at));
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) at += static_cast<std::size_t>(written);
  }
  return ::ftruncate(file, static_cast<off_t>(text.size())) == 0 && ::fsync(file) == 0;
}

// By all its names; where there is no room, what was there before stays.
void write_in_place(const std::string& path, const std::string& text, const std::string& before) {
  const distributers::Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file) fail(path, errno);
  if (put(file.get(), text)) return;
  const int reason = errno;
  put(file.get(), before);
  fail(path, reason);
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
  if (has_other_names(path_)) {
    const OutputLock lock(target_of(path_));
    Version there = read();
    if (there.hash != over) return there;
    write_in_place(path_, text, there.text);
    return std::nullopt;
  }
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
