// What is reported to the operator, asked or not.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "distributers/lauv/messages.h"
#include "distributers/lauv/operator.h"
#include "distributers/messages/imc_entity.h"
#include "distributers/messages/payload.h"
#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace {

using tasks::Drive;
using tasks::Turn;

constexpr std::string_view actions_known =
    "Exit=Button;Accelerate=Button;Decelerate=Button;Stop=Button;Heading=Axis;Thrust=Axis;Ranges=Range127";
constexpr Duration altitude_patience = std::chrono::milliseconds(2500);  // as the supervisor's
constexpr std::size_t max_kept = 100, longest_line = 500;                // of the log book: all fit into one answer

}  // namespace

void LauvOperator::address_last(const From& to) {
  if (to.header == nullptr) return;
  answers_.back().header.dst = static_cast<const imc::Header*>(to.header)->src;
  answers_.back().header.dst_ent = static_cast<const imc::Header*>(to.header)->src_ent;
}

void LauvOperator::log(std::uint8_t type, const std::string& text) {
  imc::LogBookEntry entry;
  entry.type = type;
  entry.htime = unix_time();
  entry.context = "operator";
  entry.text = std::string_view(text).substr(0, longest_line);
  answer(entry, operator_entity);
  if (log_book_.size() == max_kept) log_book_.erase(log_book_.begin());
  log_book_.push_back(entry);
}

void LauvOperator::log_book_control(const imc::LogBookControl& control, const From& from) {
  using Command = imc::LogBookControl::Command;
  if (control.command == Command::CLEAR) return log_book_.clear();
  if (control.command == Command::REPLY) return;
  imc::LogBookControl reply;
  reply.command = Command::REPLY;
  reply.htime = unix_time();
  for (const imc::LogBookEntry& entry : log_book_) {
    const bool wanted = control.command == Command::GET || entry.type == imc::LogBookEntry::Type::ERROR ||
                        entry.type == imc::LogBookEntry::Type::CRITICAL;
    messages::InlineMessage line;
    if (wanted && entry.htime >= control.htime && messages::put_inline(messages::refer_to(entry), line))
      reply.msg.push_back(line);
  }
  answer(reply, daemon_entity, from);
}

void LauvOperator::actions_request(const imc::RemoteActionsRequest& request, const From& from) {
  if (request.op != imc::RemoteActionsRequest::Op::QUERY) return;
  answer(imc::RemoteActionsRequest{imc::RemoteActionsRequest::Op::REPORT, actions_known}, operator_entity, from);
}

void LauvOperator::entity_list(const imc::EntityList& list, const From& from) {
  if (list.op != imc::EntityList::Op::QUERY) return;
  imc::EntityList all{imc::EntityList::Op::REPORT, ""};
  for (std::size_t id = 0; id < entities_known.size(); ++id) {
    if (id > 0) all.list += ";";
    all.list += std::string(entities_known[id]) + "=" + std::to_string(id);
  }
  answer(all, daemon_entity, from);
}

void LauvOperator::query_entity_state(const imc::QueryEntityState&, const From& from) {
  for (std::uint8_t id = 0; id < entities_known.size(); ++id) answer(state_of(id), id, from);
}

void LauvOperator::query_entity_info(const imc::QueryEntityInfo& query, const From& from) {
  if (query.id >= entities_known.size()) return;  // as DUNE: an entity that is not there says nothing
  imc::EntityInfo info;
  info.id = query.id;
  info.label = entities_known[query.id];
  info.component = "jarol";
  answer(info, query.id, from);
}

imc::EntityState LauvOperator::state_of(std::uint8_t entity) const {
  using State = imc::EntityState::State;
  imc::EntityState state;
  state.state = State::NORMAL;
  state.description = "active";
  if (entity == supervisor_entity && alarm_ != tasks::Alarm::none) {
    state.state = State::FAILURE;
    state.description = name_of(alarm_);
  } else if (entity == supervisor_entity && fins_ != tasks::FinCheck::checked) {
    state.state = State::FAULT;
    state.description = meaning_of(fins_);
  } else if (entity == operator_entity && mode_ == Mode::error) {
    state.state = State::ERROR;
    state.description = "abort";
  } else if (entity == navigation_entity && placeless_) {
    state.state = State::BOOT;
    state.description = "no fix of GPS yet: its place is not known";
  }
  return state;
}

void LauvOperator::send_vehicle_state(messages::Receiver& system) const {
  using Loops = imc::CLoopsMask;
  imc::VehicleState state;
  state.maneuver_type = state.maneuver_eta = 0xffff;
  state.last_error = last_error_;
  state.last_error_time = last_error_at_;
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
      state.maneuver_type = imc::Teleoperation::message_id;
      state.control_loops = loops | static_cast<std::uint32_t>(Loops::TELEOPERATION);
      break;
    case Mode::plan:
      state.op_mode = imc::VehicleState::OpMode::MANEUVER;
      state.maneuver_type = static_cast<std::uint16_t>(plan_.maneuver().type);
      state.control_loops = loops | static_cast<std::uint32_t>(Loops::PATH);
      if (plan_.maneuver_left() >= 0)
        state.maneuver_eta = static_cast<std::uint16_t>(std::min(plan_.maneuver_left(), 65534.0));
      break;
    case Mode::error:
      state.op_mode = imc::VehicleState::OpMode::ERROR;
      state.error_count = 1;
      state.error_ents = entities_known[operator_entity];
      break;
  }
  if (state.maneuver_type != 0xffff) state.maneuver_stime = maneuver_start_;
  // whatever the operator commands but a stop, it comes up: no loop follows a command, no maneuver is flown
  if (alarm_ != tasks::Alarm::none) {
    state.control_loops = 0;
    state.maneuver_type = state.maneuver_eta = 0xffff;
    state.maneuver_stime = 0;
    state.op_mode = imc::VehicleState::OpMode::ERROR;
    state.error_count = 1;
    state.error_ents = entities_known[supervisor_entity];
    state.last_error = name_of(alarm_);
  }
  send_from(supervisor_entity, state, system);
}

void LauvOperator::send_plan_state(messages::Receiver& system) const {
  using State = imc::PlanControlState::State;
  imc::PlanControlState state;
  state.man_type = 0xffff;
  state.plan_eta = state.man_eta = -1;
  state.plan_progress = -1;
  const bool blocked = mode_ == Mode::error || alarm_ != tasks::Alarm::none;
  state.state = blocked ? State::BLOCKED : State::READY;
  state.plan_id = plan_.name();
  switch (plan_.outcome()) {
    case PlanRun::Outcome::none: break;
    case PlanRun::Outcome::success: state.last_outcome = imc::PlanControlState::LastOutcome::SUCCESS; break;
    case PlanRun::Outcome::failure: state.last_outcome = imc::PlanControlState::LastOutcome::FAILURE; break;
  }
  if (plan_.runs() && !blocked) {
    state.state = State::EXECUTING;
    state.plan_eta = static_cast<std::int32_t>(std::min(plan_.time_left(), 2e9));
    state.plan_progress = static_cast<float>(100 * plan_.share_done());
    state.man_id = plan_.maneuver().name;
    state.man_type = static_cast<std::uint16_t>(plan_.maneuver().type);
    state.man_eta = static_cast<std::int32_t>(std::min(plan_.maneuver_left(), 2e9));
    if (plan_.follower() != nullptr) send_from(plan_entity, plan_.follower()->state(), system);
  } else if (mode_ == Mode::teleoperation && !blocked) {  // by the stick alone
    state.state = State::EXECUTING;
    state.plan_id = "";
    state.man_type = imc::Teleoperation::message_id;
  }
  send_from(plan_entity, state, system);
}

void LauvOperator::announce(Duration instant, messages::Receiver& all) {
  if (!announce_timer_.is_due(instant)) return;
  all.receive(messages::refer_to(imc::make_announce({.name = parameters_.name,
                                                     .type = imc::SystemType::UUV,
                                                     .latitude = origin_.latitude,
                                                     .longitude = origin_.longitude,
                                                     .address = address_})));
}

// Nobody has to be there as long as nothing was asked for.
tasks::Contact LauvOperator::contact() {
  const bool steered = mode_ == Mode::external || mode_ == Mode::teleoperation;  // a plan needs nobody
  return {.silence = steered ? seconds(now_ - heard_) : 0, .stops = stops_};
}

void LauvOperator::send_report(const tasks::VehicleReport& report, messages::Receiver& system) {
  if (alarm_ != report.alarm) {
    mode_changed_ = true;
    if (report.alarm != tasks::Alarm::none) {
      last_error_ = name_of(report.alarm);
      last_error_at_ = unix_time();
      log(imc::LogBookEntry::Type::ERROR, "the vehicle comes up: " + last_error_);
    }
  }
  alarm_ = report.alarm;
  if (alarm_ != tasks::Alarm::none && plan_.runs()) {
    end_plan("the vehicle comes up: " + std::string(name_of(alarm_)));
    stop();
  }
  note_fins(report.fins);
  heading_ = report.heading;
  depth_ = report.depth;
  if (motion_sent_) return;
  tasks::Motion motion;
  motion.z = report.depth;
  motion.theta = report.pitch;
  motion.psi = report.heading;
  motion.u = report.speed;
  send_state(motion, system);
}

// Once for each change. One that has failed is believed again once its operator has sent a stop.
void LauvOperator::note_fins(tasks::FinCheck fins) {
  const tasks::FinCheck before = std::exchange(fins_, fins);
  if (before == fins) return;
  if (fins != tasks::FinCheck::checked)
    log(imc::LogBookEntry::Type::WARNING, std::string(meaning_of(fins)));
  else if (before == tasks::FinCheck::unchecked)
    log(imc::LogBookEntry::Type::INFO, "fins are checked again, as their servos report");
  else
    log(imc::LogBookEntry::Type::INFO, "all fins are tried again");
  answer(state_of(supervisor_entity), supervisor_entity);
}

void LauvOperator::send_motion(const tasks::Motion& motion, messages::Receiver& system) {
  motion_sent_ = true;
  motion_ = motion;
  heading_ = motion.psi;
  depth_ = motion.z;
  send_state(motion, system);
}

void LauvOperator::send_stream(const tasks::Stream& stream, messages::Receiver& system) {
  stream_ = stream;
  send_from(navigation_entity, imc::EstimatedStreamVelocity{stream.north, stream.east, 0}, system);
}

void LauvOperator::note_instruments(const tasks::Instruments& instruments, messages::Receiver&) {
  if (instruments.altitude.count != altitude_.count) altitude_at_ = now_;
  altitude_ = instruments.altitude;
  placeless_ = instruments.place.count == 0;
  const bool moved = instruments.latitude != origin_.latitude || instruments.longitude != origin_.longitude;
  if (instruments.place.count > 0 && moved) move_origin({instruments.latitude, instruments.longitude});
}

// Its places are counted from there, and those of a plan that was made before mean others.
void LauvOperator::move_origin(const Origin& to) {
  const auto text = [](const Origin& o) {
    return fmt::format("{:.4f} {:.4f} deg", o.latitude / degree, o.longitude / degree);
  };
  log(imc::LogBookEntry::Type::WARNING,
      fmt::format("places are measured from {}, as the vehicle does, not from {}", text(to), text(origin_)));
  origin_ = to;
  if (!plan_.runs()) return;
  end_plan("the vehicle measures its places from elsewhere now");
  stop();
}

// As it is above the floor, not along the beam.
double LauvOperator::altitude() const {
  if (altitude_.count < 1 || now_ - altitude_at_ > altitude_patience) return -1;
  return vertical_part(altitude_.value, motion_.phi, motion_.theta);
}

void LauvOperator::send_state(const tasks::Motion& motion, messages::Receiver& system) const {
  send_from(navigation_entity, estimate_state(motion, stream_, origin_.latitude, origin_.longitude, altitude()),
            system);
}

}  // namespace jarol::distributers
