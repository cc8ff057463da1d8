// Whether packets come in the order in which their sender stamped them, where their headers have a time.
#pragma once

#include <cstdint>
#include <limits>

#include "distributers/messages/message.h"

namespace jarol::distributers {

class StampOrder {
 public:
  explicit StampOrder(const messages::MessageSet& set);

  /// True: one that the same sender has stamped later has come before it. A sender is a source at a peer, and one that
  /// follows another begins anew.
  bool is_late(messages::MessageRef header, std::uint32_t peer);

  /// A stream begins.
  void begin() { newest_ = {}; }

 private:
  struct Stamp {
    double time = -std::numeric_limits<double>::infinity();  // s since 1970, by the sender's clock
    std::uint64_t source = 0;
    std::uint32_t peer = 0;
  };
  const messages::FieldDescriptor* time_ = nullptr;
  const messages::FieldDescriptor* source_ = nullptr;
  Stamp newest_;
};

}  // namespace jarol::distributers
