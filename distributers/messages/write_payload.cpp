#include <cstring>

#include "distributers/messages/bytes.h"
#include "distributers/messages/payload.h"
#include "distributers/messages/payload_cursor.h"

namespace jarol::messages {
namespace {

using Bytes = Sequence<std::uint8_t>;
using List = Sequence<InlineMessage>;

class Writer {
 public:
  Writer(const MessageSet& set, ByteOrder order, std::vector<std::byte>& to, std::string* why)
      : set_(set), order_(order), to_(to), why_(why) {}

  bool write_fields(const MessageDescriptor& descriptor, const void* message) {
    for (const FieldDescriptor& field : descriptor.fields)
      if (!write_field(field, static_cast<const std::byte*>(message) + field.offset))
        return fail_in_field(descriptor, field, why_);
    return true;
  }

 private:
  bool write_field(const FieldDescriptor& field, const void* from) {
    switch (field.wire) {
      case Wire::plaintext: {
        const std::string_view text = static_cast<const String*>(from)->view();
        return write_counted(text.data(), text.size());
      }
      case Wire::rawdata: {
        const auto& bytes = *static_cast<const Bytes*>(from);
        return write_counted(bytes.data(), bytes.size());
      }
      case Wire::rest: {
        const auto& bytes = *static_cast<const Bytes*>(from);
        write_bytes(bytes.data(), bytes.size());
        return true;
      }
      case Wire::message: return write_inline(field, *static_cast<const InlineMessage*>(from));
      case Wire::message_list: return write_list(field, *static_cast<const List*>(from));
      default: break;
    }
    const std::size_t size = size_of(field.wire), count = std::max(field.count, 1U);
    to_.resize(to_.size() + size * count);
    copy_numbers(to_.data() + to_.size() - size * count, from, size, count, order_ == ByteOrder::big);
    return true;
  }

  bool write_counted(const void* from, std::size_t length) {
    if (length > max_count) return fail_too_many(length, "bytes", why_);
    append_unsigned(to_, count_size, order_, length);
    write_bytes(from, length);
    return true;
  }

  void write_bytes(const void* from, std::size_t length) {
    const auto* const bytes = static_cast<const std::byte*>(from);
    to_.insert(to_.end(), bytes, bytes + length);
  }

  bool write_list(const FieldDescriptor& field, const List& list) {
    if (list.size() > max_count) return fail_too_many(list.size(), "messages", why_);
    append_unsigned(to_, count_size, order_, list.size());
    for (const InlineMessage& element : list)
      if (!write_inline(field, element)) return false;
    return true;
  }

  // whoever filled the field: it is looked through before it leaves
  bool write_inline(const FieldDescriptor& field, const InlineMessage& from) {
    append_unsigned(to_, size_of(set_.id_wire()), order_, from.empty() ? set_.no_id() : from.id);
    if (from.empty()) return true;
    const MessageDescriptor* const descriptor = set_.find_nested(from.id);
    if (!may_hold(field, descriptor, from.id, why_)) return false;
    const auto payload = std::as_bytes(std::span(from.payload.data(), from.payload.size()));
    PayloadCursor<false> cursor(set_, ByteOrder::little, payload, why_);
    if (!cursor.over_fields(*descriptor, 1)) {
      if (why_ != nullptr) *why_ = "holds a message that can't be read: " + *why_;
      return false;
    }
    if (cursor.left() > 0) {
      if (why_ != nullptr)
        *why_ = "holds " + std::string(descriptor->name) + " with " + std::to_string(cursor.left()) + " bytes too many";
      return false;
    }
    write_bytes(payload.data(), payload.size());
    if (order_ == ByteOrder::little) return true;
    return PayloadCursor<true>(set_, ByteOrder::little, std::span(to_).last(payload.size()), why_)
        .over_fields(*descriptor, 1);
  }

  const MessageSet& set_;
  const ByteOrder order_;
  std::vector<std::byte>& to_;
  std::string* const why_;
};

}  // namespace

bool write_payload(MessageRef message, ByteOrder order, std::vector<std::byte>& to, std::string* why) {
  const std::size_t before = to.size();
  if (Writer(message.descriptor->set(), order, to, why).write_fields(*message.descriptor, message.value)) return true;
  to.resize(before);
  return false;
}

bool put_inline(MessageRef message, InlineMessage& to, std::string* why) {
  std::vector<std::byte> payload;
  if (!write_payload(message, ByteOrder::little, payload, why)) return false;
  to.id = message.descriptor->id;
  to.payload.resize(payload.size());
  if (!payload.empty()) std::memcpy(to.payload.data(), payload.data(), payload.size());
  return true;
}

}  // namespace jarol::messages
