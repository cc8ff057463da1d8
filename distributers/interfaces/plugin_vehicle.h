// Vehicles that a plugin brings: JAROL_PLUGIN(..., Rover) where Rover is a class as vehicle_class.h says, with its
// `name` and `summary`, static constexpr std::string_view, and a static message_set().
#pragma once

#include <concepts>
#include <memory>
#include <string>

#include "distributers/interfaces/vehicle_class.h"
#include "graph/plugins/plugin.h"

namespace jarol {

namespace vehicles {
/// As an extension of a plugin, whose `what` is a VehicleClass.
inline constexpr char extension_kind[] = "vehicle";
}  // namespace vehicles

template <std::derived_from<vehicles::Vehicle> V>
struct PluginPart<V> {
  static void add(PluginParts& parts) {
    vehicles::VehicleClass made =
        vehicles::vehicle_class<V>(std::string(V::name), V::message_set(), std::string(V::summary));
    std::string name = made.name;
    parts.extensions.push_back(
        {vehicles::extension_kind, std::move(name), std::make_shared<const vehicles::VehicleClass>(std::move(made))});
  }
};

}  // namespace jarol
