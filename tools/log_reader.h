// Reads the log of a run for a replay.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "runtime/log.h"
#include "tools/log_format.h"

namespace jarol::tools {

class LogReader : public TakenValues {
 public:
  /// Looks at the whole log. Throws LogError, "'path' ...", if it is none.
  explicit LogReader(std::string path);

  const LogHeader& header() const { return header_; }
  /// None: the run was killed, and how it ended is not known; the log is good up to a byte.
  const std::optional<LogEnd>& end() const { return end_; }
  std::int64_t breaks_off() const { return breaks_off_; }
  /// The instants before it are whole in the log.
  Duration covered() const { return covered_; }
  std::uint64_t values() const { return values_; }

  /// The values are for that graph from now on; returns the misses of its tasks. Throws LogError if the log is of
  /// another graph.
  std::vector<Miss> begin(const Graph& graph);

  bool take(Duration instant, std::size_t communicator, void* value) override;

  /// After the replay: throws LogError if a value before its end was not taken.
  void require_all_taken();

 private:
  bool next();
  [[noreturn]] void fail(const std::string& what) const;
  void throw_if_before(Duration instant) const;

  std::string path_;
  std::ifstream file_;
  std::streamoff first_ = 0;  // of the records
  std::streamoff good_until_ = 0;
  std::streamoff breaks_off_ = 0;
  LogHeader header_;
  std::optional<LogEnd> end_;
  Duration covered_{};
  std::uint64_t values_ = 0;
  std::vector<Miss> misses_;  // by the header's tasks
  const Graph* graph_ = nullptr;
  std::vector<std::size_t> communicators_;  // per input of the header
  LogRecord record_;                        // the one to come
  std::string bytes_;                       // its bytes
  bool has_record_ = false;
};

}  // namespace jarol::tools
