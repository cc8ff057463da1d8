#include "tools/commands/vehicle/serve_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "graph/language/quantities.h"
#include "graph/values/type_of.h"
#include "tools/commands/run/real_time.h"
#include "tools/report/value_json.h"

namespace jarol::tools {
namespace {

using vehicles::VehicleState;

const std::vector<TypeField>& actuators_of(const vehicles::VehicleClass& vehicle_class) {
  return vehicle_class.outputs->fields.front().type->fields;
}

std::string place_text(const vehicles::VehicleClass& vehicle_class, const VehicleState& s,
                       const std::vector<double>& actuators) {
  constexpr double degrees = 180 / std::numbers::pi;
  std::string text =
      fmt::format("x {:.2f}, y {:.2f}, z {:.2f} m, phi {:.1f}, theta {:.1f}, psi {:.1f} deg, u {:.2f} m/s", s.x, s.y,
                  s.z, degrees * s.phi, degrees * s.theta, degrees * s.psi, s.u);
  for (std::size_t i = 0; i < actuators.size(); ++i)
    text += fmt::format("{}{} {:.4g}", i == 0 ? "; " : ", ", actuators_of(vehicle_class)[i].name, actuators[i]);
  return text;
}

nlohmann::ordered_json actuators_json(const vehicles::VehicleClass& vehicle_class,
                                      const std::vector<double>& actuators) {
  auto json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < actuators.size(); ++i) json[actuators_of(vehicle_class)[i].name] = actuators[i];
  return json;
}

}  // namespace

std::string to_text(const vehicles::VehicleClass& vehicle_class, const ServeOutcome& outcome) {
  const SilenceLog& log = outcome.silences;
  std::string text = vehicle_class.name + ": " + seconds_text(outcome.simulated) + " s in real time\n";
  if (log.silences() > 0)
    text += fmt::format("  peer        silent {} times, {} s in all\n", log.silences(), seconds_text(log.silent_for()));
  for (const Silence& silence : log.kept())
    text += fmt::format("    {} s to {} s, at {}\n", seconds_text(silence.from), seconds_text(silence.to),
                        place_text(vehicle_class, silence.state, silence.actuators));
  text += "  ended       at " + place_text(vehicle_class, outcome.state, outcome.actuators) + "\n";
  return text + to_text(outcome.link);
}

nlohmann::ordered_json to_json(const vehicles::VehicleClass& vehicle_class, const ServeOutcome& outcome) {
  const Type& state_type = type_of<VehicleState>();
  const SilenceLog& log = outcome.silences;
  auto silences = nlohmann::ordered_json::array();
  for (const Silence& silence : log.kept())
    silences.push_back({{"from_ns", silence.from.count()},
                        {"to_ns", silence.to.count()},
                        {"state", to_json(state_type, &silence.state)},
                        {"actuators", actuators_json(vehicle_class, silence.actuators)}});
  return {{"schema", "jarol.vehicle/1"},
          {"vehicle", vehicle_class.name},
          {"simulated_ns", outcome.simulated.count()},
          {"peer", {{"silent", log.silences()}, {"silent_ns", log.silent_for().count()}, {"silences", silences}}},
          {"state", to_json(state_type, &outcome.state)},
          {"actuators", actuators_json(vehicle_class, outcome.actuators)},
          {"link", to_json(outcome.link)},
          {"mishap", outcome.mishap ? nlohmann::ordered_json(outcome.mishap->text) : nlohmann::ordered_json()}};
}

}  // namespace jarol::tools
