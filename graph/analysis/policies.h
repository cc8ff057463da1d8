// The scheduling policies that are built in, and how a policy is made of a struct.
#pragma once

#include <concepts>
#include <vector>

#include "graph/policy.h"

namespace jarol {

class Registry;
struct Platform;

namespace policies {
extern const Policy table, fixed_priority, edf, fixed_priority_nonpreemptive, edf_nonpreemptive, global_edf;
}  // namespace policies

namespace analysis {

/// In the order in which they are listed.
const std::vector<Policy>& built_in_policies();
void add_policies(Registry& registry);

/// The one that the platform states, else a table.
const Policy& policy_of(const Platform& platform);

/// A struct with a static check() of this form is a policy.
template <class P>
concept PolicyForm = requires {
  requires std::convertible_to<decltype(&P::check), decltype(Policy::check)>;
};

/// Of such a struct, whose `name`, `how`, `urgency` and `interrupts` are static constants; `keeps_core` may be one,
/// too.
template <PolicyForm P>
constexpr Policy make_policy() {
  Policy made{.name = P::name, .how = P::how, .urgency = P::urgency, .interrupts = P::interrupts, .check = P::check};
  if constexpr (requires { P::keeps_core; }) made.keeps_core = P::keeps_core;
  return made;
}

}  // namespace analysis
}  // namespace jarol
