// From named coefficients to matrices.
#pragma once

#include "vehicles/submarine/body.h"
#include "vehicles/submarine/parameters.h"

namespace jarol::vehicles {

/// Throws InputError if no body can have these parameters.
SubmarineBody make_body(const SubmarineParameters& parameters);

}  // namespace jarol::vehicles
