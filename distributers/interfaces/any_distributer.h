// The adaptation layer of one kind of external system: its messages on one side, values of the core on the other.
#pragma once

#include <cstddef>
#include <string>

#include "distributers/messages/message.h"
#include "distributers/messages/message_set.h"
#include "graph/language/quantities.h"

namespace jarol::distributers {

class AnyDistributer : public messages::Receiver {
 public:
  /// What is received from now on comes from another peer than before, as after the external system was started anew.
  /// Told where a link knows it by the sender's address, as over UDP, and of the first peer too.
  virtual void peer_changed() {}

  /// The message set that the external system speaks.
  virtual const messages::MessageSet& message_set() const = 0;

  /// An instant of a run; what the external system expects from time to time can be sent. Messages that arrived before
  /// it have been received.
  virtual void reach(Duration, messages::Receiver&) {}

  /// Where others reach this end of the link, as in udp://127.0.0.1:6001; told before the first instant.
  virtual void listen_at(const std::string&) {}

  /// After `reach`, for what goes to all who may look for this system, not to the peer alone.
  virtual void announce(Duration, messages::Receiver&) {}

  /// The run is over. Throws std::runtime_error if something can't be kept for the next one.
  virtual void finish() {}

  /// Readings that were not finite; they are not in the values of `in` channels.
  virtual std::uint64_t non_finite_inputs() const { return 0; }

  /// Copies the newest value of an `in` channel if a message brought one since the last call.
  virtual bool take(std::size_t channel, void* value) = 0;

  /// Turns a value of an `out` channel into messages for the external system.
  virtual void hand_over(std::size_t channel, const void* value, messages::Receiver& system) = 0;

  /// The same of an adapter that knows nothing of what the system was told before it, as another was there.
  virtual void take_over(std::size_t channel, const void* value, messages::Receiver& system) {
    hand_over(channel, value, system);
  }
};

}  // namespace jarol::distributers
