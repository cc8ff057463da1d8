// A leak sensor of the submarine, by what its entity says of its state.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/archive.h"
#include "tasks/values/instruments.h"

namespace jarol::distributers {

/// One entity, or several whose labels begin alike. Water at any of them is a leak, and one that falls silent is as
/// good as none: a reading counts when all that are known have reported since the last one did, however often each
/// does.
class LeakSensor {
 public:
  /// What one of them says.
  void note(std::uint8_t entity, bool failed, tasks::Reading& reading);

  void serialize(Archive& archive) { archive(entities_); }

 private:
  struct Entity {
    bool known = false;
    bool reported = false;  // since the last reading that counted
    bool failed = false;
    void serialize(Archive& archive) { archive(known, reported, failed); }
  };
  std::array<Entity, 256> entities_{};
};

}  // namespace jarol::distributers
