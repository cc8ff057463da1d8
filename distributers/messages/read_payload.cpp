#include <cstring>

#include "distributers/messages/bytes.h"
#include "distributers/messages/payload.h"
#include "distributers/messages/payload_cursor.h"

namespace jarol::messages {
namespace {

using Bytes = Sequence<std::uint8_t>;
using List = Sequence<InlineMessage>;

class Reader {
 public:
  Reader(const MessageSet& set, ByteOrder order, std::span<const std::byte> bytes, std::string* why)
      : set_(set), order_(order), bytes_(bytes), cursor_(set, order, bytes, why), why_(why) {}

  std::size_t left() const { return cursor_.left(); }

  bool read_fields(const MessageDescriptor& descriptor, void* message) {
    for (const FieldDescriptor& field : descriptor.fields)
      if (!read_field(field, static_cast<std::byte*>(message) + field.offset))
        return cursor_.fail_in(descriptor, field);
    return true;
  }

 private:
  bool read_field(const FieldDescriptor& field, void* to) {
    std::size_t count = 0;
    switch (field.wire) {
      case Wire::plaintext: {
        if (!cursor_.over_count(count, 1)) return false;
        char* const text = static_cast<String*>(to)->resize(count);
        if (count > 0) std::memcpy(text, cursor_.take(count), count);
        return true;
      }
      case Wire::rawdata: return cursor_.over_count(count, 1) && read_bytes(*static_cast<Bytes*>(to), count);
      case Wire::rest: return read_bytes(*static_cast<Bytes*>(to), left());
      case Wire::message: return read_inline(field, *static_cast<InlineMessage*>(to));
      case Wire::message_list: return read_list(field, *static_cast<List*>(to));
      default: break;
    }
    const std::size_t size = size_of(field.wire);
    count = std::max(field.count, 1U);
    const std::byte* const from = cursor_.take(size * count);
    if (from != nullptr) copy_numbers(to, from, size, count, order_ == ByteOrder::big);
    return from != nullptr;
  }

  bool read_bytes(Bytes& to, std::size_t count) {
    to.resize(count);
    if (count > 0) std::memcpy(to.data(), cursor_.take(count), count);
    return true;
  }

  bool read_list(const FieldDescriptor& field, List& to) {
    std::size_t count = 0;
    if (!cursor_.over_count(count, size_of(set_.id_wire()))) return false;
    to.resize(count);
    for (InlineMessage& element : to)
      if (!read_inline(field, element)) return false;
    return true;
  }

  bool read_inline(const FieldDescriptor& field, InlineMessage& to) {
    const std::size_t begin = bytes_.size() - left();
    const MessageDescriptor* descriptor = nullptr;
    if (!cursor_.over_inline(field, 0, descriptor)) return false;
    to.id = descriptor == nullptr ? InlineMessage::none : descriptor->id;
    to.payload.clear();
    if (descriptor == nullptr) return true;
    const auto payload = bytes_.first(bytes_.size() - left()).subspan(begin + size_of(set_.id_wire()));
    to.payload.resize(payload.size());
    if (payload.empty()) return true;
    std::memcpy(to.payload.data(), payload.data(), payload.size());
    if (order_ == ByteOrder::little) return true;
    return PayloadCursor<true>(set_, order_, std::as_writable_bytes(std::span(to.payload.data(), payload.size())), why_)
        .over_fields(*descriptor, 1);
  }

  const MessageSet& set_;
  const ByteOrder order_;
  const std::span<const std::byte> bytes_;
  PayloadCursor<false> cursor_;
  std::string* const why_;
};

// Fields have to take all of the payload.
bool is_all(const MessageDescriptor& descriptor, std::size_t payload, std::size_t left, std::string* why) {
  if (left == 0) return true;
  if (why != nullptr)
    *why = std::string(descriptor.name) + " has " + std::to_string(payload - left) + " bytes of fields, but " +
           std::to_string(payload) + " of payload";
  return false;
}

}  // namespace

bool read_payload(const MessageDescriptor& descriptor, ByteOrder order, std::span<const std::byte> payload,
                  void* message, std::string* why) {
  Reader reader(descriptor.set(), order, payload, why);
  return reader.read_fields(descriptor, message) && is_all(descriptor, payload.size(), reader.left(), why);
}

bool check_payload(const MessageDescriptor& descriptor, ByteOrder order, std::span<const std::byte> payload,
                   std::string* why) {
  if (descriptor.wire_size == static_cast<std::int64_t>(payload.size())) return true;
  PayloadCursor<false> cursor(descriptor.set(), order, payload, why);
  return cursor.over_fields(descriptor, 0) && is_all(descriptor, payload.size(), cursor.left(), why);
}

bool take_inline(const MessageSet& set, const InlineMessage& from, Message& to, std::string* why) {
  to = Message();
  if (from.empty()) return true;
  const MessageDescriptor* const descriptor = set.find_nested(from.id);
  if (!may_hold({}, descriptor, from.id, why)) return false;
  to = Message(*descriptor);
  return read_payload(*descriptor, ByteOrder::little,
                      std::as_bytes(std::span(from.payload.data(), from.payload.size())), to.value(), why);
}

}  // namespace jarol::messages
