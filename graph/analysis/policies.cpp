#include "graph/analysis/policies.h"

#include "graph/analysis/systems.h"
#include "graph/registry.h"

namespace jarol {
namespace policies {

using namespace analysis;

constinit const Policy table{.name = "table",
                             .how = "tasks run one after the other as released, never interrupted",
                             .executed = true,
                             .check = check_on_table};

constinit const Policy fixed_priority{
    .name = "fixed_priority",
    .how = "the most urgent task runs, interrupting others, as under 'run --clock real'",
    .urgency = Urgency::priority,
    .interrupts = true,
    .executed = true,
    .check = check_partitioned};

constinit const Policy edf{.name = "edf",
                           .how = "the task with the earliest deadline runs, interrupting others",
                           .urgency = Urgency::deadline,
                           .interrupts = true,
                           .check = check_partitioned};

constinit const Policy fixed_priority_nonpreemptive{.name = "fixed_priority_nonpreemptive",
                                                    .how = "the most urgent task starts, and runs to its end",
                                                    .urgency = Urgency::priority,
                                                    .check = check_partitioned};

constinit const Policy edf_nonpreemptive{.name = "edf_nonpreemptive",
                                         .how = "the task with the earliest deadline starts, and runs to its end",
                                         .urgency = Urgency::deadline,
                                         .check = check_partitioned};

constinit const Policy global_edf{.name = "global_edf",
                                  .how = "the earliest deadlines run, on any core",
                                  .urgency = Urgency::deadline,
                                  .interrupts = true,
                                  .keeps_core = false,
                                  .check = check_globally};

}  // namespace policies

namespace analysis {

const std::vector<Policy>& built_in_policies() {
  using namespace policies;
  static const std::vector<Policy> all{
      table, fixed_priority, edf, fixed_priority_nonpreemptive, edf_nonpreemptive, global_edf,
  };
  return all;
}

void add_policies(Registry& registry) {
  for (const Policy& policy : built_in_policies()) registry.add(policy);
}

const Policy& policy_of(const Platform& platform) {
  return platform.policy != nullptr ? *platform.policy : policies::table;
}

}  // namespace analysis
}  // namespace jarol
