// The commands that tools/demo does not build.
#pragma once

#include <array>

namespace jarol::tools {

inline constexpr std::array later_commands{"bench", "campaign", "console", "doctor", "edit",   "graph",  "isolation",
                                           "log",   "messages", "new",     "replay", "schema", "vehicle"};

}  // namespace jarol::tools
