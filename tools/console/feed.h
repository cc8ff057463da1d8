// What a run publishes, on its way to whoever watches: bounded, thinned evenly where it comes faster than it is taken,
// and what was left out is counted.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/value.h"
#include "runtime/record/sink.h"

namespace jarol::tools::console {

/// Values of one output in the order of their instants.
struct Samples {
  std::vector<Duration> instants;
  std::vector<Value> values;
};

/// What happened in the run and is no publication.
struct FeedEvent {
  RunEvent::Kind kind{};
  Duration instant{};
  std::uint32_t task = 0;
  std::int64_t activation = 0;
  std::string cause, distributer;
};

/// What came since it was asked last.
struct Batch {
  std::vector<Samples> samples;  // per output
  std::vector<FeedEvent> events;
  std::uint64_t thinned = 0;  // values that were left out
  std::uint64_t lost_events = 0;

  bool empty() const;
  /// The newest instant of what is in it, or zero.
  Duration newest() const;
};

class Feed : public RecordSink {
 public:
  /// `outputs`: those of the graph, and the true values behind them; a null type: there is none. Of each at most `max`
  /// samples are kept until they are taken: beyond that every second one is left out. `strides`, where there are any:
  /// of each output no more than every so manieth is kept.
  Feed(std::vector<const Type*> outputs, std::size_t max, std::vector<std::uint64_t> strides = {});

  /// By whoever watches.
  Batch take_batch();

  bool wants(std::uint32_t output) const override { return output < types_.size(); }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void take_event(const RunEvent& event) override;
  void finish() override {}

  static constexpr std::size_t max_events = 1000;

 private:
  // Of the samples that come every `stride`th is kept, and the newest, which the next one replaces unless it is one of
  // these.
  struct Kept {
    Samples samples;
    std::uint64_t stride = 1, seen = 0;
    bool newest_only = false;  // the last of them is there as the newest
    bool counts() const { return seen % stride == 0; }
  };
  void thin(Kept& kept);
  std::vector<Kept> begin() const;

  const std::vector<const Type*> types_;
  const std::size_t most_;
  const std::vector<std::uint64_t> strides_;
  std::mutex mutex_;  // never taken by a thread that runs tasks: sinks have a thread of their own
  std::vector<Kept> kept_;
  std::vector<FeedEvent> events_;
  std::uint64_t thinned_ = 0, lost_events_ = 0;
};

/// The types of all that a run of the graph gives its sinks: its outputs by their index, then the true values of the
/// vehicle of each distributer, null where there is none.
std::vector<const Type*> types_of_run(const Graph& graph, const std::vector<const Type*>& true_types);

}  // namespace jarol::tools::console
