// What descriptions say of the parts of a value.
#pragma once

#include <string>
#include <string_view>

#include "graph/values/type_of.h"

namespace jarol::tools::console {

/// The text of the leaf of that path; elements of arrays have none of their own.
std::string text_of_leaf(const Type& type, std::string_view path);

}  // namespace jarol::tools::console
