#include "tools/console/leaf_text.h"

#include "graph/values/bind.h"

namespace jarol::tools::console {

std::string text_of_leaf(const Type& type, std::string_view path) {
  const Type* at = &type;
  std::string text;
  while (!path.empty()) {
    const std::size_t dot = path.find('.');
    if (at->kind != Kind::structure) return text;
    const TypeField* const field = find_field(*at, path.substr(0, dot));
    if (field == nullptr) return text;
    text = field->text;
    at = field->type;
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return text;
}

}  // namespace jarol::tools::console
