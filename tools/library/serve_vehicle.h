// A simulated vehicle as a process of its own: what `jarol vehicle --link` does in real time, for a program.
//
//   const jarol::ServeOutcome outcome =
//       jarol::serve_vehicle("submarine", "{type: udp, listen: 6002}", {.initial = "z=4"}, {.end = 30s});
//   CHECK(outcome.link.heard > 0);
#pragma once

#include <string>

#include "distributers/serve/made_vehicle.h"
#include "distributers/serve/serve_vehicle.h"
#include "tools/library/built_in.h"

namespace jarol {

/// A vehicle that is built in, at a link as a graph writes it. Throws SpecError with all that is wrong with the
/// parameters and the link; InputError where there is no such vehicle, or none can be made of these
/// parameters; WrongBuild; and as the function that takes vehicle and link.
ServeOutcome serve_vehicle(const std::string& name, std::string link, const VehicleOptions& made = {},
                           const ServeOptions& options = {}, const BuildOptions& program = options_of_this_file());

}  // namespace jarol
