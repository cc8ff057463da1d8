#include "distributers/messages/message_set.h"

#include <algorithm>

namespace jarol::messages {
namespace {

auto those_of(std::span<const MessageForm* const> messages, std::uint32_t id) {
  return std::ranges::equal_range(messages, id, {}, [](const MessageForm* m) { return m->id; });
}

}  // namespace

const MessageForm* MessageSet::find(std::uint32_t id, std::size_t payload) const {
  const auto of_id = those_of(messages, id);
  if (of_id.empty()) return nullptr;
  for (const MessageForm* m : of_id)
    if (m->wire_size == static_cast<std::int64_t>(payload)) return m;
  return of_id.front();
}

const MessageForm* MessageSet::find(std::string_view wanted) const {
  for (const MessageForm* m : messages)
    if (m->name == wanted) return m;
  return nullptr;
}

const MessageForm* MessageSet::find_nested(std::uint32_t id) const {
  const auto of_id = those_of(messages, id);
  if (of_id.size() != 1) return nullptr;
  const MessageForm* const form = of_id.front();
  return !form->fields.empty() && form->fields.back().wire == Wire::rest ? nullptr : form;
}

const MessageSet* find_message_set(std::string_view name) {
  for (const MessageSet* set : message_sets())
    if (set->name == name) return set;
  return nullptr;
}

}  // namespace jarol::messages
