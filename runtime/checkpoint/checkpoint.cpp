#include "runtime/checkpoint/checkpoint.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "graph/language/inputs.h"
#include "graph/text/errors.h"
#include "graph/values/digest.h"
#include "runtime/files/atomic_file.h"

namespace jarol {
namespace {

// the version of the file; what it holds is that of the program
constexpr std::string_view magic = "jarol.checkpoint/1\n";
constexpr std::size_t head = magic.size() + 2 * sizeof(std::uint64_t);  // then how many bytes follow, and their sum

constexpr std::uintmax_t max_bytes = std::uintmax_t{4} << 30;

std::string_view text_of(const std::byte* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

// Looks at the first bytes of a checkpoint that has so many in all.
void require_head(const Archive::Bytes& bytes, std::uint64_t whole) {
  if (text_of(bytes.data(), std::min(bytes.size(), magic.size())) != magic)
    throw CheckpointError("is no checkpoint of this version, " + std::string(magic.substr(0, magic.size() - 1)));
  if (bytes.size() < head) throw CheckpointError("is damaged: it is cut off");
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + magic.size(), sizeof size);
  if (size != whole - head)
    throw CheckpointError("is damaged: it should have " + std::to_string(size) + " bytes after its first " +
                          std::to_string(head) + ", and has " + std::to_string(whole - head));
}

// Its first bytes, so many at most.
Archive::Bytes first_bytes(const std::string& path, std::uintmax_t max) {
  std::ifstream file(path, std::ios::binary);
  Archive::Bytes bytes(std::min(max, std::filesystem::file_size(path)));
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw CheckpointError("can't be read");
  return bytes;
}

}  // namespace

const RunOrigin& Checkpoint::origin() const {
  if (origin_ == nullptr) throw CheckpointError("has nothing in it: it was moved elsewhere");
  return *origin_;
}

const Archive::Bytes* Checkpoint::find(std::string_view part) const {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const auto& each) { return each.first == part; });
  return found == parts_.end() ? nullptr : &found->second;
}

Archive::Bytes Checkpoint::to_bytes() const {
  Archive::Bytes bytes(head);
  Archive archive = Archive::to(bytes);
  RunOrigin origin = this->origin();
  Duration instant = instant_;
  auto parts = static_cast<std::uint64_t>(parts_.size());
  archive(origin, instant, parts);
  for (const auto& [part, state] : parts_) {
    std::string name = part;
    auto size = static_cast<std::uint64_t>(state.size());
    archive(name, size);
    bytes.insert(bytes.end(), state.begin(), state.end());
  }
  const std::uint64_t size = bytes.size() - head, sum = digest::name_hash(text_of(bytes.data() + head, size));
  std::memcpy(bytes.data(), magic.data(), magic.size());
  std::memcpy(bytes.data() + magic.size(), &size, sizeof size);
  std::memcpy(bytes.data() + magic.size() + sizeof size, &sum, sizeof sum);
  return bytes;
}

Checkpoint Checkpoint::from_bytes(const Archive::Bytes& bytes) {
  require_head(bytes, bytes.size());
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + magic.size() + sizeof(std::uint64_t), sizeof sum);
  if (sum != digest::name_hash(text_of(bytes.data() + head, bytes.size() - head)))
    throw CheckpointError("is damaged: its bytes do not have the sum that it says");
  try {
    Archive archive = Archive::from(bytes.data() + head, bytes.data() + bytes.size());
    auto origin = std::make_shared<RunOrigin>();
    Duration instant{};
    std::uint64_t parts = 0;
    archive(*origin, instant, parts);
    Checkpoint made(std::move(origin), instant);
    for (std::uint64_t i = 0; i < parts; ++i) {
      std::string name;
      std::uint64_t length = 0;
      archive(name, length);
      archive.require(length <= archive.left(), "has a part that is longer than it");
      Archive::Bytes state(length);
      archive.bytes(state.data(), length);
      made.parts_.emplace_back(std::move(name), std::move(state));
    }
    archive.require_end();
    return made;
  } catch (const ArchiveError& error) { throw CheckpointError(std::string("is damaged: it ") + error.what()); }
}

void Checkpoint::write(const std::string& path) const {
  const Archive::Bytes bytes = to_bytes();
  AtomicFile file(path);
  file.write(text_of(bytes.data(), bytes.size()));
  file.commit();
}

void Checkpoint::require_writable(const std::string& path) {
  std::error_code none;
  if (std::filesystem::exists(path, none)) {
    if (!std::filesystem::is_regular_file(path, none)) return;  // it is written in place
    const Archive::Bytes first = first_bytes(path, magic.size());
    if (!first.empty() && text_of(first.data(), first.size()) != magic)
      throw InputError("can't write '" + path + "': it is there and no checkpoint; choose another file, or remove it");
  }
  const AtomicFile made_and_gone(path);
}

Checkpoint Checkpoint::read(const std::string& path) {
  const std::string name = "'" + path + "' ";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw CheckpointError("can't read '" + path + "': it is no file");
  if (std::filesystem::file_size(path) > max_bytes) throw CheckpointError(name + "is larger than 4 GiB");
  note_input(path);
  try {
    // what is no checkpoint is not read to its end
    require_head(first_bytes(path, head), std::filesystem::file_size(path));
    return from_bytes(first_bytes(path, max_bytes));
  } catch (const CheckpointError& wrong) { throw CheckpointError(name + wrong.what()); }
}

}  // namespace jarol
