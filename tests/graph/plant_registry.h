// The task types there are, and a vehicle's distributer for tests, with one `in` channel.
#pragma once

#include "graph/analysis/policies.h"
#include "graph/registry.h"
#include "tasks/tasks.h"

namespace jarol::tests {

inline const Registry& plant_registry() {
  static const Registry made = [] {
    Registry all;
    analysis::add_policies(all);
    tasks::add_tasks(all);
    all.add(DistributerClass{"Plant", "for tests", {{"sensor", Direction::in, &type_of<double>(), ""}}, true});
    return all;
  }();
  return made;
}

}  // namespace jarol::tests
