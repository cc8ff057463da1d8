// What the supervisor makes of fins and propeller that do not follow.
#pragma once

#include "tasks/lauv/supervisor.h"

namespace jarol::tasks {

bool is_low(const LauvSupervisor::Param& p, const Reading& voltage);

struct ActuatorCheck {
  Alarm alarm = Alarm::none;
  FinCheck fins = FinCheck::checked;
};

/// A battery that is flat stops propeller and servos, so the next reading of its voltage is waited for.
ActuatorCheck check_actuators(const LauvSupervisor::Param& p, const LauvSupervisor::In& in,
                              LauvSupervisor::State& state);

/// No servo has reported anything for long, though the vehicle is heard; dt in s.
bool are_fins_unchecked(const LauvSupervisor::Param& p, const FinCondition& fins, double dt,
                        LauvSupervisor::State& state);

}  // namespace jarol::tasks
