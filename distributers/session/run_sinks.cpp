#include "distributers/session/run_sinks.h"

#include <utility>

namespace jarol {

RunSinks::RunSinks(const Graph& graph, std::vector<RecordSink*> sinks, std::span<const expect::Condition> measured,
                   Duration hand_on_period) {
  const auto watch = [&](std::optional<Expectations>& by, std::span<const expect::Condition> conditions) {
    if (!conditions.empty()) sinks.insert(sinks.begin(), &by.emplace(graph, outputs_of(graph), conditions));
  };
  watch(measured_, measured);
  watch(expectations_, graph.expectations);
  if (!sinks.empty()) recorder_ = std::make_unique<Recorder>(std::move(sinks), hand_on_period);
}

void RunSinks::catch_up() {
  if (recorder_) recorder_->catch_up();
}

void RunSinks::rethrow_failure() const {
  if (recorder_) recorder_->rethrow_failure();
}

const std::string& RunSinks::lost() const {
  static const std::string nothing;
  return recorder_ ? recorder_->lost() : nothing;
}

std::string RunSinks::failure_of(const RecordSink& sink) const { return recorder_->failure_of(sink); }

std::string RunSinks::failure_of_conditions() const {
  const std::string failure = expectations_ ? failure_of(*expectations_) : "";
  return failure.empty() && measured_ ? failure_of(*measured_) : failure;
}

std::string RunSinks::why_not_all(const RecordSink& sink) const { return recorder_->why_not_all(sink); }

void RunSinks::close() {
  if (recorder_) recorder_->close();
}

std::vector<Verdict> RunSinks::judge_by(const std::optional<Expectations>& conditions, Duration end,
                                        const std::string& cut_short) const {
  if (!conditions) return {};
  const std::string unseen = why_not_all(*conditions);
  return conditions->judge(end, unseen.empty() ? cut_short : unseen);
}

std::vector<Verdict> RunSinks::judge(Duration end, const std::string& cut_short) const {
  return judge_by(expectations_, end, cut_short);
}

std::vector<Verdict> RunSinks::measure(Duration end, const std::string& cut_short) const {
  return judge_by(measured_, end, cut_short);
}

}  // namespace jarol
