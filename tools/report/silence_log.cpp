#include "tools/report/silence_log.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "graph/language/quantities.h"
#include "graph/values/bind.h"
#include "graph/values/type_of.h"
#include "tools/report/value_json.h"

namespace jarol::tools {

using vehicles::VehicleState;

void SilenceLog::note(std::chrono::nanoseconds instant, bool heard) {
  const std::chrono::nanoseconds before = now_;
  now_ = instant;
  if (!heard && instant - heard_ > patience) {
    if (!silent_) {
      ++silences_;
      silent_for_ += before - heard_;
      if (kept_.size() < max_kept) kept_.push_back({heard_, {}, {}, {}});
    }
    silent_ = true;
    silent_for_ += instant - before;
    if (silences_ <= max_kept) {
      kept_.back().to = instant;
      kept_.back().state = vehicle_.state();
      kept_.back().actuators = actuators();
    }
  }
  if (!heard) return;
  heard_ = instant;
  silent_ = false;
}

// the first of a vehicle's outputs are what its actuators do
std::vector<double> SilenceLog::actuators() const {
  const TypeField& first = class_.outputs->fields.front();
  std::vector<double> values;
  for (const TypeField& field : first.type->fields)
    values.push_back(
        read_floating(*field.type, static_cast<const std::byte*>(vehicle_.outputs()) + first.offset + field.offset));
  return values;
}

std::string SilenceLog::place_text(const VehicleState& s, const std::vector<double>& actuators) const {
  constexpr double degrees = 180 / std::numbers::pi;
  std::string text =
      fmt::format("x {:.2f}, y {:.2f}, z {:.2f} m, phi {:.1f}, theta {:.1f}, psi {:.1f} deg, u {:.2f} m/s", s.x, s.y,
                  s.z, degrees * s.phi, degrees * s.theta, degrees * s.psi, s.u);
  for (std::size_t i = 0; i < actuators.size(); ++i)
    text += fmt::format("{}{} {:.4g}", i == 0 ? "; " : ", ", actuators_type().fields[i].name, actuators[i]);
  return text;
}

std::string SilenceLog::to_text() const {
  std::string text;
  if (silences_ > 0)
    text += fmt::format("  peer        silent {} times, {} s in all\n", silences_, seconds_text(silent_for_));
  for (const Silence& silence : kept_)
    text += fmt::format("    {} s to {} s, at {}\n", seconds_text(silence.from), seconds_text(silence.to),
                        place_text(silence.state, silence.actuators));
  return text + "  ended       at " + place_text(vehicle_.state(), actuators()) + "\n";
}

nlohmann::ordered_json SilenceLog::actuators_json(const std::vector<double>& actuators) const {
  auto json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < actuators.size(); ++i) json[actuators_type().fields[i].name] = actuators[i];
  return json;
}

nlohmann::ordered_json SilenceLog::to_json() const {
  const Type& state_type = type_of<VehicleState>();
  auto silences = nlohmann::ordered_json::array();
  for (const Silence& silence : kept_)
    silences.push_back({{"from_ns", silence.from.count()},
                        {"to_ns", silence.to.count()},
                        {"state", tools::to_json(state_type, &silence.state)},
                        {"actuators", actuators_json(silence.actuators)}});
  const VehicleState state = vehicle_.state();
  return {{"vehicle", class_.name},
          {"simulated_ns", now_.count()},
          {"peer", {{"silent", silences_}, {"silent_ns", silent_for_.count()}, {"silences", silences}}},
          {"state", tools::to_json(state_type, &state)},
          {"actuators", actuators_json(actuators())}};
}

}  // namespace jarol::tools
