// Reads the log of a run for a replay.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "runtime/record/log.h"
#include "runtime/record/log_format.h"

namespace jarol {

class LogReader : public TakenValues {
 public:
  /// Looks at the whole log. Throws LogError, "'path' ...", if it is none.
  explicit LogReader(std::string path);

  const LogHeader& header() const { return header_; }
  const std::vector<Checkpoint>& checkpoints() const { return checkpoints_; }
  std::uint64_t values() const { return values_; }

  /// None: the run was killed, or could not write on, and how it ended is not known.
  const std::optional<LogEnd>& end() const { return end_; }
  /// From then on the vehicle was brought to rest; none: it was not, or that is not known.
  std::optional<Duration> rest_begun() const { return rest_begun_; }
  /// The log is good up to that byte.
  std::int64_t good_until() const { return good_until_; }
  /// The instants before it can be replayed.
  Duration covered() const;

  /// The values are for that graph from now on; returns the misses of its tasks. Throws LogError if the log is of
  /// another graph.
  std::vector<Miss> begin(const Graph& graph);

  bool take(Duration instant, std::size_t communicator, void* value) override;

  /// After the replay of all that is covered: throws LogError if a value of it was not taken.
  void require_all_taken() const;

 private:
  bool next();
  void keep();
  void require_nothing_more();
  void next_value();
  void require_not_before(Duration instant) const;
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_in_record(const std::string& what) const;
  [[noreturn]] void fail_for_graph(const std::string& what) const;

  std::string path_;
  std::ifstream file_;
  std::streamoff first_ = 0;  // of the records
  std::streamoff at_ = 0;     // of the record
  std::streamoff good_until_ = 0;
  LogHeader header_;
  std::optional<LogEnd> end_;
  std::optional<Duration> rest_begun_;
  std::uint64_t values_ = 0;
  std::int64_t last_value_ = 0;  // ns; its instant
  std::vector<Miss> misses_;     // by the header's tasks
  std::vector<Checkpoint> checkpoints_;
  const Graph* graph_ = nullptr;
  std::vector<std::size_t> communicators_;  // per input of the header
  LogRecord record_;                        // the one to come
  std::string bytes_;                       // its bytes
  bool has_record_ = false;
};

}  // namespace jarol
