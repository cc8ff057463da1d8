#include "runtime/record/log.h"

#include <algorithm>

#include "graph/values/type_of.h"
#include "runtime/record/recording_format.h"

namespace jarol {

ReplayedSystem::ReplayedSystem(const Graph& graph, std::size_t distributer, TakenValues& values)
    : values_(values), communicators_(graph.distributers[distributer].distributer_class->channels.size()) {
  for (std::size_t i = 0; i < graph.communicators.size(); ++i)
    if (graph.communicators[i].distributer == distributer) communicators_[graph.communicators[i].channel] = i;
}

std::vector<std::size_t> logged_inputs(const Graph& graph) {
  std::vector<std::size_t> inputs;
  for (std::size_t i = 0; i < graph.communicators.size(); ++i)
    if (graph.communicators[i].direction == Direction::in && graph.communicators[i].distributer) inputs.push_back(i);
  return inputs;
}

std::vector<Output> log_outputs(const Graph& graph) {
  std::vector<Output> outputs;
  for (const std::size_t i : logged_inputs(graph))
    outputs.push_back({graph.communicators[i].name, graph.communicators[i].type});
  outputs.push_back({std::string(topics::misses), &type_of<Miss>()});
  outputs.push_back({std::string(topics::digests), &type_of<RunningDigest>()});
  outputs.push_back({std::string(topics::rest), &type_of<RestBegin>()});
  return outputs;
}

MissedActivations::MissedActivations(std::size_t tasks, std::span<const Miss> misses) : misses_(tasks), next_(tasks) {
  for (const Miss& miss : misses) misses_.at(miss.task).push_back(miss);
  for (std::vector<Miss>& of_task : misses_)
    std::sort(of_task.begin(), of_task.end(), [](const Miss& a, const Miss& b) { return a.activation < b.activation; });
}

const Miss* MissedActivations::find(std::size_t task, std::int64_t activation) {
  const std::vector<Miss>& misses = misses_[task];
  std::size_t& next = next_[task];
  while (next < misses.size() && misses[next].activation < activation) ++next;
  return next < misses.size() && misses[next].activation == activation ? &misses[next] : nullptr;
}

std::vector<std::unique_ptr<ExternalSystem>> replayed_systems(const Graph& graph, TakenValues& values) {
  std::vector<std::unique_ptr<ExternalSystem>> all;
  for (std::size_t d = 0; d < graph.distributers.size(); ++d)
    all.push_back(std::make_unique<ReplayedSystem>(graph, d, values));
  return all;
}

}  // namespace jarol
