// All that is built in: every task, distributer, link type and vehicle of this tree.
#pragma once

#include "distributers/registries.h"
#include "distributers/session/program_build.h"

namespace jarol {

/// No vehicles where it was built without Simbody. Throws WrongBuild where the program was compiled with options that
/// give its values another layout or another arithmetic; the same holds of sessions.
const distributers::Registries& built_in(const BuildOptions& program = options_of_this_file());

}  // namespace jarol
