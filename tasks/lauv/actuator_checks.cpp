#include "tasks/lauv/actuator_checks.h"

#include <algorithm>
#include <cstddef>

namespace jarol::tasks {
namespace {

bool has_failed(FinState fin) { return fin == FinState::stuck || fin == FinState::silent; }

}  // namespace

bool is_low(const LauvSupervisor::Param& p, const Reading& voltage) {
  return voltage.count > 0 && voltage.value < p.min_voltage;
}

ActuatorCheck check_actuators(const LauvSupervisor::Param& p, const LauvSupervisor::In& in,
                              LauvSupervisor::State& state) {
  constexpr Alarm alarms[] = {Alarm::bottom_fin, Alarm::port_fin, Alarm::starboard_fin, Alarm::top_fin};
  constexpr FinCheck failed[] = {FinCheck::bottom_failed, FinCheck::port_failed, FinCheck::starboard_failed,
                                 FinCheck::top_failed};
  const Reading& voltage = in.instruments.voltage;
  const auto& fins = in.fins.states;
  const auto first = std::find_if(fins.begin(), fins.end(), has_failed);
  const bool propeller = in.fins.propeller == FinState::stuck;
  if (first == fins.end() && !propeller) {
    state.voltages_before_failure = voltage.count;
    return {};
  }
  if (voltage.count > 0 && voltage.count == state.voltages_before_failure) return {};
  const bool fin_alarms = first != fins.end() && p.fins_end_dive;
  if (is_low(p, voltage)) return {fin_alarms || propeller ? Alarm::voltage_limit : Alarm::none};
  ActuatorCheck found{propeller ? Alarm::propeller : Alarm::none};
  if (first == fins.end()) return found;
  const auto fin = static_cast<std::size_t>(first - fins.begin());
  if (fin_alarms) return {alarms[fin]};
  found.fins = std::any_of(first + 1, fins.end(), has_failed) ? FinCheck::several_failed : failed[fin];
  return found;
}

bool are_fins_unchecked(const LauvSupervisor::Param& p, const FinCondition& fins, double dt,
                        LauvSupervisor::State& state) {
  const bool none =
      std::all_of(fins.states.begin(), fins.states.end(), [](FinState fin) { return fin == FinState::unknown; });
  state.servos_silent_for = none && state.heard ? state.servos_silent_for + dt : 0;
  return state.servos_silent_for > p.sensor_timeout;
}

}  // namespace jarol::tasks
