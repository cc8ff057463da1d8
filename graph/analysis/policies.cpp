#include "graph/analysis/policies.h"

#include "graph/analysis/systems.h"
#include "graph/language/key.h"

namespace jarol::analysis {

std::string PolicyEntry::name() const { return Words<Policy>::list()[static_cast<std::size_t>(policy)]; }

const std::vector<PolicyEntry>& policies() {
  static const std::vector<PolicyEntry> all{
      {.policy = Policy::table,
       .how = "tasks run one after the other as released, never interrupted",
       .executed = true,
       .check = check_on_table},
      {.policy = Policy::fixed_priority,
       .how = "the most urgent task runs, interrupting others, as under 'run --clock real'",
       .urgency = Urgency::priority,
       .interrupts = true,
       .executed = true,
       .check = check_partitioned},
      {.policy = Policy::edf,
       .how = "the task with the earliest deadline runs, interrupting others",
       .urgency = Urgency::deadline,
       .interrupts = true,
       .check = check_partitioned},
      {.policy = Policy::fixed_priority_nonpreemptive,
       .how = "the most urgent task starts, and runs to its end",
       .urgency = Urgency::priority,
       .check = check_partitioned},
      {.policy = Policy::edf_nonpreemptive,
       .how = "the task with the earliest deadline starts, and runs to its end",
       .urgency = Urgency::deadline,
       .check = check_partitioned},
      {.policy = Policy::global_edf,
       .how = "the earliest deadlines run, on any core",
       .urgency = Urgency::deadline,
       .interrupts = true,
       .keeps_core = false,
       .check = check_globally},
  };
  return all;
}

const PolicyEntry& entry_of(Policy policy) { return policies()[static_cast<std::size_t>(policy)]; }

}  // namespace jarol::analysis
