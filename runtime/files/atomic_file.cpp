#include "runtime/files/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "graph/language/inputs.h"
#include "graph/text/errors.h"
#include "runtime/files/in_place.h"
#include "runtime/files/sync.h"
#include "runtime/files/temporary_files.h"

namespace jarol {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int reason) {
  throw std::system_error(reason, std::generic_category(), "can't write '" + path + "'");
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

// Who writes one holds its lock, wherever that process runs.
void remove_if_left(const char* partial) {
  const int descriptor = ::open(partial, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat found {};
  if (::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && found.st_uid == ::geteuid() &&
      ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
    ::unlink(partial);
  ::close(descriptor);
}

std::string partial_name(const fs::path& target, const std::string& number) {
  return target.filename().string() + "." + number + ".part";
}

// Partial files of that target, of runs that were killed before they could take them along. This process has the
// target's lock, which those in other namespaces do not see.
void remove_what_killed_ones_left(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string begin = target.filename().string() + ".";
  std::error_code none;
  for (fs::directory_iterator entry(folder, none), end; entry != end; entry.increment(none)) {
    const std::string name = entry->path().filename();
    if (!name.starts_with(begin)) continue;
    const std::string number = name.substr(begin.size(), name.find('.', begin.size()) - begin.size());
    const bool has_number = !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
    if (has_number && name == partial_name(target, number)) remove_if_left(entry->path().c_str());
  }
}

}  // namespace

fs::path target_of(const std::string& path) {
  constexpr int max_links = 40;  // as the kernel has it
  fs::path target = path;
  std::error_code none;
  for (int i = 0; i < max_links && fs::is_symlink(target, none); ++i)
    target = target.parent_path() / fs::read_symlink(target, none);
  return target;
}

AtomicFile::AtomicFile(std::string path, Replaces replaces)
    : path_(std::move(path)), target_(target_of(path_)), replaces_(replaces) {
  if (replaces != Replaces::all) require_no_input(path_);
  struct stat there {};
  const bool exists = ::stat(path_.c_str(), &there) == 0;
  const int stream = exists ? own_stream(there) : -1;
  if (exists && replaces == Replaces::nothing) fail(path_, EEXIST);
  if (stream >= 0) {
    file_ = open_in_place(stream);  // goes on where that is
  } else if (exists && !S_ISREG(there.st_mode)) {
    file_ = open_in_place(path_);
  } else {
    lock_ = OutputLock(target_);
    remove_what_killed_ones_left(target_);
    open_partial();
  }
  if (file_ == nullptr) fail(path_, errno);
  if (exists && !partial_.empty()) {
    // an owner other than this one can be kept by root only
    [[maybe_unused]] const int refused = ::fchown(::fileno(file_), there.st_uid, there.st_gid);
    ::fchmod(::fileno(file_), there.st_mode & 07777);
  }
}

// Under a name that nobody can have foreseen.
void AtomicFile::open_partial() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != sizeof number) fail(path_, errno);
  partial_ = (target_.parent_path() / partial_name(target_, std::to_string(number))).string();
  add_temporary_file(partial_);
  const int descriptor = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor >= 0) {
    ::flock(descriptor, LOCK_EX | LOCK_NB);
    file_ = ::fdopen(descriptor, "wb");
  }
  if (file_ != nullptr) return;
  const int reason = errno;
  drop_temporary_file(partial_);
  fail(path_, reason);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  if (partial_.empty()) return;
  std::remove(partial_.c_str());
  drop_temporary_file(partial_);
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(path_, errno);
}

bool AtomicFile::put_in_place() const {
  if (replaces_ != Replaces::nothing) return std::rename(partial_.c_str(), target_.c_str()) == 0;
  return ::link(partial_.c_str(), target_.c_str()) == 0 && std::remove(partial_.c_str()) == 0;
}

void AtomicFile::commit() {
  // what is in the buffer goes out here at the latest, so that a full disk shows
  bool written = sync(file_);
  int reason = errno;
  if (std::fclose(std::exchange(file_, nullptr)) != 0 && written) {
    written = false;
    reason = errno;
  }
  if (!partial_.empty()) {
    if (written && !put_in_place()) {
      written = false;
      reason = errno;
    }
    if (!written) std::remove(partial_.c_str());
    drop_temporary_file(partial_);
    sync_folder_of(target_);
  }
  if (!written) fail(path_, reason);
}

void require_no_input(const std::string& path) {
  const std::string input = input_at(path);
  if (!input.empty())
    throw InputError("can't write '" + path + "': it is '" + input + "', which was read; choose another file");
}

}  // namespace jarol
