// The catalogue room by room, so that a changed task has only its own room compiled again.
#pragma once

#include "graph/registry.h"

namespace jarol::tasks {

// trusted: tests/tools/machine_code_test.cpp looks at their code
template <class... T>
void add(Registry& registry) {
  (registry.add(trusted_task_class<T>()), ...);
}

void add_javiator_tasks(Registry& registry);
void add_original_tasks(Registry& registry);
void add_lauv_tasks(Registry& registry);

}  // namespace jarol::tasks
