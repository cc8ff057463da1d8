// What a run publishes, on its way to whoever watches: bounded, thinned evenly where it comes faster than it is taken,
// and what was left out is counted.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/value.h"
#include "runtime/record/sink.h"

namespace jarol::tools::console {

/// Values of one output in the order of their instants.
struct Samples {
  std::vector<Duration> instants;
  std::vector<Value> values;  // one for each instant; those beyond are memory for more
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

  /// What came since it was asked last, up to the last pause. For one thread that watches; what is returned stays as it
  /// is until that asks again.
  const Batch& take_batch();

  bool wants(std::uint32_t output) const override { return output < types_.size(); }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void take_event(const RunEvent& event) override;
  void pause() override;
  void finish() override { pause(); }

  static constexpr std::size_t max_events = 1000;

 private:
  // Of the samples that come every `stride`th is kept, and the newest, which the next one replaces unless it is one of
  // these.
  struct Kept {
    std::uint64_t stride = 1, seen = 0;
    bool newest_only = false;  // the last of them is there as the newest
    bool counts() const { return seen % stride == 0; }
  };
  void thin(Samples& samples, Kept& kept);
  void begin();
  Batch& filling();

  const std::vector<const Type*> types_;
  const std::size_t most_;
  const std::vector<std::uint64_t> strides_;
  std::vector<Kept> kept_;  // per output, of what is being filled

  // Two batches go to and fro, and neither side ever waits for the other: where the one that watches has not come for
  // what is ready, it is filled on. Memory is had on the recorder's thread alone, so that it shares no lock of the
  // allocator's either, and is kept for what comes next.
  std::array<Batch, 2> batches_;
  Batch* filling_ = nullptr;  // the recorder's
  Batch* taken_ = nullptr;    // of the thread that watches
  std::atomic<Batch*> ready_{nullptr}, spare_{nullptr};
  const Batch none_{};
};

/// The types of all that a run of the graph gives its sinks: its outputs by their index, then the true values of the
/// vehicle of each distributer, null where there is none.
std::vector<const Type*> types_of_run(const Graph& graph, const std::vector<const Type*>& true_types);

}  // namespace jarol::tools::console
