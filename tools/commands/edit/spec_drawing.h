// A drawing of what the text of a graph says, also where that is not right yet.
#pragma once

#include "graph/language/spec.h"
#include "graph/registry.h"
#include "tools/drawing/graph/layout.h"

namespace jarol::tools::edit {

/// Of a graph that is right the same as `lay_out` of the graph, but that distributers are drawn which nothing uses. An
/// arrow has the places of its connections in the text; those to what is not there are left out.
Drawing lay_out(const GraphSpec& spec, const Registry& known);

/// Is it an `in`? By its channel, its direction, or else by who is connected to it.
bool is_in(const CommunicatorSpec& communicator, const GraphSpec& spec, const Registry& known);

}  // namespace jarol::tools::edit
