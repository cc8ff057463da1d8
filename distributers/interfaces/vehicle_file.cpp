#include "distributers/interfaces/vehicle_file.h"

#include <algorithm>

#include "graph/language/key.h"
#include "graph/registry.h"
#include "graph/values/bind.h"

namespace jarol::distributers {
namespace {

struct VehicleSpec {
  Maybe<std::string> vehicle;
  Maybe<Yaml> parameters;
};

const std::vector<Key<VehicleSpec>>& vehicle_keys() {
  static const std::vector<Key<VehicleSpec>> keys{
      key<&VehicleSpec::vehicle>("vehicle", Form::word, "name of the vehicle", true),
      key<&VehicleSpec::parameters>("parameters", Form::mapping, "its parameters; what is left out keeps its default"),
  };
  return keys;
}

}  // namespace

std::optional<VehicleFile> read_vehicle_file(const std::shared_ptr<const Source>& source,
                                             const NamedList<vehicles::VehicleClass>& known, Problems& problems) {
  const std::size_t before = problems.size();
  const Yaml file = read_yaml(source, problems);
  if (problems.size() > before) return std::nullopt;
  VehicleSpec spec;
  read_keys(file, vehicle_keys(), spec, "a vehicle file", problems);
  if (!spec.vehicle) return std::nullopt;
  const vehicles::VehicleClass* const found = known.find(spec.vehicle->value);
  if (found == nullptr) {
    const std::vector<std::string> names = known.names();
    problems.add(spec.vehicle->where, "there is no vehicle '" + spec.vehicle->value + "'" +
                                          did_you_mean(spec.vehicle->value, names) +
                                          "; this build has: " + list_of(names));
    return std::nullopt;
  }
  VehicleFile read{found, Value(*found->parameters)};
  if (spec.parameters)
    bind_fields(spec.parameters->value, *found->parameters, read.parameters.data(), "vehicle '" + found->name + "'",
                "parameter", problems);
  if (problems.size() > before) return std::nullopt;
  return read;
}

}  // namespace jarol::distributers
