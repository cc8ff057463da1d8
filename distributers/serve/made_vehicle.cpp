#include "distributers/serve/made_vehicle.h"

#include <algorithm>
#include <stdexcept>

#include "distributers/interfaces/vehicle_file.h"
#include "graph/language/override.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "graph/values/bind.h"
#include "graph/values/seed.h"
#include "graph/values/type_of.h"

namespace jarol {
namespace {

// "hull.mass" and a value as the mapping {hull: {mass: value}}.
Yaml nested(const std::string& path, Yaml value, const Location& where) {
  const std::size_t dot = path.find('.');
  Yaml mapping;
  mapping.kind = Yaml::Kind::mapping;
  mapping.where = where;
  Yaml child = dot == std::string::npos ? std::move(value) : nested(path.substr(dot + 1), std::move(value), where);
  child.key = path.substr(0, dot);
  child.key_where = where;
  mapping.children.push_back(std::move(child));
  return mapping;
}

// "z=4,theta=5deg" over the state where the vehicle stands.
void read_initial(const VehicleOptions& options, vehicles::VehicleState& state, Problems& problems) {
  const std::string& text = options.initial;
  const auto source = std::make_shared<Source>(Source{options.words.initial, text});
  const std::vector<Leaf> leaves = leaves_of(type_of<vehicles::VehicleState>());
  std::vector<std::string> names;
  for (const Leaf& leaf : leaves) names.push_back(leaf.path);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const Location where{source, 1, static_cast<int>(begin) + 1};
    begin = end + 1;
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) {
      problems.add(where, "'" + part + "' sets nothing; write name=value, as in z=4,theta=0.1");
      continue;
    }
    const std::string name = part.substr(0, equals), value = part.substr(equals + 1);
    const auto leaf = std::find_if(leaves.begin(), leaves.end(), [&](const Leaf& l) { return l.path == name; });
    if (leaf == leaves.end()) {
      problems.add(where,
                   "the state has no '" + name + "'" + did_you_mean(name, names) + "; it has: " + list_of(names));
      continue;
    }
    const std::string wrong =
        parse_scalar(*leaf->type, value, leaf->unit, reinterpret_cast<std::byte*>(&state) + leaf->offset);
    if (!wrong.empty()) problems.add(where, "'" + name + "': '" + value + "' " + wrong);
  }
}

}  // namespace

Value read_parameters(const VehicleOptions& options, const vehicles::VehicleClass& vehicle,
                      const NamedList<vehicles::VehicleClass>& known, Problems& problems) {
  Value parameters(*vehicle.parameters);
  if (!options.parameters.empty()) {
    const auto source = read_source(options.parameters);
    if (auto file = distributers::read_vehicle_file(source, known, problems)) {
      if (file->vehicle->name == vehicle.name)
        parameters = std::move(file->parameters);
      else
        problems.add({source, 1, 1},
                     "the file is one of vehicle '" + file->vehicle->name + "', not of vehicle '" + vehicle.name + "'");
    }
  }
  for (const std::string& argument : options.set) {
    std::string path;
    Yaml value;
    if (!read_set(argument, options.words.set, "sea.density=1025", path, value, problems)) continue;
    const Location where{value.where.source, 1, 1};
    bind_fields(nested(path, std::move(value), where), *vehicle.parameters, parameters.data(),
                "vehicle '" + vehicle.name + "'", "parameter", problems);
  }
  return parameters;
}

std::unique_ptr<vehicles::Vehicle> make_vehicle(const VehicleOptions& options,
                                                const vehicles::VehicleClass& vehicle_class, const Value& parameters,
                                                std::uint64_t seed, Problems& problems) {
  std::unique_ptr<vehicles::Vehicle> vehicle;
  try {
    vehicle = vehicle_class.make(parameters.data(), seed);
  } catch (const std::exception& error) {
    problems.throw_if_any();
    throw InputError("vehicle '" + vehicle_class.name + "' can't be made: " + error.what());
  }
  if (!options.initial.empty()) {
    vehicles::VehicleState state = vehicle->state();
    read_initial(options, state, problems);
    problems.throw_if_any();
    try {
      vehicle->place(state);
    } catch (const std::exception& error) { throw InputError(options.words.initial + ": " + error.what()); }
  }
  problems.throw_if_any();
  return vehicle;
}

std::uint64_t own_seed(const VehicleOptions& options, const vehicles::VehicleClass& vehicle_class) {
  return spread_seed(options.seed, vehicle_class.name);
}

}  // namespace jarol
