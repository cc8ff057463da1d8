// From the helicopter's parameters to its body and its start.
#pragma once

#include "vehicles/helicopter/body.h"
#include "vehicles/helicopter/parameters.h"

namespace jarol::vehicles {

/// Throws InputError if no body can have these parameters.
HelicopterBody make_body(const HelicopterParameters& parameters);

/// Level at rest; standing, it has sunk in as far as its feet carry it.
HelicopterMotion make_start(const HelicopterParameters& parameters);

}  // namespace jarol::vehicles
