#include "tools/library/serve_vehicle.h"

#include "graph/language/yaml.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

std::unique_ptr<distributers::Link> make_link(std::string text, const messages::MessageSet& set, Problems& problems) {
  constexpr const char* subject = "the link";
  const auto& links = built_in().links;
  const Yaml yaml = read_yaml(std::make_shared<const Source>(Source{subject, std::move(text)}), problems);
  const Yaml* const type = yaml.find("type");
  const distributers::LinkType* const found = type == nullptr ? nullptr : links.find(type->text);
  if (found != nullptr && found->make_link) return found->make_link(yaml, set, subject, problems);
  std::vector<std::string> names;
  for (const distributers::LinkType& one : links.entries())
    if (one.make_link) names.push_back(one.name);
  const std::string can = "; a vehicle in real time can have: " + list_of(names);
  if (type == nullptr)
    problems.add(yaml.where, std::string(subject) + " lacks the key 'type'" + can);
  else
    problems.add(type->where,
                 std::string(subject) + " has type '" + type->text + "'" + did_you_mean(type->text, names) + can);
  return nullptr;
}

}  // namespace

ServeOutcome serve_vehicle(const std::string& name, std::string link_text, const VehicleOptions& made,
                           const ServeOptions& options, const BuildOptions& program) {
  const auto& vehicles = built_in(program).vehicles;
  const vehicles::VehicleClass* const found = vehicles.find(name);
  if (found == nullptr)
    throw InputError("there is no vehicle '" + name + "'" + did_you_mean(name, vehicles.names()) +
                     "; this build has: " + list_of(vehicles.names()));
  if (options.telemetry == Telemetry::true_state && found->true_state == nullptr)
    throw InputError("there is no message of a " + name + "'s true state");
  Problems problems;
  const Value parameters = read_parameters(made, *found, vehicles, problems);
  const auto link = make_link(std::move(link_text), *found->message_set, problems);
  const auto vehicle = make_vehicle(made, *found, parameters, own_seed(made, *found), problems);
  return serve_vehicle(*vehicle, *found, *link, options);
}

}  // namespace jarol
