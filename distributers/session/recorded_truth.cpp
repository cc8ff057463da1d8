#include "distributers/session/recorded_truth.h"

#include <algorithm>
#include <string>
#include <utility>

#include "graph/values/value.h"
#include "runtime/record/cdr.h"

namespace jarol {
namespace {

class WithTruth : public ExternalSystem {
 public:
  WithTruth(std::unique_ptr<ExternalSystem> replayed, const Recording& recording, const ReadTopic& topic,
            const Type& type)
      : replayed_(std::move(replayed)), topic_(topic), next_(recording, topic), value_(type) {}

  void reach(Duration instant) override {
    replayed_->reach(instant);
    for (; next_.message() != nullptr && next_.message()->time <= instant; next_.next()) decode();
  }
  bool take(std::size_t channel, void* value) override { return replayed_->take(channel, value); }
  void hand_over(std::size_t channel, const void* value) override { replayed_->hand_over(channel, value); }
  const Type* true_type() const override { return value_.type(); }
  void copy_true_values(void* to) const override { copy_value(*value_.type(), to, value_.data()); }

 private:
  void decode() {
    const std::string_view data = next_.message()->data;
    const std::span bytes(reinterpret_cast<const std::byte*>(data.data()), data.size());
    if (const std::string wrong = decode_cdr(*value_.type(), bytes, value_.data()); !wrong.empty())
      fail_in_chunk(next_.spot(), "a value of '" + topic_.channel.topic + "' that " + wrong);
  }

  std::unique_ptr<ExternalSystem> replayed_;
  const ReadTopic& topic_;
  MessageCursor next_;
  Value value_;
};

}  // namespace

std::vector<const Type*> types_of_truth(const Loaded& loaded) {
  std::vector<const Type*> types;
  for (const expect::TrueValues& values : loaded.true_values) types.push_back(values.type);
  return types;
}

std::vector<std::unique_ptr<ExternalSystem>> recorded_channels(const Loaded& loaded, RecordedRun& run) {
  std::vector<std::unique_ptr<ExternalSystem>> channels = replayed_channels(*loaded.graph, run);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Type* const type = loaded.true_values[i].type;
    const ReadTopic* const topic =
        type == nullptr ? nullptr
                        : run.recording().find(std::string(topics::truth) + loaded.graph->distributers[i].name);
    if (topic != nullptr)
      channels[i] = std::make_unique<WithTruth>(std::move(channels[i]), run.recording(), *topic, *type);
  }
  return channels;
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
