#include "distributers/lauv/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "distributers/messages/payload.h"
#include "graph/language/problems.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

constexpr std::size_t max_maneuvers = 1000;
constexpr std::size_t max_plan_legs = 10'000;  // looked through each second, for the time that is left

[[noreturn]] void refuse_plan(const std::string& text) { throw InputError(text); }

// Of a list of inline messages, each an M.
template <class M>
std::vector<M> read_all(const Sequence<messages::InlineMessage>& list, const char* what) {
  std::vector<M> all;
  for (const messages::InlineMessage& each : list) {
    messages::Message message;
    std::string why;
    if (!messages::take_inline(imc::message_set(), each, message, &why))
      refuse_plan(fmt::format("{} {} can't be read: {}", what, all.size() + 1, why));
    const M* m = message.as<M>();
    if (m == nullptr) refuse_plan(fmt::format("{} {} is no {}", what, all.size() + 1, M::descriptor.name));
    all.push_back(*m);
  }
  return all;
}

// Texts between commas, without blanks around them.
std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    std::string_view part = text.substr(0, comma);
    while (part.starts_with(' ')) part.remove_prefix(1);
    while (part.ends_with(' ')) part.remove_suffix(1);
    if (!part.empty()) parts.emplace_back(part);
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

std::vector<std::string> names_of(const std::vector<Maneuver>& maneuvers) {
  std::vector<std::string> names;
  for (const Maneuver& each : maneuvers) names.push_back(each.name);
  return names;
}

std::size_t find(const Plan& plan, std::string_view name, const std::string& whose) {
  const auto found = std::find_if(plan.maneuvers.begin(), plan.maneuvers.end(),
                                  [&](const Maneuver& each) { return each.name == name; });
  if (found == plan.maneuvers.end())
    refuse_plan(fmt::format("{} '{}' is none of its maneuvers: {}", whose, name, list_of(names_of(plan.maneuvers))));
  return static_cast<std::size_t>(found - plan.maneuvers.begin());
}

void connect(Plan& plan, const imc::PlanTransition& transition) {
  for (const std::string& condition : split(transition.conditions))
    if (condition != "ManeuverIsDone")
      refuse_plan(fmt::format("the condition of a transition is ManeuverIsDone, not '{}'", condition));
  std::optional<std::size_t> to;
  if (transition.dest_man == "_error_") refuse_plan("a transition to '_error_' when a maneuver is done");
  if (!(transition.dest_man == "_done_")) to = find(plan, transition.dest_man, "destination of a transition");
  for (const std::string& source : split(transition.source_man))
    if (source == ".")
      std::fill(plan.next.begin(), plan.next.end(), to);
    else
      plan.next[find(plan, source, "source of a transition")] = to;
}

}  // namespace

Plan make_plan(const imc::PlanSpecification& plan, const Origin& origin, const FlightLimits& limits) {
  Plan made{.name = std::string(plan.plan_id.view()), .limits = limits};
  if (plan.maneuvers.empty()) refuse_plan("the plan has no maneuver");
  if (plan.maneuvers.size() > max_maneuvers)
    refuse_plan(fmt::format("the plan has more than {} maneuvers", max_maneuvers));
  std::size_t legs = 0;
  for (const auto& each : read_all<imc::PlanManeuver>(plan.maneuvers, "maneuver")) {
    const std::string name(each.maneuver_id.view());
    if (std::any_of(made.maneuvers.begin(), made.maneuvers.end(), [&](const Maneuver& m) { return m.name == name; }))
      refuse_plan(fmt::format("two maneuvers are named '{}'", name));
    try {
      made.maneuvers.push_back(make_maneuver(each.data, origin, limits));
    } catch (const InputError& error) { refuse_plan(fmt::format("maneuver '{}': {}", name, error.what())); }
    made.maneuvers.back().name = name;
    legs += made.maneuvers.back().legs.size();
    if (legs > max_plan_legs)
      refuse_plan(fmt::format("the plan has more than {} lines, circles and the like", max_plan_legs));
  }
  made.next.resize(made.maneuvers.size());
  made.start = find(made, plan.start_man_id.view(), "the start");
  for (const auto& each : read_all<imc::PlanTransition>(plan.transitions, "transition")) connect(made, each);
  return made;
}

Plan make_plan(std::string name, const messages::InlineMessage& maneuver, const Origin& origin,
               const FlightLimits& limits) {
  Plan made{.name = std::move(name),
            .maneuvers = {make_maneuver(maneuver, origin, limits)},
            .next = {std::nullopt},
            .limits = limits};
  made.maneuvers.front().name = "1";
  return made;
}

}  // namespace jarol::distributers
