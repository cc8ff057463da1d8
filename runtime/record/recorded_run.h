// What a replay has from the recording of a run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/record/log.h"
#include "runtime/record/message_cursor.h"

namespace jarol {

/// How the run of a recording that is whole ended: of a large one only little is read. None: it is not whole, and has
/// to be gone through. Throws LogError.
std::optional<LogEnd> find_end(const Recording& recording);

/// What is missing on its way, by its index. Throws LogError.
std::vector<Gap> read_gaps(const Recording& recording);

class RecordedRun : public TakenValues {
 public:
  /// Looks at the whole recording. Throws LogError, "'path' ...", if it is none.
  explicit RecordedRun(std::string path);

  const Recording& recording() const { return *recording_; }
  const RecordingHeader& header() const { return recording_->header(); }
  const std::vector<RunningDigest>& digests() const { return digests_; }
  const std::vector<Gap>& gaps() const { return gaps_; }
  /// What came from outside.
  std::uint64_t values() const { return values_; }

  /// None: the run was killed, or could not write on, and how it ended is not known.
  const std::optional<LogEnd>& end() const { return end_; }
  /// The signal that ended the run on its way, as in "SIGINT ended the run"; empty: none did, or that is not known.
  const std::string& ended_by() const { return ended_by_; }
  /// From then on the vehicle was brought to rest; none: it was not, or that is not known.
  std::optional<Duration> rest_begun() const { return rest_begun_; }
  /// Its last part is good up to that byte.
  std::uint64_t good_until() const { return recording_->good_until(); }
  /// The instants before it can be replayed.
  Duration covered() const;

  /// The newest instant, none that is later, at which the run was saved on its way; none: there is no such.
  std::optional<Duration> saved_before(Duration instant) const;
  /// What it was at one of those instants. Throws LogError.
  std::string saved_at(Duration instant) const;

  /// The values are for that graph from now on, those of the instants from `from` on; returns the misses of its tasks.
  /// Throws LogError if the recording is of another graph.
  std::vector<Miss> begin(const Graph& graph, Duration from = {});

  bool take(Duration instant, std::size_t communicator, void* value) override;

  /// After the replay of all that is covered: throws LogError if a value of it was not taken.
  void require_all_taken() const;

 private:
  void keep(const mcap::Message& message, const ReadTopic& topic, const ChunkSpot& spot);
  void require_not_before(Duration instant) const;
  const std::string& name_of_next() const;
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_for_graph(const std::string& what) const;

  std::string path_;
  std::unique_ptr<Recording> recording_;
  std::optional<LogEnd> end_;
  std::string ended_by_;
  std::optional<Duration> rest_begun_;
  std::uint64_t values_ = 0;
  Duration last_value_{};     // its instant
  std::vector<Miss> misses_;  // by the header's tasks
  std::vector<RunningDigest> digests_;
  std::vector<Gap> gaps_;
  std::vector<Duration> saved_;
  const Graph* graph_ = nullptr;
  std::vector<std::size_t> communicators_;  // per channel
  std::optional<MessageCursor> next_;       // what was taken
};

}  // namespace jarol
