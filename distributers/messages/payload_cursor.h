// Steps over a payload on the wire without taking it apart: where its messages end, and in the other order.
#pragma once

#include <span>
#include <string>
#include <type_traits>

#include "distributers/messages/message_set.h"

namespace jarol::messages {

constexpr std::size_t count_size = 2;  // bytes before texts, raw data and lists
constexpr std::size_t max_count = 0xffff;

/// Reads a payload field by field. With `Swap` it turns every number round where it lies.
template <bool Swap>
class PayloadCursor {
 public:
  using Byte = std::conditional_t<Swap, std::byte, const std::byte>;

  /// `order` is that of the bytes before they are turned round.
  PayloadCursor(const MessageSet& set, ByteOrder order, std::span<Byte> bytes, std::string* why)
      : set_(set), order_(order), rest_(bytes), why_(why) {}

  std::size_t left() const { return rest_.size(); }

  /// Over the fields of a message that lies in `depth` others; false if they are not all there.
  bool over_fields(const MessageDescriptor& descriptor, int depth);

  /// Over a nested message with its id; `found` is its form, null if the field holds none.
  bool over_inline(const FieldDescriptor& field, int depth, const MessageDescriptor*& found);

  /// Over a number of elements of at least `size` bytes each, which have to be there.
  bool over_count(std::size_t& count, std::size_t size);

  /// The bytes that were stepped over; null if so many are not there.
  Byte* take(std::size_t bytes);

  /// Says that `field` of `descriptor` is wrong as `why` says; always false.
  bool fail_in(const MessageDescriptor& descriptor, const FieldDescriptor& field);

 private:
  bool over_field(const FieldDescriptor& field, int depth);
  std::uint64_t take_unsigned(Byte* from, std::size_t size);

  const MessageSet& set_;
  const ByteOrder order_;
  std::span<Byte> rest_;
  std::string* const why_;
};

extern template class PayloadCursor<false>;
extern template class PayloadCursor<true>;

/// May a message of that form, or of none, stand in that field? If not, `why` says.
bool may_hold(const FieldDescriptor& field, const MessageDescriptor* descriptor, std::uint64_t id, std::string* why);

bool fail_too_deep(std::string* why);
bool fail_too_many(std::size_t length, std::string_view what, std::string* why);
bool fail_in_field(const MessageDescriptor& descriptor, const FieldDescriptor& field, std::string* why);

}  // namespace jarol::messages
