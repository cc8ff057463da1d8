// What a vehicle's own decisions reported to the outside during a run, in words: that it lands, comes up, and why.
#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/archive.h"
#include "graph/values/bind.h"
#include "runtime/record/sink.h"

namespace jarol {

/// Notes when an enumeration of a value that goes out takes an enumerator that has a meaning, and what the enumerations
/// of that value become until it is left again.
class StatusEvents : public RecordSink {
 public:
  static constexpr std::size_t max_kept = 100;

  /// The graph outlives it.
  explicit StatusEvents(const Graph& graph);

  /// Some value that goes out has such an enumeration.
  bool can_be_any() const { return !watches_.empty(); }

  bool wants(std::uint32_t output) const override { return output < watch_of_.size() && watch_of_[output]; }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override {}

  /// What was noted so far, of the same graph, while nothing is handed on.
  void serialize(Archive& archive);

  /// What one enumeration of a value was then; `path` is empty where it is the value itself, `meaning` where the
  /// enumerator has none. All of a value's first event are `changed`.
  struct Stood {
    std::string path, name, meaning;
    bool changed = false;
  };
  struct Event {
    std::string communicator;
    Duration instant{};
    std::vector<Stood> values;  // all enumerations of that value
  };
  /// What was noted so far, in its order, and of which communicators how many events more there were than are kept.
  struct Kept {
    std::vector<Event> events;
    std::vector<std::pair<std::string, std::size_t>> more;
  };
  Kept kept() const;

 private:
  static constexpr std::size_t max_leaves = 8;
  using Numbers = std::array<std::int64_t, max_leaves>;

  struct Change {
    Duration instant{};
    std::size_t watch = 0;
    Numbers before{}, after{};
    void serialize(Archive& archive) { archive(instant, watch, before, after); }
  };
  // An `out` communicator whose value has such an enumeration.
  struct Watch {
    std::size_t communicator = 0;
    std::vector<Leaf> leaves;  // its enumerations
    bool begun = false;
    Numbers now{};          // once it has begun
    std::size_t count = 0;  // of changes; the first are kept
    std::vector<Change> kept;
    void note(Duration instant, std::size_t watch, const void* value);
  };
  std::vector<Change> in_order() const;

  const Graph& graph_;
  std::vector<Watch> watches_;
  std::vector<std::optional<std::size_t>> watch_of_;  // per output
  mutable std::mutex mutex_;                          // of a run that has not ended, too, there is a report
};

}  // namespace jarol
