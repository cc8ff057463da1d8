// The adaptation layer of one kind of external system: its messages on one side, values of the core on the other.
#pragma once

#include <cstddef>

#include "distributers/messages/message.h"

namespace jarol::distributers {

class Adapter : public messages::Receiver {
 public:
  /// Copies the newest value of an `in` channel if a message brought one since the last call.
  virtual bool take(std::size_t channel, void* value) = 0;

  /// Turns a value of an `out` channel into messages for the external system.
  virtual void hand_over(std::size_t channel, const void* value, messages::Receiver& system) = 0;
};

}  // namespace jarol::distributers
