// The sinks that get what a recorder's ring has: as values again, and in order of instants where that is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "graph/values/value.h"
#include "runtime/plan/output.h"
#include "runtime/record/lost_values.h"
#include "runtime/record/record_header.h"
#include "runtime/record/sink.h"
#include "runtime/record/sink_failures.h"

namespace jarol {

class FedSinks {
 public:
  /// The sinks and what they have thrown outlive it.
  FedSinks(std::vector<RecordSink*> sinks, SinkFailures& failures) : taking_(std::move(sinks)), failures_(failures) {}

  // Before the first value:

  void add(RecordSink* sink) { taking_.push_back(sink); }
  void expect(const std::vector<Output>& outputs);
  void put_in_order(Duration longest) { disorder_ = longest; }
  bool are_none() const { return taking_.empty(); }
  bool want(std::uint32_t output) const;

  // By the thread that drains the ring; one that fails takes no other with it:

  void take(const std::byte* records, std::size_t bytes);
  /// Nothing more comes; what they lack for ever.
  void finish(const LostValues& lost);

 private:
  void hold(const RecordHeader& header, const std::byte* packed);
  void hand_on_held(Duration until);
  void hand_on(const RecordHeader& header, const std::byte* packed);
  void hand_on_event(const RecordHeader& header, const std::byte* packed);
  template <class Call>
  void each_taking(const Call& call);
  [[gnu::cold]] void fail_all();
  const void* value_of(const RecordHeader& header, const std::byte* packed);

  std::vector<RecordSink*> taking_;  // those that have not failed
  SinkFailures& failures_;
  std::vector<Value> deep_values_;  // per output: what the sinks see, empty for flat ones
  struct Held {
    RecordHeader header;
    std::vector<std::byte> packed;
  };
  std::optional<Duration> disorder_;    // none: all comes in order
  std::multimap<Duration, Held> held_;  // by instant, then as they came
  Duration newest_{};                   // instant of a value held
};

}  // namespace jarol
