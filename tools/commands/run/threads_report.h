// What a run on threads reports of its rounds.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/jarol/jarol_core.h"

namespace jarol::tools {

std::string to_text(const Graph& graph, const JarolCore& core);
nlohmann::ordered_json to_json(const Graph& graph, const JarolCore& core);

}  // namespace jarol::tools
