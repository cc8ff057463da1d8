// What one run publishes, kept in memory, and another run compared with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/plan/output.h"
#include "runtime/record/cdr.h"
#include "runtime/record/differences.h"
#include "runtime/record/sink.h"

namespace jarol {

/// All that a run publishes from an instant on.
class KeptValues : public RecordSink {
 public:
  KeptValues(std::vector<Output> outputs, Duration from);

  bool wants(std::uint32_t output) const override { return output < lanes_.size(); }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override {}

 private:
  friend class ComparedValues;

  struct Lane {
    std::string name;
    CdrEncoder encoder;
    MessageLayout layout;
  };
  struct Published {
    Duration instant{};
    std::uint32_t output = 0;
    std::size_t begin = 0, size = 0;  // of its bytes
  };
  void append(Duration instant, std::uint32_t output, const void* value, std::vector<Published>& published,
              std::string& bytes) const;

  std::vector<Lane> lanes_;  // per output
  Duration from_;
  std::vector<Published> published_;  // in order of instants
  std::string bytes_;
};

/// Compares what another run of the same outputs publishes with that; it has to be complete by then.
class ComparedValues : public RecordSink {
 public:
  /// `run` outlives it; what that published before `from` is left out.
  ComparedValues(const KeptValues& run, Duration from);

  bool wants(std::uint32_t output) const override { return run_.wants(output); }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override { compare_before(Duration::max()); }

  /// After `finish`.
  const Differences& differences() const { return differences_; }

 private:
  using Published = KeptValues::Published;
  void compare_before(Duration end);
  void compare_instant(Duration instant);
  std::vector<Published> next_of_run(Duration instant);

  const KeptValues& run_;
  std::size_t next_ = 0;              // of the run
  std::vector<Published> published_;  // at one instant
  std::string bytes_;                 // of these
  Differences differences_;
};

}  // namespace jarol
