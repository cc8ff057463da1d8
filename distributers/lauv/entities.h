// The entities of a system that speaks IMC: parts of it that send, by number and by label.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "distributers/messages/imc.h"
#include "distributers/messages/message.h"
#include "graph/values/archive.h"

namespace jarol::distributers {

class Entities {
 public:
  /// Of a message that says of no entity that it sent it.
  static constexpr std::uint8_t nobody = 255;

  /// Who sent a message, by the header of its packet.
  static std::uint8_t sender_of(const messages::MessageRef& message);

  /// As EntityInfo and EntityList report.
  void note(const messages::imc::EntityInfo& info);
  void note(const messages::imc::EntityList& list);
  void forget() { labels_ = {}; }

  void serialize(Archive& archive) { archive(labels_); }

  bool has_label(std::uint8_t id) const { return !labels_[id].empty(); }

  /// Is that its label, or the begin of it where the name ends in *? Only an entity whose label is known is any but
  /// "*".
  bool is(std::uint8_t id, std::string_view name) const;

 private:
  std::array<std::string, 256> labels_;
};

}  // namespace jarol::distributers
