#include "tools/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "tools/partial_files.h"

namespace jarol::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int reason) {
  throw std::runtime_error("can't write '" + path + "': " + std::strerror(reason));
}

// Where a link leads, also where nothing stands there yet.
fs::path target_of(const std::string& path) {
  constexpr int most_links = 40;  // as the kernel has it
  fs::path target = path;
  std::error_code none;
  for (int i = 0; i < most_links && fs::is_symlink(target, none); ++i)
    target = target.parent_path() / fs::read_symlink(target, none);
  return target;
}

// stdout or stderr, if the path leads to where they go, as /dev/stdout does.
int own_stream(const struct stat& file) {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat own {};
    const bool writable = (::fcntl(stream, F_GETFL) & O_ACCMODE) != O_RDONLY;
    if (writable && ::fstat(stream, &own) == 0 && own.st_dev == file.st_dev && own.st_ino == file.st_ino) return stream;
  }
  return -1;
}

bool are_same(const std::string& a, const std::string& b) {
  std::error_code none;
  // a device or a FIFO takes what several write
  if (fs::is_other(fs::status(a, none))) return false;
  return fs::equivalent(a, b, none) ||
         fs::weakly_canonical(target_of(a), none) == fs::weakly_canonical(target_of(b), none);
}

}  // namespace

WholeFile::WholeFile(std::string path) : path_(std::move(path)), target_(target_of(path_)) {
  struct stat there {};
  const bool exists = ::stat(path_.c_str(), &there) == 0;
  const int stream = exists ? own_stream(there) : -1;
  in_place_ = exists && (!S_ISREG(there.st_mode) || stream >= 0);
  // a copy of the own stream goes on where that is
  file_ = stream >= 0 ? ::fdopen(::dup(stream), "wb") : std::fopen(in_place_ ? path_.c_str() : partial().c_str(), "wb");
  if (file_ == nullptr) fail(path_, errno);
  if (!in_place_) add_partial_file(partial());
  if (exists && !in_place_) {
    // an owner other than this one can be kept by root only
    [[maybe_unused]] const int refused = ::fchown(::fileno(file_), there.st_uid, there.st_gid);
    ::fchmod(::fileno(file_), there.st_mode & 07777);
  }
}

WholeFile::~WholeFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  if (in_place_) return;
  std::remove(partial().c_str());
  drop_partial_file(partial());
}

void WholeFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(path_, errno);
}

void WholeFile::commit() {
  // the buffer goes out on closing, so that a full disk shows here at the latest
  const bool written = std::fclose(std::exchange(file_, nullptr)) == 0 &&
                       (in_place_ || std::rename(partial().c_str(), target_.c_str()) == 0);
  const int reason = errno;
  if (!written && !in_place_) std::remove(partial().c_str());
  if (!in_place_) drop_partial_file(partial());
  if (!written) fail(path_, reason);
}

void require_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].path.empty()) continue;
    for (const NamedFile& input : inputs)
      if (!input.path.empty() && are_same(outputs[i].path, input.path))
        throw std::invalid_argument(outputs[i].option + " '" + outputs[i].path + "' would replace what " +
                                    input.option + " names; choose another file");
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].path.empty() && are_same(outputs[i].path, outputs[k].path))
        throw std::invalid_argument(outputs[k].option + " and " + outputs[i].option + " both name '" + outputs[i].path +
                                    "'; choose another file for one of them");
  }
}

}  // namespace jarol::tools
