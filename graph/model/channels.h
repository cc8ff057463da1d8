// Communicators and the channels of distributers that they stand for.
#pragma once

#include <string>

#include "graph/language/problems.h"
#include "graph/language/spec.h"
#include "graph/model/graph.h"

namespace jarol {

/// The channel that `spec` names, with its type and direction; `subject` names the communicator in problems.
void resolve_channel(const CommunicatorSpec& spec, const std::string& subject, const Graph& graph,
                     Communicator& communicator, Problems& problems);

/// What two communicators handed to one channel at one instant would depend on their order alone; and of two that take
/// from one, only the first would see what is new.
void check_channels(const Graph& graph, Problems& problems);

}  // namespace jarol
