#include "tools/console/leaf_text.h"

#include "graph/values/bind.h"

namespace jarol::tools::console {

const TypeField* field_of_leaf(const Type& type, std::string_view path) {
  const Type* at = &type;
  const TypeField* found = nullptr;
  while (!path.empty() && at->kind == Kind::structure) {
    const std::size_t dot = path.find('.');
    const TypeField* const field = find_field(*at, path.substr(0, dot));
    if (field == nullptr) break;
    found = field;
    at = field->type;
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return found;
}

}  // namespace jarol::tools::console
