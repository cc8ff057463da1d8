// What a replay publishes, beside what the recording of the run has of it.
#pragma once

#include <string>
#include <vector>

#include "runtime/record/cdr.h"
#include "runtime/record/differences.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/sink.h"

namespace jarol {

class ReplayedValues : public RecordSink {
 public:
  /// The run outlives it. `outputs`: those of the graph that is replayed; `only`: names of those that are compared,
  /// null: all; the instants from `from` on.
  ReplayedValues(const RecordedRun& run, const std::vector<Output>& outputs,
                 const std::vector<std::string>* only = nullptr, Duration from = {});

  /// False: the recording has nothing that could be compared.
  bool has_any() const { return has_any_; }
  const Differences& differences() const { return differences_; }

  bool wants(std::uint32_t output) const override { return output < lanes_.size() && lanes_[output].layout; }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override;

 private:
  struct Lane {
    std::string name;
    CdrEncoder encoder;
    std::optional<MessageLayout> layout{};  // none: it is not compared
  };
  struct Published {
    std::size_t lane = 0;
    std::string bytes;
  };
  void compare_until(Duration end);
  void compare_instant(Duration instant, std::vector<Published>& is);
  bool may_lack(Duration instant) const;

  const RecordedRun& run_;
  std::vector<Lane> lanes_;           // per output
  std::vector<std::size_t> lane_of_;  // per channel
  std::optional<MessageCursor> recorded_;
  Duration end_{};  // the instants before it stand in the recording
  bool has_any_ = false;
  Duration instant_{};
  std::vector<Published> published_;  // at that instant
  Differences differences_;
};

}  // namespace jarol
