// The supervisor's inputs while nothing is wrong, for tests.
#pragma once

#include "tasks/lauv/supervisor.h"

namespace jarol::tests {

/// Five metres deep, level, at rest, all instruments reporting; their k-th readings.
inline tasks::LauvSupervisor::In calm_submarine(std::int64_t k) {
  tasks::LauvSupervisor::In in;
  in.setpoint = {3, 1.5, 1.2};
  tasks::Instruments& i = in.instruments;
  i.depth = {5, k};
  i.pressure = {1013.25 + 5 * 98.1, k};
  i.attitude = {0, 0, 0, k};
  i.rates = {0, 0, 0, k};
  i.forces = {0, 0, -9.81, k};
  i.heading = {0, k};
  i.velocity = {0, 0, 0, k};
  i.rpm = {0, k};
  i.altitude = {45, k};
  i.conductivity = {4.2, k};
  i.water_temperature = {14, k};
  for (const auto leak : tasks::leak_readings) i.*leak = {0, k};
  i.voltage = {25, k};
  i.current = {1, k};
  return in;
}

}  // namespace jarol::tests
