#include "tests/tools/flight.h"

#include <algorithm>
#include <cmath>

#include "distributers/distributers.h"
#include "tools/commands/run/load_graph.h"
#include "tools/library/built_in.h"
#include "vehicles/helicopter/helicopter.h"

namespace jarol::tests {
namespace {

// where the watched vehicle writes; a vehicle class has room for nothing else
std::vector<Glimpse>* watching = nullptr;

class Watched : public vehicles::Helicopter {
 public:
  Watched(const vehicles::HelicopterParameters& parameters, std::uint64_t seed) : Helicopter(parameters, seed) {
    look();
  }

  void step() override {
    Helicopter::step();
    ++steps_;
    look();
  }

 private:
  void look() {
    const vehicles::HelicopterMotion m = motion();
    const auto& truth = *static_cast<const vehicles::HelicopterTruth*>(true_values());
    if (steps_ == 0) ground_ = m.p_n[2];
    watching->push_back({.time = 0.005 * steps_,
                         .x = m.p_n[0],
                         .y = m.p_n[1],
                         .altitude = ground_ - m.p_n[2],
                         .roll = std::atan2(m.R_nb[2][1], m.R_nb[2][2]),
                         .pitch = -std::asin(m.R_nb[2][0]),
                         .yaw = std::atan2(m.R_nb[1][0], m.R_nb[0][0]),
                         .climb = -vehicles::to_ned(m.R_nb, m.v_b)[2],
                         .touch_down = truth.touch_down,
                         .impact = truth.impact});
  }

  int steps_ = 0;
  double ground_ = 0;
};

class PilotSystem : public ExternalSystem {
 public:
  explicit PilotSystem(std::function<tasks::PilotCommand(double)> pilot) : pilot_(std::move(pilot)) {}
  void reach(Duration instant) override { now_ = 1e-9 * static_cast<double>(instant.count()); }
  bool take(std::size_t, void* value) override {
    *static_cast<tasks::PilotCommand*>(value) = pilot_(now_);
    return true;
  }
  void hand_over(std::size_t, const void*) override {}

 private:
  std::function<tasks::PilotCommand(double)> pilot_;
  double now_ = 0;
};

// Keeps every value of one output.
template <class T>
class Keep : public RecordSink {
 public:
  Keep(const std::vector<Output>& outputs, const std::string& output, std::vector<std::pair<double, T>>& to) : to_(to) {
    const auto found = std::find_if(outputs.begin(), outputs.end(), [&](const Output& o) { return o.name == output; });
    output_ = static_cast<std::uint32_t>(found - outputs.begin());
  }
  void take(Duration instant, std::uint32_t output, const void* value) override {
    if (output == output_) to_.emplace_back(1e-9 * static_cast<double>(instant.count()), *static_cast<const T*>(value));
  }
  void finish() override {}

 private:
  std::uint32_t output_ = 0;
  std::vector<std::pair<double, T>>& to_;
};

// As if the processor had been taken from all tasks for so long.
std::vector<Miss> misses_of(const Graph& graph, double from, double seconds) {
  constexpr double period = 0.015;  // s
  std::vector<Miss> misses;
  const std::int64_t first = std::llround(from / period);
  for (std::int64_t i = first; i < first + std::llround(seconds / period); ++i)
    for (std::uint32_t task = 0; task < graph.tasks.size(); ++task)
      misses.push_back({.activation = i, .task = task, .left_out = 1});
  return misses;
}

}  // namespace

Flight fly(const FlightPlan& plan) {
  auto loaded = tools::load_graph(plan.graph, {.profile = plan.profile, .set = plan.set});
  vehicles::VehicleClass watched = *built_in().vehicles.find("helicopter");
  watched.make = [](const void* parameters, std::uint64_t seed) -> std::unique_ptr<vehicles::Vehicle> {
    return std::make_unique<Watched>(*static_cast<const vehicles::HelicopterParameters*>(parameters), seed);
  };
  distributers::Registries known = built_in();
  known.vehicles = {};
  known.vehicles.add(watched);
  Flight flight;
  watching = &flight.path;
  Problems problems;
  auto systems = distributers::make_external_systems(*loaded.graph, known, plan.seed, problems);
  problems.throw_if_any();
  Duration end(std::llround(1e9 * plan.seconds));
  for (std::size_t i = 0; i < systems.size(); ++i) {
    if (loaded.graph->distributers[i].name != "terminal") continue;
    if (plan.pilot) {
      systems[i] = std::make_unique<PilotSystem>(plan.pilot);
    } else {
      end = systems[i]->end().value_or(end);
    }
  }
  const std::vector<Output> outputs = outputs_of(*loaded.graph);
  Keep directives(outputs, "logic.directive", flight.directives);
  Keep estimates(outputs, "filter.estimate", flight.estimates);
  Keep motors(outputs, "mixer.motors", flight.motors);
  Recorder recorder({&directives, &estimates, &motors});
  const std::vector<Miss> pause = misses_of(*loaded.graph, plan.still_at, plan.still_for);
  ExecutorOptions options{.digest = true, .recorder = &recorder};
  if (!pause.empty()) options.misses = pause;
  Executor executor(*loaded.graph, std::move(systems), options);
  executor.run_until(end);
  recorder.close();
  flight.report = executor.report();
  return flight;
}

double Flight::max(double Glimpse::*value, double from, double to) const {
  double max = -1e300;
  for (const Glimpse& g : path)
    if (g.time >= from && g.time <= to) max = std::max(max, g.*value);
  return max;
}

double Flight::min(double Glimpse::*value, double from, double to) const {
  double min = 1e300;
  for (const Glimpse& g : path)
    if (g.time >= from && g.time <= to) min = std::min(min, g.*value);
  return min;
}

double Flight::furthest(double Glimpse::*value, double of, double from, double to) const {
  return std::max(max(value, from, to) - of, of - min(value, from, to));
}

double Flight::settled(double Glimpse::*value, double of, double band) const {
  double time = 0;
  for (const Glimpse& g : path)
    if (std::abs(g.*value - of) > band) time = g.time;
  return time;
}

Glimpse Flight::at(double time) const {
  for (const Glimpse& g : path)
    if (g.time >= time - 1e-9) return g;
  return path.back();
}

tasks::PilotCommand hover_command(double time) {
  tasks::PilotCommand command;
  command.mode_switches = 1;
  command.state_switches = (time >= 0.5 ? 1U : 0U) + (time >= 1 ? 1U : 0U);
  command.altitude = time >= 3 ? 1 : 0;
  return command;
}

}  // namespace jarol::tests
