#include "distributers/links/timestamp.h"

#include <chrono>
#include <cstring>

namespace jarol::distributers {

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

const messages::FieldDescriptor* find_timestamp(const messages::MessageSet& set) {
  for (const messages::FieldDescriptor& field : set.header->fields)
    if (field.name == "timestamp" && field.wire == messages::Wire::fp64) return &field;
  return nullptr;
}

void set_timestamp(const messages::FieldDescriptor* field, void* header) {
  if (field == nullptr) return;
  const double now = seconds_since_1970();
  std::memcpy(static_cast<std::byte*>(header) + field->offset, &now, sizeof now);
}

}  // namespace jarol::distributers
