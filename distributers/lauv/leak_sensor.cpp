#include "distributers/lauv/leak_sensor.h"

#include <algorithm>

namespace jarol::distributers {

void LeakSensor::note(std::uint8_t entity, bool failed, tasks::Reading& reading) {
  entities_[entity] = {true, true, failed};
  const bool all =
      std::all_of(entities_.begin(), entities_.end(), [](const Entity& each) { return !each.known || each.reported; });
  reading.value = std::any_of(entities_.begin(), entities_.end(), [](const Entity& each) { return each.failed; });
  if (!all) return;
  reading.count = std::max<std::int64_t>(reading.count, 0) + 1;
  for (Entity& each : entities_) each.reported = false;
}

}  // namespace jarol::distributers
