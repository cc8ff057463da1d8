#include "distributers/session/recorded_truth.h"

#include <algorithm>
#include <string>
#include <utility>

#include "graph/values/value.h"
#include "runtime/record/cdr.h"

namespace jarol {
namespace {

// The true values of its vehicle, too.
class RecordedSystem : public ReplayedSystem {
 public:
  RecordedSystem(const Graph& graph, std::size_t distributer, RecordedRun& run, const ReadTopic& topic,
                 const Type& type)
      : ReplayedSystem(graph, distributer, run), topic_(topic), next_(run.recording(), topic), value_(type) {}

  void reach(Duration instant) override {
    ReplayedSystem::reach(instant);
    for (; next_.message() != nullptr && next_.message()->time <= instant; next_.next()) decode();
  }
  const Type* true_type() const override { return value_.type(); }
  void copy_true_values(void* to) const override { copy_value(*value_.type(), to, value_.data()); }

 private:
  void decode() {
    const std::string_view data = next_.message()->data;
    const std::span bytes(reinterpret_cast<const std::byte*>(data.data()), data.size());
    if (const std::string wrong = decode_cdr(*value_.type(), bytes, value_.data()); !wrong.empty())
      fail_in_chunk(next_.spot(), "a value of '" + topic_.channel.topic + "' that " + wrong);
  }

  const ReadTopic& topic_;
  MessageCursor next_;
  Value value_;
};

// The state of the one that was saved, too.
class ResumedSystem : public ReplayedSystem {
 public:
  ResumedSystem(const Graph& graph, std::size_t distributer, TakenValues& values, std::unique_ptr<ExternalSystem> saved)
      : ReplayedSystem(graph, distributer, values), saved_(std::move(saved)) {}
  void serialize(Archive& archive) override { saved_->serialize(archive); }

 private:
  std::unique_ptr<ExternalSystem> saved_;
};

}  // namespace

std::vector<const Type*> types_of_truth(const Loaded& loaded) {
  std::vector<const Type*> types;
  for (const expect::TrueValues& values : loaded.true_values) types.push_back(values.type);
  return types;
}

std::vector<std::unique_ptr<ExternalSystem>> recorded_systems(const Loaded& loaded, RecordedRun& run) {
  const Graph& graph = *loaded.graph;
  std::vector<std::unique_ptr<ExternalSystem>> systems = replayed_systems(graph, run);
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const Type* const type = loaded.true_values[i].type;
    const ReadTopic* const topic =
        type == nullptr ? nullptr : run.recording().find(std::string(topics::truth) + graph.distributers[i].name);
    if (topic != nullptr) systems[i] = std::make_unique<RecordedSystem>(graph, i, run, *topic, *type);
  }
  return systems;
}

std::vector<std::unique_ptr<ExternalSystem>> resumed_systems(const Graph& graph, RecordedRun& run,
                                                             std::vector<std::unique_ptr<ExternalSystem>> saved) {
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  for (std::size_t i = 0; i < saved.size(); ++i)
    systems.push_back(std::make_unique<ResumedSystem>(graph, i, run, std::move(saved[i])));
  return systems;
}

void judge_no_other_truth(const Graph& graph, Evidence evidence, bool other_graph, std::vector<Verdict>& verdicts) {
  const bool diverged = evidence == Evidence::diverged;
  if (!diverged && !(other_graph && evidence == Evidence::unknown)) return;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const expect::Condition& condition = graph.expectations[i];
    const auto is_truth = [](const expect::Signal& signal) { return signal.distributer.has_value(); };
    if (!condition.not_judged.empty() || std::none_of(condition.signals.begin(), condition.signals.end(), is_truth))
      continue;
    verdicts[i] = {.outcome = Verdict::Outcome::not_judged,
                   .condition = verdicts[i].condition,
                   .why = std::string("the vehicle might have gone elsewhere, as the replay ") +
                          (diverged ? "has diverged" : "is of another file")};
  }
}

}  // namespace jarol
