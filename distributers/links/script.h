// The link that plays time-stamped rows of a CSV: the operator of a run that nobody steers.
#pragma once

#include <memory>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/external_system.h"

namespace jarol::distributers {

struct LinkType;

/// The link type `script`.
LinkType script_link();

/// Columns: `time` (s), then `channel.field` of the distributer's `in` channels. A row holds until the next, an empty
/// cell keeps what was. The mission ends at the time of the last row. What it is to reach stands above, as `expect:`.
class ScriptSystem : public ExternalSystem {
 public:
  /// Reads the rows; what is wrong goes to `problems` with file, line and column.
  ScriptSystem(const std::shared_ptr<const Source>& script, const DistributerClass& distributer, Problems& problems);

  void reach(Duration instant) override;
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t, const void*) override {}
  void serialize(Archive& archive) override;
  std::optional<Duration> end() const override { return end_; }
  std::span<const Yaml> expectations() const override { return expectations_; }

 private:
  struct Row {
    Duration time{};
    std::vector<std::pair<std::size_t, Value>> values;  // channel and its value from here on
  };
  struct Playing {
    const void* value = nullptr;
    bool fresh = false;
  };

  void play_next();

  std::vector<Row> rows_;
  std::size_t next_ = 0;
  std::vector<Playing> playing_;  // per channel
  const DistributerClass& distributer_;
  Duration end_{};
  std::vector<Yaml> expectations_;
};

}  // namespace jarol::distributers
