// The catalogue of tasks.
#pragma once

#include "graph/registry.h"

namespace jarol::tasks {

/// Adds every task of this folder.
void add_tasks(Registry& registry);

}  // namespace jarol::tasks
