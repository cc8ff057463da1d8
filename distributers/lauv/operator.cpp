#include "distributers/lauv/operator.h"

#include <algorithm>
#include <cmath>

#include "distributers/lauv/messages.h"
#include "distributers/lauv/tuple_list.h"
#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace {

using namespace std::chrono_literals;
using tasks::Drive;
using tasks::Turn;

constexpr double axis_end = 127;
constexpr std::string_view actions_known =
    "Exit=Button;Accelerate=Button;Decelerate=Button;Stop=Button;Heading=Axis;Thrust=Axis;Ranges=Range127";

std::string_view name_of(tasks::Alarm alarm) {
  for (const auto& e : enumerators(alarm))
    if (e.value == alarm) return e.name;
  return "";
}

}  // namespace

bool LauvOperator::is_finite(double value) {
  if (std::isfinite(value)) return true;
  ++non_finite_inputs_;
  return false;
}

void LauvOperator::desired_z(const imc::DesiredZ& z) {
  if (z.z_units != imc::ZUnits::DEPTH || !is_finite(z.value)) return refuse("DesiredZ is taken as a depth in m only");
  // the hand that steers keeps the propeller and the rudders
  if (mode_ != Mode::teleoperation && !use_autopilot()) return;
  in.setpoint.renew().depth = static_cast<double>(z.value);
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
  (percent ? setpoint.thrust : setpoint.speed) = percent ? std::clamp(speed.value / 100, -1.0, 1.0) : speed.value;
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

void LauvOperator::plan_control(const imc::PlanControl& plan) {
  if (plan.type != imc::PlanControl::Type::REQUEST) return;
  imc::PlanControl reply;
  reply.op = plan.op;
  reply.request_id = plan.request_id;
  reply.plan_id = plan.plan_id;
  if (plan.op == imc::PlanControl::Op::START) {
    reply.info = execute(plan.arg.id);
  } else if (plan.op == imc::PlanControl::Op::STOP) {
    demand_stop();
  } else {
    reply.info = "plans are not stored here";
  }
  reply.type = reply.info == "" ? imc::PlanControl::Type::SUCCESS : imc::PlanControl::Type::FAILURE;
  answer(reply);
}

void LauvOperator::vehicle_command(const imc::VehicleCommand& command) {
  if (command.type != imc::VehicleCommand::Type::REQUEST) return;
  imc::VehicleCommand reply;
  reply.request_id = command.request_id;
  reply.command = command.command;
  if (command.command == imc::VehicleCommand::Command::EXEC_MANEUVER) {
    reply.info = execute(command.maneuver.id);
  } else if (command.command == imc::VehicleCommand::Command::STOP_MANEUVER) {
    demand_stop();
  } else {
    reply.info = "there is nothing to calibrate";
  }
  reply.type = reply.info == "" ? imc::VehicleCommand::Type::SUCCESS : imc::VehicleCommand::Type::FAILURE;
  answer(reply);
}

void LauvOperator::actions_request(const imc::RemoteActionsRequest& request) {
  if (request.op != imc::RemoteActionsRequest::Op::QUERY) return;
  answer(imc::RemoteActionsRequest{imc::RemoteActionsRequest::Op::REPORT, actions_known});
}

void LauvOperator::entity_list(const imc::EntityList& list) {
  if (list.op != imc::EntityList::Op::QUERY) return;
  answer(imc::EntityList{imc::EntityList::Op::REPORT, entities_known});
}

void LauvOperator::remote_actions(const imc::RemoteActions& message) {
  const TupleList actions(message.actions);
  const bool silent = !hand_heard_ || seconds(now_ - *hand_heard_) >= parameters_.silence;
  hand_heard_ = now_;
  if (silent) let_go_ = true;
  if (mode_ == Mode::error || !let_go_) return;
  if (actions.is_set("Exit")) {
    if (mode_ == Mode::teleoperation) stop();
    return;
  }
  if (mode_ != Mode::teleoperation) start_teleoperation();
  if (silent) heading_axis_ = thrust_axis_ = 0;
  if (const auto heading = actions.number("Heading")) heading_axis_ = *heading;
  tasks::Setpoint& setpoint = in.setpoint.renew();
  setpoint.rate = std::clamp(heading_axis_ / axis_end, -1.0, 1.0) * parameters_.full_rate;
  // an axis that rests leaves the thrust to the buttons
  if (const auto thrust = actions.number("Thrust"); thrust && *thrust != thrust_axis_) {
    thrust_axis_ = *thrust;
    setpoint.thrust = std::clamp(thrust_axis_ / axis_end, -1.0, 1.0) * parameters_.full_thrust;
  }
  button_ = (actions.is_set("Accelerate") ? 1 : 0) - (actions.is_set("Decelerate") ? 1 : 0);
  if (actions.is_set("Stop")) setpoint.thrust = 0;
}

void LauvOperator::abort(const imc::Abort&) {
  demand_stop();
  set_mode(Mode::error);
  aborted_ = now_;
  let_go_ = false;
}

// False: it has been aborted just now.
bool LauvOperator::use_autopilot() {
  if (mode_ == Mode::error) return false;
  tasks::Setpoint& setpoint = in.setpoint.renew();
  if (mode_ != Mode::external) {
    setpoint = {setpoint.depth, heading_, 0};
    set_mode(Mode::external);
  }
  return true;
}

void LauvOperator::start_teleoperation() {
  in.setpoint = {in.setpoint->depth, heading_, 0, Turn::rate, 0, Drive::thrust, 0};
  heading_axis_ = thrust_axis_ = 0;
  button_ = 0;
  let_go_ = true;
  set_mode(Mode::teleoperation);
}

void LauvOperator::demand_stop() {
  ++stops_;
  stop();
}

// The propeller stops; a little lighter than water, the vehicle comes up.
void LauvOperator::stop() {
  if (mode_ == Mode::teleoperation) answer(imc::TeleoperationDone{});
  in.setpoint = {0, heading_, 0};
  if (mode_ != Mode::error) set_mode(Mode::service);
}

void LauvOperator::set_mode(Mode mode) {
  if (mode_ == mode) return;
  mode_ = mode;
  mode_changed_ = true;
}

// Why not, or nothing.
std::string LauvOperator::execute(std::uint32_t maneuver) {
  if (maneuver != imc::Teleoperation::message_id) return "no other maneuver than Teleoperation is known here";
  if (mode_ == Mode::error) return "just aborted";
  start_teleoperation();
  return "";
}

void LauvOperator::refuse(const std::string& text) {
  imc::LogBookEntry entry;
  entry.type = imc::LogBookEntry::Type::WARNING;
  entry.context = "operator";
  entry.text = text;
  answer(entry);
}

void LauvOperator::reach(Duration instant, messages::Receiver& system) {
  if (mode_ == Mode::teleoperation) steer_by_hand(instant);
  now_ = instant;
  if (mode_ == Mode::error && now_ - *aborted_ >= 1s) set_mode(Mode::service);
  for (const messages::Message& message : answers_) system.receive(message);
  answers_.clear();
  const std::int64_t second = now_ / 1s;
  const bool heartbeat = second_ != second;
  second_ = second;
  if (heartbeat) system.receive(messages::refer_to(imc::Heartbeat{}));
  if (heartbeat || mode_changed_) send_vehicle_state(system);
  mode_changed_ = false;
}

void LauvOperator::steer_by_hand(Duration instant) {
  if (button_ != 0) {
    const double change = button_ * parameters_.button_rate * seconds(instant - now_);
    double& thrust = in.setpoint.renew().thrust;
    thrust = std::clamp(thrust + change, -parameters_.full_thrust, parameters_.full_thrust);
  }
  const bool rests = in.setpoint->thrust == 0 && in.setpoint->rate == 0;
  if (rests || !hand_heard_ || seconds(instant - *hand_heard_) < parameters_.silence) return;
  in.setpoint.renew().thrust = in.setpoint.renew().rate = 0;
  button_ = 0;
}

void LauvOperator::send_vehicle_state(messages::Receiver& system) const {
  using Loops = imc::CLoopsMask;
  imc::VehicleState state;
  imc::PlanControlState plan;
  state.maneuver_type = plan.man_type = 0xffff;
  state.maneuver_eta = 0xffff;
  plan.plan_eta = plan.man_eta = -1;
  plan.state = imc::PlanControlState::State::READY;
  if (aborted_) {
    state.last_error = "abort";
    plan.last_outcome = imc::PlanControlState::LastOutcome::FAILURE;
  }
  const std::int64_t turning = in.setpoint->turn == Turn::rate ? Loops::YAW_RATE : Loops::YAW;
  const std::int64_t driving = in.setpoint->drive == Drive::thrust ? Loops::THROTTLE : Loops::SPEED;
  const auto loops = static_cast<std::uint32_t>(Loops::DEPTH | Loops::TORQUE | turning | driving);
  switch (mode_) {
    case Mode::service: state.op_mode = imc::VehicleState::OpMode::SERVICE; break;
    case Mode::external:
      state.op_mode = imc::VehicleState::OpMode::EXTERNAL;
      state.control_loops = loops;
      break;
    case Mode::teleoperation:
      state.op_mode = imc::VehicleState::OpMode::MANEUVER;
      state.maneuver_type = plan.man_type = imc::Teleoperation::message_id;
      state.control_loops = loops | static_cast<std::uint32_t>(Loops::TELEOPERATION);
      plan.state = imc::PlanControlState::State::EXECUTING;
      break;
    case Mode::error:
      state.op_mode = imc::VehicleState::OpMode::ERROR;
      state.error_count = 1;
      state.error_ents = operator_entity;
      plan.state = imc::PlanControlState::State::BLOCKED;
      break;
  }
  // whatever the operator commands but a stop, it comes up
  if (alarm_ != tasks::Alarm::none) {
    state.op_mode = imc::VehicleState::OpMode::ERROR;
    state.error_count = 1;
    state.error_ents = supervisor_entity;
    state.last_error = name_of(alarm_);
    plan.state = imc::PlanControlState::State::BLOCKED;
  }
  system.receive(messages::refer_to(state));
  system.receive(messages::refer_to(plan));
}

void LauvOperator::announce(Duration instant, messages::Receiver& all) {
  if (announced_ && instant - *announced_ < announce_period) return;
  announced_ = instant;
  all.receive(messages::refer_to(make_announce({.name = parameters_.name,
                                                .type = imc::SystemType::UUV,
                                                .latitude = parameters_.latitude,
                                                .longitude = parameters_.longitude,
                                                .address = address_})));
}

// Nobody has to be there as long as nothing was asked for.
tasks::Contact LauvOperator::contact() {
  const bool steered = mode_ == Mode::external || mode_ == Mode::teleoperation;
  return {.silence = steered ? seconds(now_ - heard_) : 0, .stops = stops_};
}

void LauvOperator::send_report(const tasks::VehicleReport& report, messages::Receiver& system) {
  if (alarm_ != report.alarm) mode_changed_ = true;
  alarm_ = report.alarm;
  heading_ = report.heading;
  if (motion_sent_) return;
  tasks::Motion motion;
  motion.z = report.depth;
  motion.theta = report.pitch;
  motion.psi = report.heading;
  motion.u = report.speed;
  send_state(motion, system);
}

void LauvOperator::send_motion(const tasks::Motion& motion, messages::Receiver& system) {
  motion_sent_ = true;
  heading_ = motion.psi;
  send_state(motion, system);
}

void LauvOperator::send_state(const tasks::Motion& motion, messages::Receiver& system) const {
  system.receive(messages::refer_to(estimate_state(motion, parameters_.latitude, parameters_.longitude)));
}

}  // namespace jarol::distributers
