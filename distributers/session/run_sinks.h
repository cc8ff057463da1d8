// Who looks on at a run: what its graph expects, what is measured of it, and whatever sinks it is given; without any,
// nothing is recorded.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/execute/expectations.h"
#include "runtime/record/recorder.h"

namespace jarol {

class RunSinks {
 public:
  /// The sinks, the graph and what is measured outlive it; `hand_on_period`: see Recorder.
  RunSinks(const Graph& graph, std::vector<RecordSink*> sinks, std::span<const expect::Condition> measured = {},
           Duration hand_on_period = std::chrono::seconds(1));

  /// For ExecutorOptions; null if nobody looks on.
  Recorder* recorder() { return recorder_.get(); }

  /// What is published from that instant on is not judged. Any thread.
  void judge_before(Duration instant) {
    if (expectations_) expectations_->judge_before(instant);
  }
  /// The sinks have got all that was published so far, but for those that have failed.
  void catch_up();
  /// What the conditions of the graph know, while nothing is handed on.
  void serialize(Archive& archive) {
    if (expectations_) archive(*expectations_);
    if (measured_) archive(*measured_);
  }
  /// What is no publication, once the run is over.
  void show(const RunEvent& event) {
    if (recorder_) recorder_->append_event(event);
  }
  /// The first that was published and no sink has got, and why; empty: there is none.
  const std::string& lost() const;
  /// Throws the first that a sink has thrown by then. After `catch_up`.
  void rethrow_failure() const;
  /// They have got all, but for those that have failed: throws what these threw.
  void close();
  /// What a sink has thrown; empty: nothing. After `catch_up` or `close`.
  std::string failure_of(const RecordSink& sink) const;
  /// The same of the conditions that are looked at.
  std::string failure_of_conditions() const;
  /// Why a sink has not got all; empty: it has. After `close`.
  std::string why_not_all(const RecordSink& sink) const;
  /// After `close`, of a run that covered the instants before `end`. `cut_short`: why it ended before what it was meant
  /// to do; else empty.
  std::vector<Verdict> judge(Duration end, const std::string& cut_short) const;
  /// The same of what is measured.
  std::vector<Verdict> measure(Duration end, const std::string& cut_short) const;

 private:
  std::vector<Verdict> judge_by(const std::optional<Expectations>& conditions, Duration end,
                                const std::string& cut_short) const;

  std::optional<Expectations> expectations_, measured_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace jarol
