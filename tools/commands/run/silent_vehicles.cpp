#include "tools/commands/run/silent_vehicles.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/commands/run/prompt_line.h"

namespace jarol::tools {
namespace {

std::string vehicles_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return (names.size() == 1 ? "the vehicle of " : "the vehicles of ") + text;
}

}  // namespace

SilentVehicles::SilentVehicles(const Graph& graph, const std::vector<ExternalSystem*>& systems) {
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const auto* const link = dynamic_cast<const distributers::LinkedSystem*>(systems[i]);
    const auto takes = [i](const Communicator& c) { return c.distributer == i && c.direction == Direction::in; };
    if (link != nullptr && graph.distributers[i].distributer_class->is_vehicle &&
        std::any_of(graph.communicators.begin(), graph.communicators.end(), takes))
      vehicles_.push_back({graph.distributers[i].name, link});
  }
}

std::vector<std::string> SilentVehicles::unheard() const {
  std::vector<std::string> names;
  for (const Vehicle& vehicle : vehicles_)
    if (vehicle.link->heard() == 0) names.push_back(vehicle.name);
  return names;
}

void SilentVehicles::look() {
  const Clock::time_point now = Clock::now();
  if (done_ || now < next_look_) return;
  next_look_ = now + interval;
  const std::vector<std::string> silent = unheard();
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  done_ = silent.empty();
  if (done_ && said_) note_promptly(fmt::format("after {:.1f} s every vehicle is heard", seconds));
  if (done_ || said_) return;
  said_ = true;
  note_promptly(
      fmt::format("nothing has come from {} in {:.1f} s; is it there? The run goes on, and hears it when it is",
                  vehicles_text(silent), seconds));
}

void SilentVehicles::rest_begins() {
  done_ = true;
  if (const std::vector<std::string> silent = unheard(); !silent.empty())
    note_promptly("nothing has come from " + vehicles_text(silent) + ", so that its rest can't be seen");
}

}  // namespace jarol::tools
