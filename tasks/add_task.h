// For the end of a task's own file: `template void add_task<DepthControl>(Registry&);` is what adds it.
#pragma once

#include "graph/task.h"
#include "tasks/add_tasks.h"

namespace jarol::tasks {

// trusted: tests/tools/machine_code_test.cpp looks at their code
template <class T>
void add_task(Registry& registry) {
  add_class(registry, trusted_task_class<T>());
}

}  // namespace jarol::tasks
