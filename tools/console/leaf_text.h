// What descriptions say of the parts of a value.
#pragma once

#include <string_view>

#include "graph/values/type_of.h"

namespace jarol::tools::console {

/// The field whose description is that of the leaf of that path, of which elements of arrays have none of their own;
/// null: there is none.
const TypeField* field_of_leaf(const Type& type, std::string_view path);

}  // namespace jarol::tools::console
