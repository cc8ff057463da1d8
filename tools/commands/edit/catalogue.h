// What a graph can be made of, for the forms of the editor: types, their fields, and the keys of the language.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "distributers/registries.h"

namespace jarol::tools::edit {

nlohmann::ordered_json catalogue_of(const distributers::Registries& known);

}  // namespace jarol::tools::edit
