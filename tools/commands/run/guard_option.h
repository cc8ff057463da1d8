// Tasks that can write to nothing but their own memory and their stack: run --guard.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/dispatch/task_guard.h"
#include "runtime/external_system.h"

namespace jarol::tools {

class Command;

void add_guard_option(Command& command, bool& guard);
/// What does not go with it.
void require_guard_effect(const Command& command, bool guard, bool virtual_clock);

/// Begins the program again, the same but that each function of a library is looked up before it is needed: that writes
/// to memory of no task. Returns where this is so.
void look_up_at_once();

/// Null: it was not asked for. By the main thread; the systems are those of the graph. Throws InputError.
std::unique_ptr<TaskGuard> make_guard(bool wanted, const Graph& graph, const std::vector<ExternalSystem*>& systems);

}  // namespace jarol::tools
