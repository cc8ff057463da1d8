// Whether a program was compiled like the library that it calls: asked for by the first functions that it calls, before
// they touch what it hands over.
#pragma once

#include "graph/build_options.h"

namespace jarol {

/// Throws WrongBuild where it can't use this library.
void require_built_alike(const BuildOptions& program);

}  // namespace jarol
