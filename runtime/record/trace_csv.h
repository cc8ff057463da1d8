// The trace as CSV: a row per instant, a column per published number.
#pragma once

#include <string>
#include <vector>

#include "graph/values/bind.h"
#include "runtime/files/atomic_file.h"
#include "runtime/plan/output.h"
#include "runtime/record/recorder.h"

namespace jarol {

struct TraceOptions {
  bool filled = false;  // a cell has what was published last
  bool words = false;   // a second row has the units; truth values and enumerators are words, not numbers
};

/// Columns: `time` (s, exact), then `task.output`, `task.output.field`, `communicator` or `communicator.field` in
/// bytewise order. An empty cell: not published at that instant, or, filled, never so far. The file appears when it is
/// whole.
class TraceCsv : public RecordSink {
 public:
  /// Throws std::runtime_error if the file can't be made.
  TraceCsv(std::string path, const std::vector<Output>& outputs, const TraceOptions& options = {});

  void take(Duration instant, std::uint32_t output, const void* value) override;
  void finish() override;

 private:
  void write_row();

  struct Target {
    Leaf leaf;
    std::size_t column = 0;
  };

  AtomicFile file_;
  std::vector<std::vector<Target>> targets_;  // per output
  std::vector<std::string> cells_;
  Duration instant_{};
  TraceOptions options_;
  bool pending_ = false;
  std::string row_;
};

}  // namespace jarol
