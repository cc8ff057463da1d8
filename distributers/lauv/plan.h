// A plan of IMC, read and checked before anything of it is flown.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "distributers/lauv/maneuvers.h"
#include "distributers/messages/imc.h"

namespace jarol::distributers {

struct Plan {
  std::string name{};
  std::vector<Maneuver> maneuvers{};
  std::vector<std::optional<std::size_t>> next{};  // of each maneuver, when it is done; none: the plan is
  std::size_t start = 0;
  FlightLimits limits{};  // of what is commanded while it runs
};

/// Throws InputError that says what can't be flown, and in which maneuver.
Plan make_plan(const messages::imc::PlanSpecification& plan, const Origin& origin, const FlightLimits& limits = {});

/// Of one maneuver.
Plan make_plan(std::string name, const messages::InlineMessage& maneuver, const Origin& origin,
               const FlightLimits& limits = {});

}  // namespace jarol::distributers
