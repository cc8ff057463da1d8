// JSON Schema of distributers and their links.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "distributers/registries.h"

namespace jarol::tools {

/// Each link type, by its name.
nlohmann::ordered_json link_schemas(const distributers::Registries& known);

/// An entry of `distributers`, with what each type of it may have; links are `#/definitions/link.NAME`.
nlohmann::ordered_json distributer_schema(const distributers::Registries& known);

}  // namespace jarol::tools
