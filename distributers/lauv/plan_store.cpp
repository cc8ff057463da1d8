#include "distributers/lauv/plan_store.h"

#include <fmt/format.h>

#include "distributers/messages/payload.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

constexpr std::size_t max_plans = 1000;

std::string lacks(std::string_view name) { return fmt::format("no plan '{}' is stored here", name); }

}  // namespace

imc::PlanDB PlanStore::answer(const imc::PlanDB& request, std::uint16_t system, double time, const Check& check) {
  imc::PlanDB reply;
  reply.op = request.op;
  reply.request_id = request.request_id;
  reply.plan_id = request.plan_id;
  const std::string why_not = carry_out(request, system, time, check, reply.arg);
  reply.type = why_not.empty() ? imc::PlanDB::Type::SUCCESS : imc::PlanDB::Type::FAILURE;
  reply.info = why_not;
  return reply;
}

std::string PlanStore::set(std::string_view name, const imc::PlanSpecification& plan, std::uint16_t system,
                           double time) {
  if (name.empty()) return "the plan has no name";
  if (plans_.size() == max_plans && plans_.find(name) == plans_.end())
    return fmt::format("{} plans are stored; no more are kept", max_plans);
  messages::InlineMessage written;
  std::string why;
  if (!messages::put_inline(messages::refer_to(plan), written, &why)) return "the plan can't be stored: " + why;
  Stored& stored = plans_[std::string(name)];
  stored.plan = plan;
  stored.information.plan_id = name;
  stored.information.plan_size = static_cast<std::uint16_t>(written.payload.size());
  stored.information.change_time = changed_at_ = time;
  stored.information.change_sid = changed_by_ = system;
  return "";
}

const imc::PlanSpecification* PlanStore::find(std::string_view name) const {
  const auto found = plans_.find(name);
  return found == plans_.end() ? nullptr : &found->second.plan;
}

// Why not, or nothing.
std::string PlanStore::carry_out(const imc::PlanDB& request, std::uint16_t system, double time, const Check& check,
                                 messages::InlineMessage& result) {
  using Op = imc::PlanDB::Op;
  const auto put = [&result](const auto& message) {
    std::string why;
    return messages::put_inline(messages::refer_to(message), result, &why) ? "" : "it has no room: " + why;
  };
  const std::string_view name = request.plan_id.view();
  const auto found = plans_.find(name);
  switch (request.op) {
    case Op::SET: {
      messages::Message plan;
      std::string why;
      if (!messages::take_inline(imc::message_set(), request.arg, plan, &why)) return "the plan can't be read: " + why;
      const auto* specification = plan.as<imc::PlanSpecification>();
      if (specification == nullptr) return "there is no PlanSpecification in it";
      if (const std::string why_not = check(*specification); !why_not.empty())
        return found == plans_.end() ? why_not : why_not + "; the plan of that name that is stored stays";
      return set(name, *specification, system, time);
    }
    case Op::DEL:
      if (found == plans_.end()) return lacks(name);
      plans_.erase(found);
      break;
    case Op::GET: return found == plans_.end() ? lacks(name) : put(found->second.plan);
    case Op::GET_INFO: return found == plans_.end() ? lacks(name) : put(found->second.information);
    case Op::CLEAR: plans_.clear(); break;
    case Op::GET_STATE: return put(state(false));
    case Op::GET_DSTATE: return put(state(true));
    default:
      return fmt::format("operation {} is none of SET, DEL, GET, GET_INFO, CLEAR, GET_STATE, GET_DSTATE", request.op);
  }
  changed_at_ = time;
  changed_by_ = system;
  return "";
}

imc::PlanDBState PlanStore::state(bool detailed) const {
  imc::PlanDBState state;
  state.plan_count = static_cast<std::uint16_t>(plans_.size());
  state.change_time = changed_at_;
  state.change_sid = changed_by_;
  for (const auto& [name, stored] : plans_) {
    state.plan_size += stored.information.plan_size;
    messages::InlineMessage information;
    if (detailed && messages::put_inline(messages::refer_to(stored.information), information))
      state.plans_info.push_back(information);
  }
  return state;
}

}  // namespace jarol::distributers
