// What graphs and commands may name where plugins bring more.
#pragma once

#include <string>
#include <vector>

#include "distributers/messages/message_set.h"
#include "distributers/registries.h"

namespace jarol::tools {

/// What is built in, and what these shared libraries bring. Throws InputError.
distributers::Registries known_with(const std::vector<std::string>& plugins);

/// The message sets of the tree, and those that known distributers and vehicles speak; of a name the first.
std::vector<const messages::MessageSet*> sets_of(const distributers::Registries& known);

}  // namespace jarol::tools
