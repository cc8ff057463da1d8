// --no-plugins, of every command that loads graphs.
#pragma once

#include "graph/language/load.h"

namespace jarol::tools {

class Command;

void add_no_plugins(Command& command, Overrides& overrides);

}  // namespace jarol::tools
