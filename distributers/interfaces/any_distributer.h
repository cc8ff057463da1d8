// A distributer as links and the classes of ExternalSystem see it: messages on one side, values of the core on the
// other, whatever its type. Who writes one writes a plain class, see distributer.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "distributers/messages/message.h"
#include "distributers/messages/message_set.h"
#include "graph/language/quantities.h"
#include "graph/values/archive.h"

namespace jarol::distributers {

class AnyDistributer : public messages::Receiver {
 public:
  /// The message set that the external system speaks.
  virtual const messages::MessageSet& message_set() const = 0;

  /// What is received from now on comes from another peer than before, as after the external system was started anew.
  /// Where a link knows that by the sender's address, as over UDP, and for the first peer too. Where a link has several
  /// at once: when one comes after the last has left or is silent.
  virtual void peer_changed() = 0;

  /// An instant of a run; what the external system expects from time to time can be sent. Messages that arrived before
  /// it have been received.
  virtual void reach(Duration instant, messages::Receiver& system) = 0;

  /// Where others reach this end of the link, as in udp://127.0.0.1:6001; before the first instant.
  virtual void listen_at(const std::string& address) = 0;

  /// After `reach`, for what goes to all who may look for this system, not to the peer alone.
  virtual void announce(Duration instant, messages::Receiver& all) = 0;

  /// From the next instant on the vehicle is brought to rest, as the graph states; before `reach`, once.
  virtual void ending() = 0;
  /// Then: its operator has demanded a stop, and what it commands counts in place of that. Any thread.
  virtual bool overrides_end() const = 0;

  /// The vehicle's own controllers steer it, or may: it is sent nothing by the distributer, and by no guardian if the
  /// run crashes meanwhile.
  virtual bool steers_itself() const = 0;

  /// The run is over. Throws std::runtime_error if something can't be kept for the next one.
  virtual void finish() = 0;

  /// How many of the messages that it has received a vehicle's had a use for; of others all count. Any thread.
  virtual std::uint64_t used() const = 0;

  /// Readings that were not finite; they are not in the values of `in` channels.
  virtual std::uint64_t non_finite_inputs() const = 0;

  /// Copies the value of an `in` channel if there is a new one since the last call.
  virtual bool take(std::size_t channel, void* value) = 0;

  /// Turns a value of an `out` channel into messages for the external system.
  virtual void hand_over(std::size_t channel, const void* value, messages::Receiver& system) = 0;

  /// What changes while a run goes on, between two instants. Throws NotSaveable.
  virtual void serialize(Archive& archive) = 0;

  /// What is handed over next follows what another has sent, which is not known.
  virtual void take_over() = 0;
};

}  // namespace jarol::distributers
