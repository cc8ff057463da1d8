#include "distributers/messages/payload_cursor.h"

#include <algorithm>

#include "distributers/messages/bytes.h"
#include "distributers/messages/payload.h"

namespace jarol::messages {

template <bool Swap>
bool PayloadCursor<Swap>::over_fields(const MessageDescriptor& descriptor, int depth) {
  for (const FieldDescriptor& field : descriptor.fields)
    if (!over_field(field, depth)) return fail_in(descriptor, field);
  return true;
}

template <bool Swap>
bool PayloadCursor<Swap>::over_field(const FieldDescriptor& field, int depth) {
  std::size_t count = 0;
  switch (field.wire) {
    case Wire::plaintext:
    case Wire::rawdata: return over_count(count, 1) && (take(count), true);
    case Wire::rest: return take(left()), true;
    case Wire::message: {
      const MessageDescriptor* descriptor = nullptr;
      return over_inline(field, depth, descriptor);
    }
    case Wire::message_list: {
      const MessageDescriptor* descriptor = nullptr;
      if (!over_count(count, size_of(set_.id_wire()))) return false;
      for (; count > 0; --count)
        if (!over_inline(field, depth, descriptor)) return false;
      return true;
    }
    default: break;
  }
  const std::size_t size = size_of(field.wire);
  count = std::max(field.count, 1U);
  [[maybe_unused]] Byte* const numbers = take(size * count);
  if (numbers == nullptr) return false;
  if constexpr (Swap) copy_numbers(numbers, numbers, size, count, true);
  return true;
}

// A nested message has no length: only its fields show where it ends. Whether the fields of one may hold what they hold
// is asked of whoever takes it out, who can say what is wrong.
template <bool Swap>
bool PayloadCursor<Swap>::over_inline(const FieldDescriptor& field, int depth, const MessageDescriptor*& found) {
  found = nullptr;
  const std::size_t id_size = size_of(set_.id_wire());
  Byte* const at = take(id_size);
  if (at == nullptr) return false;
  const auto id = static_cast<std::uint32_t>(take_unsigned(at, id_size));
  if (id == set_.no_id()) return true;
  if (depth == max_nested) return fail_too_deep(why_);
  found = set_.find_nested(id);
  if (!may_hold(depth == 0 ? field : FieldDescriptor{}, found, id, why_)) return false;
  if (over_fields(*found, depth + 1)) return true;
  if (why_ != nullptr) *why_ = "holds a message that can't be read: " + *why_;
  return false;
}

template <bool Swap>
bool PayloadCursor<Swap>::over_count(std::size_t& count, std::size_t size) {
  Byte* const at = take(count_size);
  if (at == nullptr) return false;
  count = take_unsigned(at, count_size);
  if (count * size <= left()) return true;
  return take(count * size) != nullptr;
}

template <bool Swap>
typename PayloadCursor<Swap>::Byte* PayloadCursor<Swap>::take(std::size_t bytes) {
  if (bytes > left()) {
    if (why_ != nullptr)
      *why_ = "needs " + std::to_string(bytes) + " bytes where " + std::to_string(left()) + " are left";
    return nullptr;
  }
  Byte* const from = rest_.data();
  rest_ = rest_.subspan(bytes);
  return from;
}

template <bool Swap>
bool PayloadCursor<Swap>::fail_in(const MessageDescriptor& descriptor, const FieldDescriptor& field) {
  return fail_in_field(descriptor, field, why_);
}

template <bool Swap>
std::uint64_t PayloadCursor<Swap>::take_unsigned(Byte* from, std::size_t size) {
  const std::uint64_t value = load_unsigned(from, size, order_);
  if constexpr (Swap) store_unsigned(from, size, other(order_), value);
  return value;
}

template class PayloadCursor<false>;
template class PayloadCursor<true>;

bool may_hold(const FieldDescriptor& field, const MessageDescriptor* descriptor, std::uint64_t id, std::string* why) {
  const auto fail = [why](const std::string& text) {
    if (why != nullptr) *why = text;
    return false;
  };
  if (descriptor == nullptr)
    return fail("holds message id " + std::to_string(id) +
                ", which is not in the set or can't stand in another message");
  if (field.ids.empty() || std::find(field.ids.begin(), field.ids.end(), id) != field.ids.end()) return true;
  return fail("holds " + std::string(descriptor->name) + ", which is no " + std::string(field.message_type));
}

bool fail_too_deep(std::string* why) {
  if (why != nullptr) *why = "is nested deeper than " + std::to_string(max_nested) + " messages";
  return false;
}

bool fail_too_many(std::size_t length, std::string_view what, std::string* why) {
  if (why != nullptr)
    *why = "has " + std::to_string(length) + " " + std::string(what) + "; at most " + std::to_string(max_count) +
           " can be sent";
  return false;
}

bool fail_in_field(const MessageDescriptor& descriptor, const FieldDescriptor& field, std::string* why) {
  if (why != nullptr) *why = "field '" + std::string(field.name) + "' of " + std::string(descriptor.name) + " " + *why;
  return false;
}

}  // namespace jarol::messages
