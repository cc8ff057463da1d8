#include "tools/commands/run/known_with.h"

#include <algorithm>

#include "graph/plugins/plugins.h"
#include "graph/text/errors.h"
#include "tools/library/built_in.h"

namespace jarol::tools {

distributers::Registries known_with(const std::vector<std::string>& plugins) {
  PluginParts parts{built_in().graph, {}};
  for (const std::string& plugin : plugins) {
    const std::string wrong =
        load_plugin(plugin, parts, [](const Extension& extension) { return distributers::has(built_in(), extension); });
    if (!wrong.empty()) throw InputError(wrong);
  }
  return distributers::with_plugins(built_in(), std::move(parts));
}

std::vector<const messages::MessageSet*> sets_of(const distributers::Registries& known) {
  const auto of_tree = messages::message_sets();
  std::vector<const messages::MessageSet*> sets(of_tree.begin(), of_tree.end());
  const auto add = [&](const messages::MessageSet& set) {
    if (std::none_of(sets.begin(), sets.end(), [&](const auto* other) { return other->name == set.name; }))
      sets.push_back(&set);
  };
  for (const DistributerClass& distributer : known.graph.distributers())
    if (distributer.message_set != nullptr) add(distributer.message_set());
  for (const vehicles::VehicleClass& vehicle : known.vehicles.entries())
    if (vehicle.message_set != nullptr) add(*vehicle.message_set);
  return sets;
}

}  // namespace jarol::tools
