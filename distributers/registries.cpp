#include "distributers/registries.h"

#include <utility>

#include "distributers/interfaces/plugin_vehicle.h"
#include "distributers/links/plugin_link.h"

namespace jarol::distributers {

bool has(const Registries& known, const Extension& extension) {
  if (extension.kind == link_extension_kind) return known.links.find(extension.name) != nullptr;
  return extension.kind == vehicles::extension_kind && known.vehicles.find(extension.name) != nullptr;
}

Registries with_plugins(const Registries& known, PluginParts parts) {
  Registries made{std::move(parts.graph), known.links, known.vehicles};
  for (const Extension& extension : parts.extensions) {
    if (extension.kind == vehicles::extension_kind)
      made.vehicles.add(*static_cast<const vehicles::VehicleClass*>(extension.what.get()));
    if (extension.kind == link_extension_kind) made.links.add(*static_cast<const LinkType*>(extension.what.get()));
  }
  return made;
}

}  // namespace jarol::distributers
