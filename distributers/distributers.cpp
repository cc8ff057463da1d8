#include "distributers/distributers.h"

#include <algorithm>
#include <filesystem>

#include "distributers/javiator/operator.h"
#include "distributers/javiator/vehicle.h"
#include "distributers/lauv/operator.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/links/link_spec.h"
#include "distributers/links/linked.h"
#include "distributers/links/lockstep.h"
#include "distributers/links/script.h"
#include "distributers/links/simulation.h"
#include "distributers/vehicle_file.h"
#include "graph/language/key.h"
#include "graph/values/bind.h"
#include "graph/values/seed.h"

namespace jarol::distributers {
namespace {

// A kind of external system; one without an adapter speaks no messages yet and can only be played from a script.
struct DistributerKind {
  DistributerClass description;
  std::unique_ptr<Adapter> (*make_adapter)(const void* parameters) = nullptr;
};

const std::vector<DistributerKind>& kinds() {
  static const std::vector<DistributerKind> all{
      {JaviatorVehicle::describe_class(),
       [](const void*) -> std::unique_ptr<Adapter> { return std::make_unique<JaviatorVehicle>(); }},
      {JaviatorOperator::describe_class(),
       [](const void* parameters) -> std::unique_ptr<Adapter> {
         return std::make_unique<JaviatorOperator>(*static_cast<const JaviatorOperatorParameters*>(parameters));
       }},
      {LauvVehicle::describe_class(),
       [](const void*) -> std::unique_ptr<Adapter> { return std::make_unique<LauvVehicle>(); }},
      {LauvOperator::describe_class(),
       [](const void* parameters) -> std::unique_ptr<Adapter> {
         return std::make_unique<LauvOperator>(*static_cast<const LauvOperatorParameters*>(parameters));
       }},
  };
  return all;
}

const DistributerKind& kind_of(const Distributer& distributer) {
  return *std::find_if(kinds().begin(), kinds().end(), [&](const DistributerKind& kind) {
    return kind.description.name == distributer.distributer_class->name;
  });
}

struct SimulationSpec {
  Maybe<std::string> type, vehicle;
  Maybe<Yaml> parameters;
};

const std::vector<Key<SimulationSpec>>& simulation_keys() {
  static const std::vector<Key<SimulationSpec>> keys{
      key<&SimulationSpec::type>("type", Form::word, "simulation: a vehicle in this process", true),
      key<&SimulationSpec::vehicle>("vehicle", Form::word, "parameter file of the vehicle, relative to this file",
                                    true),
      key<&SimulationSpec::parameters>("parameters", Form::mapping, "changes to the parameters of that file"),
  };
  return keys;
}

struct ScriptSpec {
  Maybe<std::string> type, file;
};

const std::vector<Key<ScriptSpec>>& script_keys() {
  static const std::vector<Key<ScriptSpec>> keys{
      key<&ScriptSpec::type>("type", Form::word, "script: rows of a CSV", true),
      key<&ScriptSpec::file>("file", Form::word, "the CSV, relative to this file", true),
  };
  return keys;
}

// A path in a file is relative to that file.
std::shared_ptr<const Source> read_beside(const Graph& graph, const Located<std::string>& path, Problems& problems) {
  const std::filesystem::path base =
      graph.where.source ? std::filesystem::path(graph.where.source->name).parent_path() : "";
  try {
    return read_source((base / path.value).string());
  } catch (const SpecError& error) {
    for (const Problem& problem : error.problems()) problems.add(path.where, problem.text);
    return nullptr;
  }
}

// What is not on the grid of the vehicle: periods and offsets of what touches it have to be.
std::vector<Problem> off_grid(const Graph& graph, std::size_t distributer, Duration grid) {
  std::vector<Problem> found;
  for (const Communicator& c : graph.communicators) {
    if (c.distributer != distributer) continue;
    for (const auto& [what, duration] : {std::pair("period", c.period), std::pair("offset", c.offset)})
      if (duration.count() % grid.count() != 0)
        found.push_back({c.where,
                         "communicator '" + c.name + "' has " + what + " " + duration_text(duration) +
                             "; it has to be a multiple of the vehicle's step of " + duration_text(grid),
                         {}});
  }
  return found;
}

std::unique_ptr<Channels> make_simulation(const Graph& graph, std::size_t index,
                                          const std::vector<vehicles::VehicleClass>& known, std::uint64_t seed,
                                          Problems& problems) {
  const Distributer& distributer = graph.distributers[index];
  const std::string subject = "link of distributer '" + distributer.name + "'";
  SimulationSpec spec;
  read_keys(distributer.link, simulation_keys(), spec, subject, problems);
  if (!spec.vehicle) return nullptr;
  const auto source = read_beside(graph, *spec.vehicle, problems);
  if (!source) return nullptr;
  const std::size_t before = problems.size();
  std::optional<VehicleFile> file = read_vehicle_file(source, known, problems);
  if (!file) return nullptr;
  const std::string name = "vehicle '" + file->vehicle->name + "'";
  if (spec.parameters)
    bind_fields(spec.parameters->value, *file->vehicle->parameters, file->parameters.data(), name, "parameter",
                problems);
  if (problems.size() > before) return nullptr;
  try {
    auto made = file->vehicle->make(file->parameters.data(), seed);
    for (const Problem& problem : off_grid(graph, index, made->grid())) problems.add(problem.where, problem.text);
    return std::make_unique<SimulationChannels>(std::move(made),
                                                kind_of(distributer).make_adapter(distributer.parameters.data()));
  } catch (const std::exception& error) {
    problems.add(spec.vehicle->where, name + " can't be made: " + error.what());
    return nullptr;
  }
}

struct LockstepSpec {
  Maybe<std::string> type, peer, key;
};

const std::vector<Key<LockstepSpec>>& lockstep_keys() {
  static const std::vector<Key<LockstepSpec>> keys{
      key<&LockstepSpec::type>("type", Form::word, "lockstep: a vehicle in another process, on the logical clock",
                               true),
      key<&LockstepSpec::peer>("peer", Form::word, "address and port where it listens", true),
      key<&LockstepSpec::key>("key", Form::word, "file of the key that both ends have; default: none"),
  };
  return keys;
}

std::unique_ptr<Channels> make_lockstep(const Graph& graph, std::size_t index, std::uint64_t seed, Problems& problems) {
  const Distributer& distributer = graph.distributers[index];
  LockstepSpec spec;
  read_keys(distributer.link, lockstep_keys(), spec, "link of distributer '" + distributer.name + "'", problems);
  if (!spec.peer) return nullptr;
  LockstepOptions options;
  if (spec.key && !(options.key = key_of(*spec.key, problems))) return nullptr;
  try {
    return std::make_unique<LockstepChannels>(
        Address::parse(spec.peer->value), seed, kind_of(distributer).make_adapter(distributer.parameters.data()),
        [&graph, index](Duration grid) {
          const std::vector<Problem> wrong = off_grid(graph, index, grid);
          return wrong.empty() ? std::string() : wrong.front().text;
        },
        std::move(options));
  } catch (const std::invalid_argument& error) {
    problems.add(spec.peer->where, error.what());
    return nullptr;
  }
}

std::unique_ptr<Channels> make_script(const Graph& graph, std::size_t index, Problems& problems) {
  const Distributer& distributer = graph.distributers[index];
  ScriptSpec spec;
  read_keys(distributer.link, script_keys(), spec, "link of distributer '" + distributer.name + "'", problems);
  if (!spec.file) return nullptr;
  const auto source = read_beside(graph, *spec.file, problems);
  if (!source) return nullptr;
  return std::make_unique<ScriptChannels>(source, *distributer.distributer_class, problems);
}

std::unique_ptr<Channels> make_linked(const Distributer& distributer, const std::string& subject, Problems& problems) {
  try {
    auto adapter = kind_of(distributer).make_adapter(distributer.parameters.data());
    auto link = make_link(distributer.link, adapter->message_set(), subject, problems);
    if (!link) return nullptr;
    auto announcer = make_announcer(distributer.link, adapter->message_set(), problems);
    return std::make_unique<LinkedChannels>(std::move(link), std::move(announcer), std::move(adapter));
  } catch (const std::invalid_argument& error) {
    problems.add(distributer.link.where, "distributer '" + distributer.name + "': " + error.what());
    return nullptr;
  }
}

std::vector<std::string> links_of(const DistributerKind& kind) {
  std::vector<std::string> links;
  if (kind.description.is_vehicle) links.insert(links.end(), {"simulation", "lockstep"});
  links.emplace_back("script");
  if (kind.make_adapter != nullptr) links.insert(links.end(), link_types().begin(), link_types().end());
  return links;
}

}  // namespace

void add_distributers(Registry& registry) {
  for (const DistributerKind& kind : kinds()) registry.add(kind.description);
}

std::vector<std::unique_ptr<Channels>> make_channels(const Graph& graph,
                                                     const std::vector<vehicles::VehicleClass>& vehicles,
                                                     std::uint64_t seed, Problems& problems) {
  std::vector<std::unique_ptr<Channels>> all;
  for (std::size_t i = 0; i < graph.distributers.size(); ++i) {
    const Distributer& distributer = graph.distributers[i];
    all.emplace_back();
    if (distributer.distributer_class == nullptr || distributer.link.kind != Yaml::Kind::mapping) continue;
    const std::vector<std::string> links = links_of(kind_of(distributer));
    const std::string subject = "link of distributer '" + distributer.name + "'";
    const Yaml* type = distributer.link.find("type");
    if (type == nullptr) {
      problems.add(distributer.link.where, subject + " lacks the key 'type'; a " + distributer.distributer_class->name +
                                               " can have: " + list_of(links));
    } else if (std::find(links.begin(), links.end(), type->text) == links.end()) {
      problems.add(type->where, subject + " has type '" + type->text + "'" + did_you_mean(type->text, links) + "; a " +
                                    distributer.distributer_class->name + " can have: " + list_of(links));
    } else if (type->text == "simulation") {
      all.back() = make_simulation(graph, i, vehicles, spread_seed(seed, distributer.name), problems);
    } else if (type->text == "lockstep") {
      all.back() = make_lockstep(graph, i, spread_seed(seed, distributer.name), problems);
    } else if (type->text == "script") {
      all.back() = make_script(graph, i, problems);
    } else {
      all.back() = make_linked(distributer, subject, problems);
    }
  }
  return all;
}

std::vector<std::vector<std::byte>> safe_packets(const Graph& graph, std::size_t distributer, Link& link) {
  struct Encoder : messages::Receiver {
    explicit Encoder(Link& by) : link(by) {}
    void receive(messages::MessageRef message) override {
      const std::span<const std::byte> packet = link.encode(message);
      packets.emplace_back(packet.begin(), packet.end());
    }
    Link& link;
    std::vector<std::vector<std::byte>> packets;
  } encoder(link);
  const Distributer& of = graph.distributers[distributer];
  const auto adapter = kind_of(of).make_adapter(of.parameters.data());
  for (const Communicator& c : graph.communicators)
    if (c.distributer == distributer && c.safe) adapter->take_over(c.channel, c.safe->data(), encoder);
  return std::move(encoder.packets);
}

}  // namespace jarol::distributers
