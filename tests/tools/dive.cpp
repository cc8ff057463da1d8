#include "tests/tools/dive.h"

#include <algorithm>

#include "tools/commands/run/load_graph.h"

namespace jarol::test {
namespace {

// An external system, watched: `motion` is looked at at every instant, and given to whom it is due.
class Watched : public ExternalSystem {
 public:
  Watched(std::unique_ptr<ExternalSystem> watched, std::vector<Sample>& samples)
      : watched_(std::move(watched)), samples_(samples) {}

  void reach(Duration instant) override {
    watched_->reach(instant);
    if (!watched_->take(0, &motion_)) return;
    fresh_ = true;
    samples_.push_back({1e-9 * static_cast<double>(instant.count()), motion_});
  }
  bool take(std::size_t channel, void* value) override {
    if (channel != 0) return watched_->take(channel, value);
    if (fresh_) *static_cast<tasks::Motion*>(value) = motion_;
    return std::exchange(fresh_, false);
  }
  void hand_over(std::size_t channel, const void* value) override { watched_->hand_over(channel, value); }

 private:
  std::unique_ptr<ExternalSystem> watched_;
  std::vector<Sample>& samples_;
  tasks::Motion motion_;
  bool fresh_ = false;
};

class Alarms : public RecordSink {
 public:
  Alarms(std::uint32_t output, Dive& to) : output_(output), to_(to) {}
  void take(Duration instant, std::uint32_t output, const void* value) override {
    if (output != output_) return;
    const auto [alarm, fins] = *static_cast<const tasks::Condition*>(value);
    if (to_.alarm == tasks::Alarm::none && alarm != tasks::Alarm::none)
      to_.alarmed_at = 1e-9 * static_cast<double>(instant.count());
    to_.alarm = alarm;
    to_.fins = fins;
  }
  void finish() override {}

 private:
  std::uint32_t output_;
  Dive& to_;
};

}  // namespace

Dive dive(const std::string& file, const std::vector<std::string>& overrides, std::uint64_t seed, Duration end) {
  const std::size_t colon = std::min(file.find(':'), file.size());
  const std::string profile = colon < file.size() ? file.substr(colon + 1) : "";
  auto loaded = tools::load_graph(file.substr(0, colon), {.profile = profile, .set = overrides}, seed);
  const std::vector<Output> outputs = outputs_of(*loaded.graph);
  Dive done;
  const auto at =
      std::find_if(outputs.begin(), outputs.end(), [](const Output& o) { return o.name == "supervisor.condition"; });
  Alarms alarms(static_cast<std::uint32_t>(at - outputs.begin()), done);
  Recorder recorder({&alarms});
  if (end == Duration{})
    for (const auto& system : loaded.systems) end = std::max(end, system->end().value_or(Duration{}));
  for (std::size_t i = 0; i < loaded.systems.size(); ++i)
    if (loaded.graph->distributers[i].distributer_class->name == "LauvVehicle")
      loaded.systems[i] = std::make_unique<Watched>(std::move(loaded.systems[i]), done.samples);
  Executor executor(*loaded.graph, std::move(loaded.systems), {.digest = true, .recorder = &recorder});
  executor.run_until(end);
  recorder.close();
  done.report = executor.report();
  return done;
}

}  // namespace jarol::test
