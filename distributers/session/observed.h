// What a run has published, by name: the last value of each output, and those that are watched with their instants.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/value.h"
#include "runtime/plan/output.h"
#include "runtime/record/recorder.h"

namespace jarol {

/// A value, or a field within it, and where it lies in the value of its output.
struct Place {
  std::size_t output = 0;
  std::size_t offset = 0;
  const Type* type = nullptr;
};

/// Called by its recorder; asked while that has nothing to hand on.
class Observed : public RecordSink {
 public:
  /// `outputs`: those of the graph's plan.
  Observed(const Graph& graph, std::vector<Output> outputs);

  /// "task.output", "communicator", or a field of one, as in "depth.moment.z". Throws UnknownName, or WrongType where
  /// it is not of the type.
  Place find(std::string_view name, const Type& type) const;
  /// As last published, or what it reads as until then.
  const void* last(const Place& place) const;

  /// From now on every publication of the outputs whose names fit, with * for any part, is kept. Throws UnknownName if
  /// none does.
  void watch(const std::string& pattern);
  /// Those of an output that is watched, with their instants. Throws NotWatched.
  const std::deque<std::pair<Duration, Value>>& series(const Place& place) const;

  /// The last values; what was kept of those that are watched is gone when they are restored.
  void serialize(Archive& archive);
  /// They are not known, as the run goes on from a checkpoint that does not have them.
  void forget();

  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override {}

 private:
  struct Series {
    bool watched = false;
    std::deque<std::pair<Duration, Value>> values;
  };
  std::vector<Output> outputs_;
  std::vector<Value> last_;  // per output
  std::vector<bool> forgotten_;
  std::vector<Series> series_;
};

}  // namespace jarol
