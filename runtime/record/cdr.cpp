#include "runtime/record/cdr.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace jarol {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t head_size = CdrEncoder::head_size;

bool is_number(const Type& type) {
  switch (type.kind) {
    case Kind::boolean:
    case Kind::signed_integer:
    case Kind::unsigned_integer:
    case Kind::floating:
    case Kind::duration:
    case Kind::enumeration: return true;
    default: return false;
  }
}

bool is_empty(const Type& type) { return type.kind == Kind::structure && type.fields.empty(); }

std::size_t aligned(std::size_t at, std::size_t to) { return (at + to - 1) / to * to; }

// Goes through a value in the order of CDR: out.numbers(bytes, size, count) for numbers of that size that lie one after
// the other in memory, out.length(length) before those of a sequence, out.gap() for the byte of a struct without
// members.
template <class Out>
void go_through(const Type& type, const std::byte* value, Out& out) {
  if (is_number(type)) return out.numbers(value, type.size, 1);
  if (is_empty(type)) return out.gap();
  if (type.kind == Kind::structure) {
    for (const TypeField& f : type.fields) go_through(*f.type, value + f.offset, out);
    return;
  }
  const std::byte* elements = value;
  std::size_t count = type.count;
  if (type.kind != Kind::array) {
    count = type.length(value);
    out.length(count);
    elements = static_cast<const std::byte*>(type.elements(value));
  }
  if (count == 0) return;
  if (type.kind == Kind::string) return out.numbers(elements, 1, count);
  const Type& element = *type.element;
  if (is_number(element)) return out.numbers(elements, element.size, count);
  for (std::size_t i = 0; i < count; ++i) go_through(element, elements + i * element.size, out);
}

struct Sizing {
  std::size_t at = 0;
  void numbers(const std::byte*, std::size_t size, std::size_t count) { at = aligned(at, size) + size * count; }
  void length(std::size_t) { at = aligned(at, 4) + 4; }
  void gap() { ++at; }
};

struct Writing {
  std::byte* begin;
  std::size_t at = 0;

  void align(std::size_t to) {
    for (const std::size_t end = aligned(at, to); at < end; ++at) begin[at] = std::byte{0};
  }
  void numbers(const std::byte* value, std::size_t size, std::size_t count) {
    align(size);
    std::memcpy(begin + at, value, size * count);
    at += size * count;
  }
  void length(std::size_t count) {
    align(4);
    const auto length = static_cast<std::uint32_t>(count);
    std::memcpy(begin + at, &length, sizeof length);
    at += sizeof length;
  }
  void gap() { begin[at++] = std::byte{0}; }
};

}  // namespace

CdrEncoder::CdrEncoder(const Type& type) : type_(&type) {
  if (type.is_deep()) return;
  // where each piece of a flat value goes is the same for all values
  struct Placing {
    const std::byte* begin;
    std::vector<Piece>& pieces;
    bool& has_gaps;
    std::size_t at = head_size;

    void numbers(const std::byte* value, std::size_t size, std::size_t count) {
      const std::size_t to = head_size + aligned(at - head_size, size);
      const auto from = static_cast<std::size_t>(value - begin);
      has_gaps = has_gaps || to != at;
      if (!pieces.empty() && pieces.back().from + pieces.back().bytes == from && to == at)
        pieces.back().bytes += size * count;
      else
        pieces.push_back({from, to, size * count});
      at = to + size * count;
    }
    void length(std::size_t) {}
    void gap() {
      has_gaps = true;
      ++at;
    }
  };
  const std::vector<std::byte> example(type.size);
  Placing placing{example.data(), pieces_, has_gaps_};
  go_through(type, example.data(), placing);
  flat_size_ = placing.at;
  is_one_piece_ = pieces_.size() == 1 && pieces_[0].from == 0 && !has_gaps_;
}

std::size_t CdrEncoder::deep_size(const void* value) const {
  Sizing sizing;
  go_through(*type_, static_cast<const std::byte*>(value), sizing);
  return head_size + sizing.at;
}

void CdrEncoder::encode_pieces(const std::byte* value, std::byte* to) const {
  if (has_gaps_) std::memset(to + head_size, 0, flat_size_ - head_size);
  for (const Piece& piece : pieces_) copy_short(to + piece.to, value + piece.from, piece.bytes);
  if (flat_size_ > 0) return;
  Writing writing{to + head_size};
  go_through(*type_, value, writing);
}

namespace {

// Reads numbers in the order of CDR; without a value it only checks.
class Reading {
 public:
  explicit Reading(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::string read(const Type& type, std::byte* value) {
    if (is_number(type)) return read_numbers(type, 1, value);
    if (is_empty(type)) return take(1, 1, nullptr);
    if (type.kind == Kind::structure) {
      for (const TypeField& f : type.fields)
        if (std::string wrong = read(*f.type, value == nullptr ? nullptr : value + f.offset); !wrong.empty())
          return wrong;
      return "";
    }
    std::size_t count = type.count;
    std::byte* elements = value;
    if (type.kind != Kind::array) {
      std::uint32_t length = 0;
      if (!take(4, 1, reinterpret_cast<std::byte*>(&length)).empty()) return "ends before its length";
      const std::size_t min = type.kind == Kind::string ? 1 : min_size(*type.element);
      if (length > (bytes_.size() - at_) / min) return "has a length of " + std::to_string(length) + " and fewer bytes";
      count = length;
      if (value != nullptr) elements = static_cast<std::byte*>(type.resize(value, count));
    }
    if (count == 0) return "";
    if (type.kind == Kind::string) return take(1, count, elements);
    if (is_number(*type.element)) return read_numbers(*type.element, count, elements);
    for (std::size_t i = 0; i < count; ++i)
      if (std::string wrong = read(*type.element, elements == nullptr ? nullptr : elements + i * type.element->size);
          !wrong.empty())
        return wrong;
    return "";
  }

  std::size_t left() const { return bytes_.size() - at_; }

 private:
  // bytes that any value of the type has, and at least one, which bounds what a length may ask for
  static std::size_t min_size(const Type& type) {
    if (is_number(type)) return type.size;
    if (type.kind == Kind::sequence || type.kind == Kind::string) return 4;
    if (type.kind == Kind::array) return std::max<std::size_t>(1, type.count * min_size(*type.element));
    std::size_t size = 0;
    for (const TypeField& f : type.fields) size += min_size(*f.type);
    return std::max<std::size_t>(1, size);
  }

  std::string read_numbers(const Type& type, std::size_t count, std::byte* value) {
    const std::size_t end = aligned(at_, type.size) + type.size * count;
    if (std::string wrong = take(type.size, count, value); !wrong.empty()) return wrong;
    for (std::size_t i = 0; type.kind == Kind::boolean && i < count; ++i)
      if (const auto byte = std::to_integer<unsigned>(bytes_[end - count + i]); byte > 1)
        return "has " + std::to_string(byte) + " where true or false stand";
    return "";
  }

  std::string take(std::size_t size, std::size_t count, std::byte* value) {
    const std::size_t begin = aligned(at_, size);
    if (begin > bytes_.size() || count > (bytes_.size() - begin) / size) return "ends before its bytes do";
    if (value != nullptr && count > 0) std::memcpy(value, bytes_.data() + begin, size * count);
    at_ = begin + size * count;
    return "";
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string decode_cdr(const Type& type, std::span<const std::byte> bytes, void* value) {
  if (bytes.size() < head_size || std::memcmp(bytes.data(), CdrEncoder::head, head_size) != 0)
    return "does not begin as little-endian CDR";
  Reading checking(bytes.subspan(head_size));
  if (std::string wrong = checking.read(type, nullptr); !wrong.empty()) return wrong;
  if (checking.left() > 0) return "ends " + std::to_string(checking.left()) + " bytes before they do";
  Reading(bytes.subspan(head_size)).read(type, static_cast<std::byte*>(value));
  return "";
}

}  // namespace jarol
