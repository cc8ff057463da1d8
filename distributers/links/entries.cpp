#include "distributers/links/entries.h"

#include <algorithm>
#include <cstring>

#include "distributers/messages/payload.h"

namespace jarol::distributers {
namespace {

using messages::MessageDescriptor;
using messages::MessageSet;

struct Head {
  std::uint32_t peer = 0;
  std::uint32_t form = 0;     // index in the set
  std::uint32_t payload = 0;  // bytes, of a message that is not flat
  messages::ByteOrder order{};
};

// of structs, as of all memory that `new` gives
constexpr std::size_t alignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__;
constexpr std::size_t aligned(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }
constexpr std::size_t header_at = aligned(sizeof(Head));

std::size_t message_at(const MessageSet& set) { return aligned(header_at + set.header->size); }

}  // namespace

std::size_t longest_entry(const MessageSet& set) {
  std::size_t longest = 0;
  for (const MessageDescriptor* form : set.messages)
    longest = std::max(longest, form->flat ? form->size : set.max_payload);
  return message_at(set) + longest;
}

EntryWriter::EntryWriter(const MessageSet& set) : entry_(longest_entry(set)), message_at_(message_at(set)) {}

std::span<const std::byte> EntryWriter::write(const messages::PacketReader& packet, std::uint32_t peer) {
  const MessageDescriptor& form = *packet.descriptor();
  const auto payload = packet.payload();
  const Head head{peer, static_cast<std::uint32_t>(form.index), static_cast<std::uint32_t>(payload.size()),
                  packet.order()};
  std::memcpy(entry_.data(), &head, sizeof head);
  std::memcpy(entry_.data() + header_at, packet.header().value, packet.header().descriptor->size);
  std::byte* const message = entry_.data() + message_at_;
  if (!form.flat) {
    std::copy(payload.begin(), payload.end(), message);
    return std::span(entry_).first(message_at_ + payload.size());
  }
  form.construct(message);
  static_cast<void>(messages::read_payload(form, packet.order(), payload, message));  // as it was checked
  return std::span(entry_).first(message_at_ + form.size);
}

EntryReader::EntryReader(const MessageSet& set)
    : set_(set), entry_(longest_entry(set)), message_at_(message_at(set)), kept_(set.messages.size()) {}

messages::MessageRef EntryReader::read() {
  Head head;
  std::memcpy(&head, entry_.data(), sizeof head);
  peer_ = head.peer;
  const MessageDescriptor& form = *set_.messages[head.form];
  const std::byte* const header = entry_.data() + header_at;
  const std::byte* const message = entry_.data() + message_at_;
  if (form.flat) return {&form, message, header};
  messages::Message& kept = kept_[form.index];
  if (kept.descriptor() == nullptr) kept = messages::Message(form);
  static_cast<void>(messages::read_payload(form, head.order, {message, head.payload}, kept.value()));
  return {&form, kept.value(), header};
}

}  // namespace jarol::distributers
