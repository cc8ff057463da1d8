#include "tasks/javiator/sensor_trust.h"

namespace jarol::tasks {

bool hear(SensorTrust& trust, bool is_new, double reading, std::uint32_t max_repeats, double dt) {
  trust.silent += dt;
  if (!is_new) return false;
  trust.repeats = reading == trust.last ? trust.repeats + 1 : 0;
  trust.last = reading;
  return max_repeats == 0 || trust.repeats < max_repeats;
}

bool believe(SensorTrust& trust, bool credible, double patience) {
  if (credible && !trust.lost) trust.silent = 0;
  trust.lost = trust.lost || trust.silent > patience;
  return credible && !trust.lost;
}

void forgive(SensorTrust& trust, bool heard) {
  trust.lost = false;
  if (heard) trust.silent = 0;
}

}  // namespace jarol::tasks
