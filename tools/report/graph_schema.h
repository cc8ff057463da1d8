// The JSON Schema of the graph language, for editors, made from the tables that the loader reads by.
#pragma once

#include <string>

namespace jarol::tools {

/// Draft-07, with a line end.
std::string graph_schema();

}  // namespace jarol::tools
