#include "vehicles/submarine/actuation.h"

#include <cmath>

#include "graph/math/geometry.h"
#include "graph/text/errors.h"
#include "graph/values/seed.h"
#include "vehicles/submarine/motion.h"

namespace jarol::vehicles {
namespace {
constexpr double step_seconds = SubmarineMotion::step_seconds;
}

SubmarineActuation::SubmarineActuation(const SubmarineParameters& parameters, std::uint64_t seed)
    : servo_parameters_(parameters.servos),
      thruster_(parameters.thruster),
      at_start_of_step_(parameters.vsim_compatible),
      timeout_(parameters.command_timeout / std::chrono::milliseconds(10)),
      failing_fins_{FailingActuator(parameters.failures.fin0, spread_seed(seed, "fin0.failure")),
                    FailingActuator(parameters.failures.fin1, spread_seed(seed, "fin1.failure")),
                    FailingActuator(parameters.failures.fin2, spread_seed(seed, "fin2.failure")),
                    FailingActuator(parameters.failures.fin3, spread_seed(seed, "fin3.failure"))},
      failing_propeller_(parameters.failures.propeller, spread_seed(seed, "propeller.failure")) {
  if (parameters.command_timeout < Duration{}) throw InputError("submarine: command_timeout is below zero");
  if (!(thruster_.time_constant >= 0.0)) throw InputError("submarine: thruster.time_constant is below zero");
  if (!(servo_parameters_.limit >= 0.0)) throw InputError("submarine: servos.limit is below zero");
  if (!(servo_parameters_.slew > 0.0)) throw InputError("submarine: servos.slew must be above zero");
  if (!(thruster_.max_thrust >= 0.0)) throw InputError("submarine: thruster.max_thrust is below zero");
}

void SubmarineActuation::command_thruster(double actuation) {
  if (!std::isfinite(actuation)) return;
  thruster_command_ = limited(actuation, 1.0);
  thruster_silence_ = 0;
}

void SubmarineActuation::command_servo(std::size_t servo, double angle) {
  if (servo >= servo_commands_.size() || !std::isfinite(angle)) return;
  servo_commands_[servo] = limited(angle, servo_parameters_.limit);
  servo_silence_[servo] = 0;
}

SubmarineInput SubmarineActuation::step(bool powered) {
  // whoever commands no longer is lost: propeller off, fins neutral
  const auto lost = [this](std::int64_t& silence) { return timeout_ > 0 && silence++ >= timeout_; };
  if (lost(thruster_silence_)) thruster_command_ = 0.0;
  for (std::size_t i = 0; i < servos_.size(); ++i)
    if (lost(servo_silence_[i])) servo_commands_[i] = 0.0;

  const double now = static_cast<double>(steps_++) * step_seconds;

  // the plant sees where the actuators are on average over the step; VSIM's fins are a task of their own, which it
  // hears of one step later
  SubmarineInput input;
  const double reach = powered ? servo_parameters_.slew * step_seconds : 0.0;
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const double before = servos_[i];
    const double command = failing_fins_[i].command(now, servo_commands_[i], servo_parameters_.limit);
    if (!failing_fins_[i].is_stuck(now)) servos_[i] += limited(command - before, reach);
    const double part = failing_fins_[i].part(now);  // lift grows with the angle
    input.fins[i] = part * (at_start_of_step_ ? before : 0.5 * (before + servos_[i]));
  }

  // first-order lag, solved exactly; thrust grows with the square of the speed
  const double speed = std::sqrt(failing_propeller_.part(now)) * thruster_.full_speed;
  const double actuation = failing_propeller_.command(now, thruster_command_, 1.0);
  const double command = powered ? actuation * speed : 0.0, before = propeller_;
  const double kept = thruster_.time_constant > 0.0 ? std::exp(-step_seconds / thruster_.time_constant) : 0.0;
  if (!powered || !failing_propeller_.is_stuck(now)) propeller_ = command + (before - command) * kept;
  input.propeller = kept == 0.0 ? propeller_ : 0.5 * (before + propeller_);
  return input;
}

}  // namespace jarol::vehicles
