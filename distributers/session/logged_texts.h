// What tasks logged during a run: the texts of their outputs of type String.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/archive.h"
#include "runtime/record/sink.h"

namespace jarol {

/// Notes when such an output becomes another text; none where it becomes empty.
class LoggedTexts : public RecordSink {
 public:
  static constexpr std::size_t max_kept = 100;

  explicit LoggedTexts(const Graph& graph);

  /// Some task has such an output.
  bool can_be_any() const { return !outputs_.empty(); }

  bool wants(std::uint32_t output) const override { return find(output) != nullptr; }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override {}

  /// What was noted so far, of the same graph, while nothing is handed on.
  void serialize(Archive& archive);

  struct Text {
    Duration instant{};
    std::string output, text;
    void serialize(Archive& archive) { archive(instant, output, text); }
  };
  /// What was noted so far, by instant, texts of one by output, and of which outputs how many texts more there were
  /// than are kept.
  struct Kept {
    std::vector<Text> texts;
    std::vector<std::pair<std::string, std::size_t>> more;
  };
  Kept kept() const;

 private:
  struct Output {
    std::uint32_t index = 0;
    std::string name;
    std::string last{};
    std::size_t count = 0;  // of texts; the first are kept
  };

  const Output* find(std::uint32_t index) const;

  std::vector<Output> outputs_;  // by index
  std::vector<Text> kept_;       // by instant, those of one by output
  mutable std::mutex mutex_;     // of a run that has not ended, too, there is a report
};

}  // namespace jarol
