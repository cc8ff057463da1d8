// What a plugin brings, on its way to where it is kept.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graph/registry.h"

namespace jarol {

/// Of what a layer above the graph keeps: a kind of vehicle, a type of link.
struct Extension {
  std::string kind;  // "vehicle", "link type"
  std::string name;
  std::shared_ptr<const void> what;  // of the class that the kind has
};

struct PluginParts {
  Registry graph{};  // task types, distributers, policies and grammars
  std::vector<Extension> extensions{};
};

}  // namespace jarol
