// The channels of one distributer while a graph runs: how values of the core reach an external system and come from it.
#pragma once

#include <optional>

#include "graph/values/type_of.h"

namespace jarol {

class Channels {
 public:
  virtual ~Channels() = default;

  /// Step 0 of an instant: the external system reaches it with the inputs that it held before; sensors sample.
  virtual void reach(Duration instant) = 0;

  /// Copies the channel's newest value if one came since the last call; false: there is none.
  virtual bool take(std::size_t channel, void* value) = 0;

  /// Gives the channel a value at the present instant.
  virtual void hand_over(std::size_t channel, const void* value) = 0;

  /// The instant at which the mission ends, for an external system that has one.
  virtual std::optional<Duration> end() const { return std::nullopt; }
};

}  // namespace jarol
