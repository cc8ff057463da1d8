#include "distributers/links/simulation.h"

#include "distributers/interfaces/vehicle_file.h"
#include "distributers/links/link_type.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "graph/values/bind.h"

namespace jarol::distributers {
namespace {

struct SimulationSpec {
  Maybe<std::string> vehicle;
  Maybe<Yaml> parameters;
};

std::unique_ptr<ExternalSystem> make_simulated_system(const SimulationSpec& spec, const LinkRequest& request,
                                                      Problems& problems) {
  if (!spec.vehicle) return nullptr;
  const auto source = request.read_beside(*spec.vehicle, problems);
  if (!source) return nullptr;
  const std::size_t before = problems.size();
  std::optional<VehicleFile> file = read_vehicle_file(source, request.vehicles, problems);
  if (!file) return nullptr;
  const std::string name = "vehicle '" + file->vehicle->name + "'";
  if (spec.parameters)
    bind_fields(spec.parameters->value, *file->vehicle->parameters, file->parameters.data(), name, "parameter",
                problems);
  if (problems.size() > before) return nullptr;
  std::unique_ptr<AnyDistributer> distributer;
  try {
    distributer = request.make_distributer();
  } catch (const InputError& error) {
    problems.add(request.yaml().where, "distributer '" + request.whose().name + "': " + error.what());
    return nullptr;
  }
  try {
    auto made = file->vehicle->make(file->parameters.data(), request.seed);
    for (const Problem& problem : off_grid(request.graph, request.distributer, made->grid()))
      problems.add(problem.where, problem.text);
    return std::make_unique<SimulatedSystem>(std::move(made), std::move(distributer));
  } catch (const std::exception& error) {
    problems.add(spec.vehicle->where, name + " can't be made: " + error.what());
    return nullptr;
  }
}

// What it throws that is no word of the archive's becomes one.
template <class Part>
void serialize_part(const std::string& whose, Part& part, Archive& archive) {
  const auto refuse = [&](const std::string& error) {
    const std::string what = whose + " serialize(Archive&) throws: " + error;
    if (archive.restores()) throw ArchiveError("can't be restored, as " + what);
    throw NotSaveable(what);
  };
  try {
    part.serialize(archive);
  } catch (const NotSaveable&) { throw; } catch (const ArchiveError&) {
    throw;
  } catch (const std::exception& error) { refuse(error.what()); } catch (...) {
    refuse("something that is no exception");
  }
}

}  // namespace

LinkType simulation_link() {
  LinkType type = link_type<SimulationSpec>(
      "simulation", "a vehicle in this process",
      {key<&SimulationSpec::vehicle>("vehicle", Form::word, "parameter file of the vehicle, relative to this file",
                                     true),
       key<&SimulationSpec::parameters>("parameters", Form::mapping, "changes to the parameters of that file")},
      make_simulated_system);
  type.for_vehicles = true;
  return type;
}

SimulatedSystem::SimulatedSystem(std::unique_ptr<vehicles::SteppedVehicle> vehicle,
                                 std::unique_ptr<AnyDistributer> distributer)
    : vehicle_(std::move(vehicle)), distributer_(std::move(distributer)), to_vehicle_(*vehicle_) {}

void SimulatedSystem::reach(Duration instant) {
  // sensors speak at every step of the grid, whether or not anyone listens: nothing depends on who looks
  if (!sensed_) {
    vehicle_->sense(*distributer_);
    sensed_ = true;
  }
  while (at_ + vehicle_->grid() <= instant) {
    vehicle_->step();
    at_ += vehicle_->grid();
    vehicle_->sense(*distributer_);
  }
}

std::string SimulatedSystem::mishap() const {
  const auto mishap = vehicle_->mishap();
  return mishap ? mishap->text + ", at " + seconds_text(mishap->instant) + " s" : "";
}

bool SimulatedSystem::take(std::size_t channel, void* value) { return distributer_->take(channel, value); }

void SimulatedSystem::hand_over(std::size_t channel, const void* value) {
  distributer_->hand_over(channel, value, to_vehicle_);
}

void SimulatedSystem::serialize(Archive& archive) {
  archive(at_, sensed_);
  archive.require(at_ >= Duration{} && at_ <= longest_duration, "has a vehicle at no time of a run");
  serialize_part("its vehicle's", *vehicle_, archive);
  serialize_part("its", *distributer_, archive);
}

}  // namespace jarol::distributers
