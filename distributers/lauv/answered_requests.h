// Which requests of operators were answered, so that one that comes twice is obeyed once.
#pragma once

#include <bit>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "distributers/messages/imc.h"
#include "distributers/messages/message.h"

namespace jarol::distributers {

/// Who asks numbers what it asks for, but anew after a restart; with the time at which it was sent a number is one
/// request's alone. A datagram that the network duplicates has both of the first one.
struct RequestId {
  std::uint32_t message = 0;
  std::uint16_t system = 0;
  std::uint8_t entity = 0;
  std::uint16_t number = 0;
  std::uint8_t operation = 0;
  std::uint64_t time = 0;  // its bits

  friend bool operator==(const RequestId&, const RequestId&) = default;
};

/// None: without a sender or the time at which it was sent nobody knows.
template <class M>
std::optional<RequestId> id_of(const M& request, std::uint8_t operation, const messages::MessageRef& from) {
  const auto* header = static_cast<const messages::imc::Header*>(from.header);
  if (header == nullptr || header->timestamp == 0) return std::nullopt;
  return RequestId{M::message_id,      header->src, header->src_ent,
                   request.request_id, operation,   std::bit_cast<std::uint64_t>(header->timestamp)};
}

class AnsweredRequests {
 public:
  /// Null: it was not answered yet, or long ago.
  const messages::Message* find(const std::optional<RequestId>& id) const {
    for (const auto& [each, answer] : answers_)
      if (each == id) return &answer;
    return nullptr;
  }
  void note(const std::optional<RequestId>& id, messages::Message answer) {
    if (!id) return;
    if (answers_.size() == max_kept) answers_.pop_front();
    answers_.emplace_back(*id, std::move(answer));
  }

 private:
  static constexpr std::size_t max_kept = 100;
  std::deque<std::pair<RequestId, messages::Message>> answers_;
};

}  // namespace jarol::distributers
