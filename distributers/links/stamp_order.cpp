#include "distributers/links/stamp_order.h"

#include <cstring>

#include "distributers/messages/message_set.h"

namespace jarol::distributers {

using messages::Wire;

StampOrder::StampOrder(const messages::MessageSet& set) {
  for (const messages::FieldDescriptor& field : set.header->fields) {
    if (field.name == "timestamp" && field.wire == Wire::fp64) time_ = &field;
    if (field.name == "src" && field.wire <= Wire::uint64) source_ = &field;
  }
}

bool StampOrder::is_late(messages::MessageRef header, std::uint32_t peer) {
  if (time_ == nullptr) return false;
  const auto* const fields = static_cast<const std::byte*>(header.value);
  Stamp stamp{0, 0, peer};
  std::memcpy(&stamp.time, fields + time_->offset, sizeof stamp.time);
  if (source_ != nullptr) std::memcpy(&stamp.source, fields + source_->offset, size_of(source_->wire));
  const bool late = stamp.source == newest_.source && stamp.peer == newest_.peer && stamp.time < newest_.time;
  if (!late) newest_ = stamp;
  return late;
}

}  // namespace jarol::distributers
