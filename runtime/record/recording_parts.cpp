#include "runtime/record/recording_parts.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "graph/text/errors.h"
#include "runtime/files/atomic_file.h"
#include "runtime/files/in_place.h"
#include "runtime/files/sync.h"
#include "runtime/mcap/crc32.h"

namespace jarol {
namespace {

constexpr std::string_view library = "jarol";

// Nothing that somebody would miss: no regular file, an empty one, or a recording.
bool may_be_replaced(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none) || std::filesystem::file_size(path, none) == 0) return true;
  // magic, then the header: opcode, length, profile and library
  std::string begin(mcap::magic.size() + mcap::record_head + 4 + 4 + library.size(), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.starts_with(mcap::magic) && begin.ends_with(library);
}

// A device, a pipe, a folder.
bool is_special(const std::string& path) {
  std::error_code none;
  return std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none);
}

// Where it was opened there is another file by now, or none.
bool is_moved(std::FILE* file, const std::string& path) {
  struct stat open {};
  struct stat there {};
  if (::fstat(fileno(file), &open) != 0 || !S_ISREG(open.st_mode)) return false;
  if (::stat(path.c_str(), &there) != 0) return errno == ENOENT || errno == ENOTDIR;
  return open.st_dev != there.st_dev || open.st_ino != there.st_ino;
}

[[noreturn]] void fail_to_write(const std::string& path, int reason) {
  throw std::system_error(reason, std::generic_category(), "can't write '" + path + "'");
}

// Empty, and nobody else writes it by another name, as a hard link is one. Null, and errno, if it can't be opened.
std::FILE* open_alone(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) return nullptr;
  // file systems without locks have that of the name
  const bool taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::FILE* const file = !taken && ::ftruncate(descriptor, 0) == 0 ? ::fdopen(descriptor, "wb") : nullptr;
  if (file != nullptr) return file;
  const int reason = errno;
  ::close(descriptor);
  if (taken)
    throw InputError("can't write '" + path +
                     "': another run writes it by another name; choose another file, or wait until that ends");
  errno = reason;
  return nullptr;
}

// No input of the run, no output of another, and nothing that somebody would miss. Throws std::exception.
OutputLock lock_replaceable(const std::string& path, std::size_t number) {
  require_no_input(path);
  OutputLock lock(target_of(path));
  // nobody has named the later ones
  if (!may_be_replaced(path) || (is_special(path) && number > 1))
    throw InputError("can't write '" + path + "': it is there and no recording; choose another file, or remove it");
  return lock;
}

}  // namespace

std::string path_of_part(const std::string& path, std::size_t number) {
  if (number == 1) return path;
  std::filesystem::path part(path);
  part.replace_extension("." + std::to_string(number) + part.extension().string());
  return part.string();
}

std::string mark_of_part(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::int64_t>(std::streamoff(file.tellg()));
  // its newest values and its index, but for the end, whose sum of the index would take that out of the sum of all
  const auto end = static_cast<std::int64_t>(sizeof(std::uint32_t) + mcap::magic.size());
  if (!file || size < end) return "";
  std::string last(static_cast<std::size_t>(std::min<std::int64_t>(size - end, 65536)), '\0');
  file.seekg(size - end - static_cast<std::int64_t>(last.size()));
  file.read(last.data(), static_cast<std::streamsize>(last.size()));
  return file ? fmt::format("{} {:08x}", size, mcap::crc32(last)) : "";
}

RecordingParts::~RecordingParts() {
  if (part_.file != nullptr) std::fclose(part_.file);
}

void RecordingParts::open(RecordingHeader header, const std::vector<RecordedFile>& files,
                          std::vector<mcap::Schema> schemas, std::vector<mcap::Channel> channels) {
  header_ = std::move(header);
  schemas_ = std::move(schemas);
  channels_ = std::move(channels);
  require_names();
  begin_part(open_part(path_, header_.part));
  try {
    for (const RecordedFile& file : files) writer_->write({file.path, "text/plain", file.text});
  } catch (const std::system_error& error) { fail(error.code().value()); }
}

// A name that is already taken is reported before the run, not when its part is due.
void RecordingParts::require_names() const {
  if (header_.split == 0) return;
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, none)) {
    const std::string number = entry.path().stem().extension().string();
    std::size_t part = 0;
    const bool is_number =
        number.size() > 1 &&
        std::from_chars(number.data() + 1, number.data() + number.size(), part).ptr == number.data() + number.size();
    const std::string path = is_number && part > 1 ? path_of_part(path_, part) : "";
    if (!path.empty() && std::filesystem::path(path).filename() == entry.path().filename())
      lock_replaceable(path, part);
  }
}

RecordingParts::Part RecordingParts::open_part(const std::string& path, std::size_t number) {
  Part part{path_of_part(path, number)};
  part.lock = lock_replaceable(part.path, number);
  part.file = is_special(part.path) ? open_in_place(part.path) : open_alone(part.path);
  if (part.file == nullptr) fail_to_write(part.path, errno);
  return part;
}

void RecordingParts::begin_part(Part part) {
  part_ = std::move(part);
  try {
    writer_.emplace(part_.file, compression_, library);
    writer_->write({RecordingHeader::attachment, "application/json", to_json(header_)});
  } catch (const std::system_error& error) { fail(error.code().value()); }
}

void RecordingParts::write(const mcap::Chunk& chunk) {
  const bool is_full = header_.split > 0 && writer_->bytes() + chunk.records().size() > header_.split;
  if (is_full && writer_->has_chunks() && stayed_.empty()) begin_next();
  try {
    writer_->write(chunk);
  } catch (const std::system_error& error) { fail(error.code().value()); }
}

// A part that can't be made must not cost what comes after it.
void RecordingParts::begin_next() {
  Part next;
  try {
    next = open_part(path_, header_.part + 1);
  } catch (const std::exception& wrong) {
    const std::string why = wrong.what();
    stayed_ = "'" + part_.path + "' went on beyond the size of --record-split: " + why.substr(0, why.find("; "));
    return;
  }
  std::string mark;
  try {
    finish();
    mark = mark_of_part("/proc/self/fd/" + std::to_string(::fileno(part_.file)));  // wherever it is by now
    close_part();
  } catch (...) {
    std::fclose(next.file);
    throw;
  }
  ++header_.part;
  header_.follows = std::move(mark);
  begin_part(std::move(next));
  try {
    writer_->write(schemas_, channels_);
  } catch (const std::system_error& error) { fail(error.code().value()); }
}

void RecordingParts::finish() {
  try {
    writer_->end(schemas_, channels_);
  } catch (const std::system_error& error) { fail(error.code().value()); }
}

void RecordingParts::close_part() {
  if (moved_.empty() && is_moved(part_.file, part_.path)) moved_ = part_.path;
  // what is in buffers goes out here at the latest, so that a full disk shows
  if (!sync(part_.file)) fail(errno);
  if (std::fclose(std::exchange(part_.file, nullptr)) != 0) fail(errno);
  sync_folder_of(part_.path);
}

void RecordingParts::close() {
  close_part();
  if (!moved_.empty())
    throw Unfinished("'" + moved_ + "' is not there any more: it was moved, removed or replaced while it was written");
}

void RecordingParts::fail(int reason) const { fail_to_write(part_.path, reason); }

}  // namespace jarol
