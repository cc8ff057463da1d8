// JSON Schema of the tables of keys.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "graph/language/key.h"

namespace jarol::tools {

extern const std::string name_pattern;

/// Of the value of a key.
nlohmann::ordered_json key_schema(const KeyDescription& key);

/// Of a mapping that holds these keys and no others.
nlohmann::ordered_json mapping_schema(const std::vector<KeyDescription>& keys);

template <class S>
nlohmann::ordered_json mapping_schema(const std::vector<Key<S>>& keys) {
  return mapping_schema(std::vector<KeyDescription>(keys.begin(), keys.end()));
}

}  // namespace jarol::tools
