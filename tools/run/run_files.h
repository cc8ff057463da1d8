// Who looks on at a run: its trace, its picture, and what the graph expects of it.
#pragma once

#include <memory>
#include <streambuf>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/execute/expectations.h"
#include "runtime/record/recorder.h"

namespace jarol::tools {

class Command;

struct RunFileArguments {
  std::string trace, plot;  // "-": stdout
  bool fill = false;        // the trace
  bool words = false;       // in the trace
  std::string signals;      // of the plot
};

void add_run_file_options(Command& command, RunFileArguments& arguments);

/// Lines of a report that name what was written.
std::string to_text(const RunFileArguments& arguments);

/// Where a file goes to stdout, what is said goes to stderr while this lives.
class ReportsAside {
 public:
  explicit ReportsAside(const RunFileArguments& arguments);
  ~ReportsAside();
  ReportsAside(const ReportsAside&) = delete;
  ReportsAside& operator=(const ReportsAside&) = delete;

 private:
  std::streambuf* stdout_ = nullptr;
};

class RunFiles {
 public:
  /// Throws std::runtime_error if one can't be made, std::invalid_argument if it can't hold what is asked for.
  RunFiles(const Graph& graph, const RunFileArguments& arguments);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  /// Null if nobody looks on.
  Recorder* recorder() { return recorder_.get(); }

  /// Writes all that is left. Throws std::runtime_error if something could not be written.
  void close();

  /// What is published from that instant on is not judged.
  void judge_before(Duration instant) {
    if (expectations_) expectations_->judge_before(instant);
  }
  /// After `close`, of a run that covered the instants before `end`. `cut_short`: why it ended before what it was meant
  /// to do; else empty.
  std::vector<Verdict> judge(Duration end, const std::string& cut_short) const;

 private:
  std::optional<Expectations> expectations_;
  std::vector<std::unique_ptr<RecordSink>> sinks_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace jarol::tools
