#include "graph/values/archive.h"

#include <cstring>
#include <span>

#include "graph/text/article.h"
#include "graph/values/pack.h"

namespace jarol {

void Archive::require_end() const { require(at_ == end_, "goes on after its state"); }

void Archive::require(bool good, const char* what) const {
  if (restores() && !good) throw ArchiveError(what);
}

void Archive::bytes(void* data, std::size_t size) {
  if (size == 0) return;
  if (!restores()) {
    const auto* const from = static_cast<const std::byte*>(data);
    to_->insert(to_->end(), from, from + size);
    return;
  }
  require(size <= left(), "ends within its state");
  std::memcpy(data, at_, size);
  at_ += size;
}

void Archive::value(const Type& type, void* value) {
  if (!restores()) {
    const std::size_t before = to_->size();
    to_->resize(before + packed_size(type, value));
    pack(type, value, to_->data() + before);
    if (const std::string wrong = wrong_packed(type, std::span(*to_).subspan(before)); !wrong.empty())
      throw NotSaveable(with_article(type.name) + " " + wrong);
    return;
  }
  std::size_t size = 0;
  if (const std::string wrong = wrong_packed_begin(type, {at_, left()}, size); !wrong.empty())
    throw ArchiveError("has " + with_article(type.name) + " that " + wrong);
  unpack(type, at_, value);
  at_ += size;
}

void Archive::same(std::uint64_t number, const char* what) {
  std::uint64_t stored = number;
  bytes(&stored, sizeof stored);
  require(stored == number, what);
}

// Of a vector. Each element takes a byte at least.
std::size_t Archive::count(std::size_t now) {
  auto stored = static_cast<std::uint64_t>(now);
  bytes(&stored, sizeof stored);
  if (restores()) require(stored <= left(), "has more elements than bytes");
  return static_cast<std::size_t>(stored);
}

void Archive::part(bool& flag) {
  std::uint8_t byte = flag ? 1 : 0;
  bytes(&byte, 1);
  require(byte <= 1, "has another byte where true or false stand");
  flag = byte == 1;
}

void Archive::part(std::string& text) {
  const std::size_t size = count(text.size());
  if (restores()) text.resize(size);
  bytes(text.data(), size);
}

void Archive::part(std::vector<bool>& flags) {
  const std::size_t size = count(flags.size());
  if (restores()) flags.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    bool flag = flags[i];
    part(flag);
    flags[i] = flag;
  }
}

}  // namespace jarol
