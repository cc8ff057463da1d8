// Tasks run one after the other on the thread that calls, as fast as possible.
#pragma once

#include <memory>

#include "runtime/dispatch/dispatcher.h"
#include "runtime/run/run.h"

namespace jarol {

/// The run outlives it.
std::unique_ptr<Dispatcher> make_in_line(Run& run);

}  // namespace jarol
