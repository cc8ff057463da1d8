#include "distributers/messages/message_set.h"

#include <algorithm>

namespace jarol::messages {
namespace {

using Forms = std::span<const MessageDescriptor* const>;

Forms those_of(Forms messages, std::uint32_t id) {
  const auto is_before = [](const MessageDescriptor* descriptor, std::uint32_t wanted) {
    return descriptor->id < wanted;
  };
  const auto first = std::lower_bound(messages.begin(), messages.end(), id, is_before);
  auto last = first;
  while (last != messages.end() && (*last)->id == id) ++last;
  return messages.subspan(static_cast<std::size_t>(first - messages.begin()), static_cast<std::size_t>(last - first));
}

}  // namespace

const MessageDescriptor* MessageSet::find(std::uint32_t id, std::size_t payload) const {
  const Forms of_id = those_of(messages, id);
  if (of_id.empty()) return nullptr;
  for (const MessageDescriptor* m : of_id)
    if (m->wire_size == static_cast<std::int64_t>(payload)) return m;
  return of_id.front();
}

const MessageDescriptor* MessageSet::find(std::string_view wanted) const {
  for (const MessageDescriptor* m : messages)
    if (m->name == wanted) return m;
  return nullptr;
}

const MessageDescriptor* MessageSet::find_nested(std::uint32_t id) const {
  const Forms of_id = those_of(messages, id);
  if (of_id.size() != 1) return nullptr;
  const MessageDescriptor* const descriptor = of_id.front();
  return !descriptor->fields.empty() && descriptor->fields.back().wire == Wire::rest ? nullptr : descriptor;
}

}  // namespace jarol::messages
