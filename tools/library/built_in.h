// All that is built in: every task, distributer, link type and vehicle of this tree.
#pragma once

#include "distributers/registries.h"

namespace jarol {

/// No vehicles where it was built without Simbody.
const distributers::Registries& built_in();

}  // namespace jarol
