// The operator's plans and maneuvers.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "distributers/lauv/messages.h"
#include "distributers/lauv/operator.h"
#include "distributers/messages/payload.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr std::string_view no_place = "GPS has given no fix yet: nobody knows where the vehicle is";
constexpr std::string_view no_altimeter = "the vehicle has no altimeter: no altitude can be kept";
constexpr std::string_view run_ends = "the run is ending: the vehicle is brought to rest";

std::uint16_t system_of(const messages::MessageRef& from) {
  return from.header == nullptr ? 0xffff : static_cast<const imc::Header*>(from.header)->src;
}

bool is_maneuver(std::uint32_t id) {
  return id != imc::PlanSpecification::message_id && id != messages::InlineMessage::none;
}

}  // namespace

// A request that the network has duplicated is obeyed once, whatever has become of it since.
bool LauvOperator::answer_again(const std::optional<RequestId>& request, const From& to) {
  const messages::Message* const before = answered_.find(request);
  if (before == nullptr) return false;
  answers_.push_back({*before, {.src_ent = plan_entity}});
  address_last(to);
  return true;
}

void LauvOperator::plan_control(const imc::PlanControl& plan, const From& from) {
  using Op = imc::PlanControl::Op;
  if (plan.type != imc::PlanControl::Type::REQUEST) return;
  const std::optional<RequestId> id = id_of(plan, plan.op, from);
  if (answer_again(id, from)) return;
  imc::PlanControl reply;
  reply.op = plan.op;
  reply.request_id = plan.request_id;
  reply.plan_id = plan.plan_id;
  switch (plan.op) {
    case Op::START: reply.info = start_plan(plan, system_of(from)); break;
    case Op::STOP: demand_stop(); break;
    case Op::LOAD: reply.info = load_plan(plan, system_of(from)); break;
    case Op::GET:
      if (!loaded_)
        reply.info = "no plan is loaded";
      else if (!messages::put_inline(messages::refer_to(*loaded_), reply.arg))
        reply.info = "the plan has no room in an answer";
      break;
    default: reply.info = fmt::format("operation {} is none of START, STOP, LOAD, GET", plan.op);
  }
  reply.type = reply.info.empty() ? imc::PlanControl::Type::SUCCESS : imc::PlanControl::Type::FAILURE;
  if (!reply.info.empty()) refuse(fmt::format("plan '{}': {}", plan.plan_id.view(), reply.info.view()));
  answer(reply, plan_entity, from);
  answered_.note(id, answers_.back().message);
}

std::string LauvOperator::find_unflyable(const imc::PlanSpecification& plan, const Origin& origin) const {
  try {
    const Plan made = make_plan(plan, origin, parameters_.limits);
    for (const Maneuver& each : made.maneuvers)
      if (!has_altimeter() && needs_altitude(each)) return fmt::format("maneuver '{}': {}", each.name, no_altimeter);
  } catch (const InputError& error) { return error.what(); }
  return "";
}

// A plan in the request is stored and loaded; without one it is the stored plan of that name.
std::string LauvOperator::load_plan(const imc::PlanControl& request, std::uint16_t who) {
  if (request.arg.empty()) {
    const imc::PlanSpecification* const stored = plans_.find(request.plan_id.view());
    if (stored == nullptr) return fmt::format("no plan '{}' is stored here", request.plan_id.view());
    if (std::string why_not = find_unflyable(*stored, origin_); !why_not.empty()) return why_not;
    loaded_ = *stored;
    loaded_->plan_id = request.plan_id;
    return "";
  }
  messages::Message opened;
  std::string why;
  if (!messages::take_inline(imc::message_set(), request.arg, opened, &why)) return "the plan can't be read: " + why;
  const auto* plan = opened.as<imc::PlanSpecification>();
  if (plan == nullptr) return fmt::format("{} is no plan", opened.descriptor()->name);
  if (std::string why_not = find_unflyable(*plan, origin_); !why_not.empty()) return why_not;
  const auto name = request.plan_id.empty() ? plan->plan_id.view() : request.plan_id.view();
  if (std::string why_not = plans_.set(name, *plan, who, unix_time()); !why_not.empty()) return why_not;
  loaded_ = *plan;
  loaded_->plan_id = name;
  return "";
}

std::string LauvOperator::start_plan(const imc::PlanControl& request, std::uint16_t who) {
  try {
    if (is_maneuver(request.arg.id))
      return execute(make_plan(std::string(request.plan_id.view()), request.arg, origin_, parameters_.limits));
    // as it is stored now; one that is no more is there as it was loaded, and without a name the loaded one is meant
    const bool is_loaded = request.arg.empty() && loaded_ && plans_.find(request.plan_id.view()) == nullptr &&
                           (request.plan_id.empty() || loaded_->plan_id == request.plan_id);
    if (!is_loaded)
      if (std::string why_not = load_plan(request, who); !why_not.empty()) return why_not;
    return execute(make_plan(*loaded_, origin_, parameters_.limits));
  } catch (const InputError& error) { return error.what(); }
}

// In place of whatever goes on.
std::string LauvOperator::execute(Plan plan) {
  if (ending_) return std::string(run_ends);
  if (mode_ == Mode::error) return "just aborted";
  if (alarm_ != tasks::Alarm::none) return fmt::format("the vehicle comes up: {}", name_of(alarm_));
  if (placeless_ && needs_place(plan.maneuvers[plan.start])) return std::string(no_place);
  if (!has_altimeter() && std::any_of(plan.maneuvers.begin(), plan.maneuvers.end(),
                                      [](const Maneuver& each) { return needs_altitude(each); }))
    return std::string(no_altimeter);
  plan_.stop("");
  plan_.start(std::move(plan), motion_, now_);
  log(imc::LogBookEntry::Type::INFO, fmt::format("plan '{}' begins", plan_.name()));
  follow_plan();
  return "";
}

// What the plan wants now: its leg, a hand that steers, or nothing any more.
void LauvOperator::follow_plan() {
  using Type = imc::LogBookEntry::Type;
  mode_changed_ = true;
  in.leg = plan_.leg();
  if (!plan_.runs()) {
    const bool good = plan_.outcome() == PlanRun::Outcome::success;
    log(good ? Type::INFO : Type::ERROR,
        fmt::format("plan '{}' {}", plan_.name(), good ? "is done" : "has failed: " + plan_.why()));
    if (!good) {
      last_error_ = plan_.why();
      last_error_at_ = unix_time();
    }
    return stop();
  }
  if (placeless_ && needs_place(plan_.maneuver())) {
    end_plan(std::string(no_place));
    return stop();
  }
  if (plan_.maneuver_start() == now_) maneuver_start_ = unix_time();
  if (plan_.maneuver().type == imc::Teleoperation::message_id) {
    if (mode_ != Mode::teleoperation) start_teleoperation();
    return;
  }
  if (mode_ == Mode::teleoperation) answer(imc::TeleoperationDone{}, plan_entity);
  in.setpoint = {0, heading_, 0};
  set_mode(Mode::plan);
}

// Another command has won.
void LauvOperator::end_plan(const std::string& why) {
  if (!plan_.runs()) return;
  plan_.stop(why);
  in.leg = plan_.leg();
  mode_changed_ = true;
  log(imc::LogBookEntry::Type::WARNING, fmt::format("plan '{}' ends: {}", plan_.name(), why));
}

// The graph commands the vehicle from now on, until the operator stops it.
void LauvOperator::ending() {
  ending_ = true;
  if (!plan_.runs()) return;
  last_error_ = run_ends;
  last_error_at_ = unix_time();
  end_plan(last_error_);
  stop();
}

void LauvOperator::note_progress(const tasks::Progress& progress, messages::Receiver&) {
  if (plan_.note(progress, motion_, now_)) follow_plan();
}

void LauvOperator::reference(const imc::Reference& reference, const From& from) {
  const auto* header = static_cast<const imc::Header*>(from.header);
  const std::uint16_t source = header == nullptr ? 0xffff : header->src;
  const std::uint8_t entity = header == nullptr ? 0xff : header->src_ent;
  const ReferenceFollower* const follower = plan_.follower();
  try {
    if (follower != nullptr && follower->obeys(source, entity) && !has_altimeter() && needs_altitude(reference))
      throw InputError(std::string(no_altimeter));
    if (plan_.follow(reference, source, entity, now_, origin_, motion_)) follow_plan();
  } catch (const InputError& error) { refuse(std::string("a reference is left out: ") + error.what()); }
}

void LauvOperator::teleoperation_done(const imc::TeleoperationDone&) {
  if (mode_ == Mode::teleoperation) finish_teleoperation();
}

// A plan goes on with its next maneuver.
void LauvOperator::finish_teleoperation() {
  if (plan_.finish_maneuver(motion_, now_)) return follow_plan();
  stop();
}

void LauvOperator::plan_db(const imc::PlanDB& request, const From& from) {
  using Op = imc::PlanDB::Op;
  if (request.type != imc::PlanDB::Type::REQUEST) return;
  const bool changes = request.op == Op::SET || request.op == Op::DEL || request.op == Op::CLEAR;
  const std::optional<RequestId> id = changes ? id_of(request, request.op, from) : std::nullopt;
  if (answer_again(id, from)) return;
  // it may be for where the vehicle will be
  const Origin anywhere{origin_.latitude, origin_.longitude, std::numeric_limits<double>::infinity()};
  const auto check = [&](const imc::PlanSpecification& plan) { return find_unflyable(plan, anywhere); };
  const imc::PlanDB reply = plans_.answer(request, system_of(from), unix_time(), check);
  if (request.op == Op::SET && reply.type == imc::PlanDB::Type::FAILURE)
    refuse(fmt::format("plan '{}' is not stored: {}", request.plan_id.view(), reply.info.view()));
  answer(reply, plan_entity, from);
  answered_.note(id, answers_.back().message);
}

void LauvOperator::vehicle_command(const imc::VehicleCommand& command, const From& from) {
  if (command.type != imc::VehicleCommand::Type::REQUEST) return;
  const std::optional<RequestId> id = id_of(command, command.command, from);
  if (answer_again(id, from)) return;
  imc::VehicleCommand reply;
  reply.request_id = command.request_id;
  reply.command = command.command;
  if (command.command == imc::VehicleCommand::Command::EXEC_MANEUVER) {
    try {
      reply.info = execute(make_plan("", command.maneuver, origin_, parameters_.limits));
    } catch (const InputError& error) { reply.info = error.what(); }
  } else if (command.command == imc::VehicleCommand::Command::STOP_MANEUVER) {
    demand_stop();
  } else {
    reply.info = "there is nothing to calibrate";
  }
  reply.type = reply.info == "" ? imc::VehicleCommand::Type::SUCCESS : imc::VehicleCommand::Type::FAILURE;
  answer(reply, plan_entity, from);
  answered_.note(id, answers_.back().message);
}

}  // namespace jarol::distributers
