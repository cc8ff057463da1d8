// The JSON Schema of graphs, from the tables that the loader reads and the registries, so that editors complete and
// check a graph while it is written.
#pragma once

#include <string>

#include "distributers/registries.h"

namespace jarol::tools {

/// Of graphs that name what these registries have; a graph with plugins may name other task types, too.
std::string graph_schema(const distributers::Registries& known);

}  // namespace jarol::tools
