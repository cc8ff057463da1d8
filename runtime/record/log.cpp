#include "runtime/record/log.h"

#include <algorithm>

#include "graph/values/type_of.h"
#include "runtime/record/recording_format.h"

namespace jarol {
namespace {

class ReplayedSystem : public ExternalSystem {
 public:
  ReplayedSystem(TakenValues& values, std::vector<std::size_t> communicators)
      : values_(values), communicators_(std::move(communicators)) {}

  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t channel, void* value) override { return values_.take(now_, communicators_[channel], value); }
  void hand_over(std::size_t, const void*) override {}

 private:
  TakenValues& values_;
  std::vector<std::size_t> communicators_;  // per channel
  Duration now_{};
};

}  // namespace

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

std::vector<std::unique_ptr<ExternalSystem>> replayed_channels(const Graph& graph, TakenValues& values) {
  std::vector<std::unique_ptr<ExternalSystem>> all;
  for (std::size_t d = 0; d < graph.distributers.size(); ++d) {
    std::vector<std::size_t> communicators(graph.distributers[d].distributer_class->channels.size());
    for (std::size_t i = 0; i < graph.communicators.size(); ++i)
      if (graph.communicators[i].distributer == d) communicators[graph.communicators[i].channel] = i;
    all.push_back(std::make_unique<ReplayedSystem>(values, std::move(communicators)));
  }
  return all;
}

}  // namespace jarol
