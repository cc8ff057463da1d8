// Vehicles, link types, policies and timing grammars, as `jarol tasks` shows them beside task types and distributers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "distributers/registries.h"

namespace jarol::tools {

/// What the list has under one title: names, each with what it is.
struct ListedParts {
  std::string title;
  std::vector<std::pair<std::string, std::string>> parts;
};

std::vector<ListedParts> other_parts(const distributers::Registries& known);

/// "vehicles", "links", "policies" and "grammars" of the JSON.
void add_other_parts(const distributers::Registries& known, nlohmann::ordered_json& to);

/// All about the one of that name; false: there is none.
bool print_other_part(const distributers::Registries& known, const std::string& name);
bool add_other_part(const distributers::Registries& known, const std::string& name, nlohmann::ordered_json& to);

}  // namespace jarol::tools
