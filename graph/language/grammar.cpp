#include "graph/language/grammar.h"

#include <algorithm>

namespace jarol {

const std::vector<Grammar>& built_in_grammars() {
  static const std::vector<Grammar> all{
      {language_itself, "periods, offsets and logical execution times are stated", {}, nullptr}};
  return all;
}

Yaml* find_child(Yaml& mapping, std::string_view key) {
  const auto found = std::find_if(mapping.children.begin(), mapping.children.end(),
                                  [&](const Yaml& child) { return child.key == key; });
  return found == mapping.children.end() ? nullptr : &*found;
}

void put_child(Yaml& mapping, std::string_view key, std::string_view text, const Yaml& stands_for) {
  Yaml child;
  child.kind = Yaml::Kind::scalar;
  child.text = text;
  child.where = stands_for.where;
  child.key = key;
  child.key_where = stands_for.key_where;
  if (Yaml* const old = find_child(mapping, key); old != nullptr)
    *old = std::move(child);
  else
    mapping.children.push_back(std::move(child));
}

void take_child(Yaml& mapping, std::string_view key) {
  std::erase_if(mapping.children, [&](const Yaml& child) { return child.key == key; });
}

}  // namespace jarol
