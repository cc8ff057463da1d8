// What a program knows that has all policies, tasks, distributers and links that are built in, and tasks of its own.
#pragma once

#include "distributers/distributers.h"
#include "graph/analysis/policies.h"
#include "tasks/tasks.h"

namespace jarol::tests {

template <class... Own>
const distributers::Registries& all_parts_with() {
  static const distributers::Registries all = [] {
    distributers::Registries made;
    analysis::add_policies(made.graph);
    tasks::add_tasks(made.graph);
    distributers::add_distributers(made.graph);
    distributers::add_links(made.links);
    (made.graph.add(task_class<Own>()), ...);
    return made;
  }();
  return all;
}

}  // namespace jarol::tests
