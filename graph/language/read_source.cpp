#include "graph/language/read_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "graph/language/inputs.h"
#include "graph/language/problems.h"
#include "graph/language/source_set.h"
#include "graph/language/yaml.h"

namespace jarol {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  const auto whole = std::make_shared<Source>(Source{path, ""});
  throw SpecError({{{whole, 0, 0}, "can't read '" + path + "': " + reason, {}}});
}

// Of a file that is not there, one of a name like it that is; their ends are alike anyway.
std::string one_like_it(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::vector<std::string> names;
  std::error_code gone, other;
  int looks = 10'000;
  for (std::filesystem::directory_iterator at(folder, gone), end; !gone && at != end && looks > 0; at.increment(gone)) {
    --looks;
    const std::filesystem::path& found = at->path();
    if (found.extension() == path.extension() && !did_you_mean(path.stem().native(), {found.stem()}).empty() &&
        at->is_regular_file(other))
      names.push_back(found.filename());
  }
  std::sort(names.begin(), names.end());
  return did_you_mean(path.filename().native(), names);
}

[[noreturn]] void fail_as_too_large(const std::string& path, std::size_t max) {
  fail(path, "it is larger than " +
                 (max >= (1U << 20) ? std::to_string(max >> 20) + " MiB" : std::to_string(max >> 10) + " KiB"));
}

struct File {
  int number;
  ~File() {
    if (number > STDERR_FILENO) ::close(number);
  }
};

std::string read_all(const File& file, const std::string& path, std::size_t max) {
  struct stat status {};
  if (::fstat(file.number, &status) != 0) fail(path, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail(path, "it is a directory");
  if (!S_ISREG(status.st_mode) && path != "-") fail(path, "it is no regular file; give - for what comes on stdin");
  note_input(path, status);
  if (S_ISREG(status.st_mode) && status.st_size > static_cast<off_t>(max)) fail_as_too_large(path, max);
  std::string text;
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t size = ::read(file.number, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) fail(path, std::strerror(errno));
    if (size == 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(size));
    if (text.size() > max) fail_as_too_large(path, max);
  }
}

std::shared_ptr<const Source> read_from_disk(const std::string& path, std::size_t max) {
  if (path == "-") {
    static std::shared_ptr<const Source> from_stdin;  // it can be read once
    if (!from_stdin) from_stdin = std::make_shared<Source>(Source{path, read_all({STDIN_FILENO}, path, max)});
    return from_stdin;
  }
  // a FIFO that nobody writes is not waited for
  const File file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
  if (file.number < 0) {
    const int error = errno;
    fail(path, std::strerror(error) + (error == ENOENT ? one_like_it(path) : ""));
  }
  return std::make_shared<Source>(Source{path, read_all(file, path, max)});
}

}  // namespace

std::shared_ptr<const Source> read_source(const std::string& path) { return read_source(path, max_source_bytes); }

std::shared_ptr<const Source> read_source(const std::string& path, std::size_t max) {
  std::shared_ptr<const Source> source = SourceSet::given_at(path);
  if (!source) {
    if (const std::string why = SourceSet::closed(); !why.empty()) {
      SourceSet::note_missed(path);
      fail(path, why);
    }
    source = read_from_disk(path, max);
  }
  SourceSet::note(source);
  return source;
}

}  // namespace jarol
