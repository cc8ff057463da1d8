#include "tools/console/flow.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "distributers/interfaces/vehicle_file.h"
#include "graph/values/bind.h"

namespace jarol::tools::console {
namespace {

using Files = std::vector<std::shared_ptr<const Source>>;

// Links name files relative to the graph's.
std::shared_ptr<const Source> find_file(const Files& files, const std::string& name) {
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) {
    return file->name == name || file->name.ends_with("/" + name);
  });
  return found == files.end() ? nullptr : *found;
}

std::optional<double> number_at(const Type& type, const Value& value, const std::string& path) {
  for (const Leaf& leaf : leaves_of(type)) {
    if (leaf.path != path || leaf.type != &type_of<double>()) continue;
    double number = 0;
    std::memcpy(&number, static_cast<const std::byte*>(value.data()) + leaf.offset, sizeof number);
    return number;
  }
  return std::nullopt;
}

std::optional<distributers::VehicleFile> vehicle_of(const Distributer& distributer,
                                                    const NamedList<vehicles::VehicleClass>& vehicles,
                                                    const Files& files) {
  const Yaml *const type = distributer.link.find("type"), *const name = distributer.link.find("vehicle");
  if (type == nullptr || type->text != "simulation" || name == nullptr) return std::nullopt;
  const auto source = find_file(files, name->text);
  if (!source) return std::nullopt;
  Problems problems;  // whoever makes the vehicle reports them
  auto file = distributers::read_vehicle_file(source, vehicles, problems);
  if (const Yaml* const changes = distributer.link.find("parameters"); file && changes != nullptr)
    bind_fields(*changes, *file->vehicle->parameters, file->parameters.data(), "", "parameter", problems);
  return file;
}

}  // namespace

std::optional<Flow> find_flow(const Graph& graph, const NamedList<vehicles::VehicleClass>& vehicles,
                              const Files& files) {
  for (const Distributer& distributer : graph.distributers) {
    const auto file = vehicle_of(distributer, vehicles, files);
    if (!file) continue;
    for (const auto& [of, north, east] : {std::array{"current", "sea.current_north", "sea.current_east"},
                                          std::array{"wind", "air.north", "air.east"}}) {
      const auto to_north = number_at(*file->vehicle->parameters, file->parameters, north);
      const auto to_east = number_at(*file->vehicle->parameters, file->parameters, east);
      if (to_north && to_east) return Flow{of, *to_north, *to_east};
    }
  }
  return std::nullopt;
}

}  // namespace jarol::tools::console
