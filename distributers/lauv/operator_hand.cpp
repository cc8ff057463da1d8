// The operator's hand: RemoteActions of a stick, as in Neptus.
#include <utility>

#include "distributers/lauv/messages.h"
#include "distributers/lauv/operator.h"
#include "distributers/lauv/tuple_list.h"
#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace {

using tasks::Drive;
using tasks::Turn;

constexpr double axis_end = 127;

}  // namespace

void LauvOperator::remote_actions(const imc::RemoteActions& message) {
  const TupleList actions(message.actions);
  const bool silent = !hand_heard_ || seconds(now_ - *hand_heard_) >= parameters_.silence;
  hand_heard_ = now_;
  if (silent) let_go_ = true;
  if (mode_ == Mode::error || mode_ == Mode::plan || !let_go_) return;
  if (actions.is_set("Exit")) {
    if (mode_ == Mode::teleoperation) finish_teleoperation();
    return;
  }
  if (mode_ != Mode::teleoperation) start_teleoperation();
  note_command();
  if (silent) heading_axis_ = thrust_axis_ = 0;
  if (const auto heading = actions.number("Heading")) heading_axis_ = *heading;
  tasks::Setpoint& setpoint = in.setpoint.renew();
  setpoint.rate = limited(heading_axis_ / axis_end, 1.0) * parameters_.full_rate;
  // an axis that rests leaves the thrust to the buttons
  if (const auto thrust = actions.number("Thrust"); thrust && *thrust != thrust_axis_) {
    thrust_axis_ = *thrust;
    setpoint.thrust = limited(thrust_axis_ / axis_end, 1.0) * parameters_.full_thrust;
    stop_astern();
  }
  const int button = (actions.is_set("Accelerate") ? 1 : 0) - (actions.is_set("Decelerate") ? 1 : 0);
  if (std::exchange(button_, button) != button) button_refused_ = false;
  if (actions.is_set("Stop")) setpoint.thrust = 0;
}

void LauvOperator::start_teleoperation() {
  in.setpoint = {in.setpoint->depth, heading_, 0, Turn::rate, 0, Drive::thrust, 0};
  heading_axis_ = thrust_axis_ = 0;
  button_ = 0;
  let_go_ = true;
  maneuver_start_ = unix_time();
  note_command();
  set_mode(Mode::teleoperation);
}

void LauvOperator::steer_by_hand(Duration instant) {
  if (button_ != 0) {
    const double change = button_ * parameters_.button_rate * seconds(instant - now_);
    double& thrust = in.setpoint.renew().thrust;
    thrust = limited(thrust + change, parameters_.full_thrust);
    // once for as long as it is held
    if (thrust < 0 && !may_go_astern() && std::exchange(button_refused_, true)) thrust = 0;
    stop_astern();
  }
  const bool rests = in.setpoint->thrust == 0 && in.setpoint->rate == 0;
  if (rests || !hand_heard_ || seconds(instant - *hand_heard_) < parameters_.silence) return;
  in.setpoint.renew().thrust = in.setpoint.renew().rate = 0;
  button_ = 0;
}

}  // namespace jarol::distributers
