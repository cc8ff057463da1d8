#include "distributers/registries.h"

#include <utility>

#include "distributers/interfaces/plugin_vehicle.h"

namespace jarol::distributers {

bool has(const Registries& known, const Extension& extension) {
  return extension.kind == vehicles::extension_kind && known.vehicles.find(extension.name) != nullptr;
}

Registries with_plugins(const Registries& known, PluginParts parts) {
  Registries made{std::move(parts.graph), known.links, known.vehicles};
  for (const Extension& extension : parts.extensions)
    if (extension.kind == vehicles::extension_kind)
      made.vehicles.add(*static_cast<const vehicles::VehicleClass*>(extension.what.get()));
  return made;
}

}  // namespace jarol::distributers
