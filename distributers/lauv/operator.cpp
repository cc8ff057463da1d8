#include "distributers/lauv/operator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "distributers/lauv/messages.h"
#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace {

using namespace std::chrono_literals;
using tasks::Drive;
using tasks::Turn;

constexpr double astern_depth = 0.2;  // m

}  // namespace

bool LauvOperator::is_finite(double value) {
  if (std::isfinite(value)) return true;
  ++non_finite_inputs_;
  return false;
}

// Who commanded last is the operator, whoever else is heard.
void LauvOperator::any_message(const messages::MessageRef& message) {
  const auto* const header = static_cast<const imc::Header*>(message.header);
  speaker_ = header == nullptr ? nobody : header->src;
  if (has_commanded_ && (!commander_ || *commander_ == speaker_)) heard_ = now_;
}

void LauvOperator::peer_changed() { has_commanded_ = false; }

void LauvOperator::note_command() {
  has_commanded_ = true;
  commander_ = speaker_;
  heard_ = now_;
}

void LauvOperator::desired_z(const imc::DesiredZ& z) {
  if (z.z_units != imc::ZUnits::DEPTH || !is_finite(z.value)) return refuse("DesiredZ is taken as a depth in m only");
  // the hand that steers keeps the propeller and the rudders
  if (mode_ != Mode::teleoperation && !use_autopilot()) return;
  // as DUNE, which goes no deeper than it may either
  const double wanted = static_cast<double>(z.value), max = parameters_.limits.max_depth - parameters_.limits.margin;
  const double within = std::min(std::max(wanted, 0.0), max);
  const bool is_new = std::exchange(wanted_depth_, wanted) != wanted;
  if (wanted > within && is_new)
    refuse(fmt::format("DesiredZ is {:.6g} m; depths are at most {:.6g} m: it goes there", wanted, max));
  if (wanted < within && is_new)
    refuse(fmt::format("DesiredZ is {:.6g} m; depths are not negative: it goes to the surface", wanted));
  in.setpoint.renew().depth = within;
}

void LauvOperator::desired_heading(const imc::DesiredHeading& heading) {
  if (!is_finite(heading.value)) return refuse("DesiredHeading is no number");
  if (!use_autopilot()) return;
  in.setpoint.renew().turn = Turn::heading;
  in.setpoint.renew().heading = heading.value;
}

void LauvOperator::desired_heading_rate(const imc::DesiredHeadingRate& rate) {
  if (!is_finite(rate.value)) return refuse("DesiredHeadingRate is no number");
  if (!use_autopilot()) return;
  in.setpoint.renew().turn = Turn::rate;
  in.setpoint.renew().rate = rate.value;
}

void LauvOperator::desired_speed(const imc::DesiredSpeed& speed) {
  const bool percent = speed.speed_units == imc::SpeedUnits::PERCENTAGE;
  if ((!percent && speed.speed_units != imc::SpeedUnits::METERS_PS) || !is_finite(speed.value))
    return refuse("DesiredSpeed is taken in m/s or % only");
  if (!use_autopilot()) return;
  tasks::Setpoint& setpoint = in.setpoint.renew();
  setpoint.drive = percent ? Drive::thrust : Drive::speed;
  const bool is_new = std::exchange(wanted_speed_, speed.value) != speed.value;
  if (!percent && speed.value < 0 && is_new)
    refuse("DesiredSpeed is negative; astern it goes by % only: the propeller stops");
  (percent ? setpoint.thrust : setpoint.speed) = percent ? limited(speed.value / 100, 1.0) : std::max(speed.value, 0.0);
  stop_astern();
}

// Astern the fins steer the other way round. Below the surface it sinks with 20 % already, and noses up beyond its
// limit with 70 %; stopped at that depth it comes to 2.2 m and 41 degrees at most (specs/vehicles, with 20 to 100 %).
bool LauvOperator::may_go_astern() const { return depth_ <= astern_depth; }

void LauvOperator::stop_astern() {
  if (may_go_astern() || in.setpoint->drive != Drive::thrust || in.setpoint->thrust >= 0) return;
  in.setpoint.renew().thrust = 0;
  refuse(fmt::format(
      "astern it goes at the surface only; below {} m the propeller stops, as the fins steer the other way round",
      astern_depth));
}

// An operator who has propeller and fins in hand; a graph that has no use for it does not take the channel.
void LauvOperator::set_thruster(const imc::SetThrusterActuation& thruster) {
  if (thruster.id != 0 || !is_finite(thruster.value)) return;
  in.actuation.renew().thruster = static_cast<double>(thruster.value);
}

void LauvOperator::set_servo(const imc::SetServoPosition& servo) {
  if (servo.id >= in.actuation->fins.size() || !is_finite(servo.value)) return;
  in.actuation.renew().fins[servo.id] = static_cast<double>(servo.value);
}

void LauvOperator::abort(const imc::Abort&) {
  demand_stop();
  set_mode(Mode::error);
  aborted_ = now_;
  last_error_ = "abort";
  last_error_at_ = unix_time();
  let_go_ = false;
}

// False: it has been aborted just now.
bool LauvOperator::use_autopilot() {
  if (mode_ == Mode::error) return false;
  note_command();
  end_plan("the operator commands depth, heading or speed");
  tasks::Setpoint& setpoint = in.setpoint.renew();
  if (mode_ != Mode::external) {
    setpoint = {setpoint.depth, heading_, 0};
    set_mode(Mode::external);
  }
  return true;
}

void LauvOperator::demand_stop() {
  ++stops_;
  if (ending_) overrides_end_.store(true, std::memory_order_relaxed);
  stop();
}

// The propeller stops; a little lighter than water, the vehicle comes up.
void LauvOperator::stop() {
  end_plan("stopped");
  if (mode_ == Mode::teleoperation) answer(imc::TeleoperationDone{}, plan_entity);
  in.setpoint = {0, heading_, 0};
  if (mode_ != Mode::error) set_mode(Mode::service);
}

void LauvOperator::set_mode(Mode mode) {
  if (mode_ == mode) return;
  mode_ = mode;
  mode_changed_ = true;
}

void LauvOperator::reach(Duration instant, messages::Receiver& system) {
  if (mode_ == Mode::teleoperation) steer_by_hand(instant);
  stop_astern();
  now_ = instant;
  if (mode_ == Mode::error && now_ - *aborted_ >= 1s) set_mode(Mode::service);
  if (plan_.pass(now_)) follow_plan();
  for (const Answer& each : answers_) {
    messages::MessageRef made = each.message;
    made.header = &each.header;
    system.receive(made);
  }
  answers_.clear();
  const std::int64_t second = now_ / 1s;
  const bool heartbeat = second_ != second;
  second_ = second;
  if (heartbeat) system.receive(messages::refer_to(imc::Heartbeat{}));
  if (heartbeat || mode_changed_) {
    send_vehicle_state(system);
    send_plan_state(system);
  }
  mode_changed_ = false;
}

}  // namespace jarol::distributers
