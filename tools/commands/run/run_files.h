// The files that a run writes as it goes: its trace and its picture.
#pragma once

#include <memory>
#include <streambuf>
#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/record/recorder.h"
#include "tools/drawing/plot/plot_svg.h"

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
  /// `note`: how the run differs from others of its graph; `truths`: by distributer the type of what is known of its
  /// vehicle, or null. Throws std::runtime_error if one can't be made, InputError if it can't hold what is
  /// asked for.
  RunFiles(const Graph& graph, const RunFileArguments& arguments, std::string note,
           const std::vector<const Type*>& truths);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  std::vector<RecordSink*> sinks() const;
  /// The picture shows true values beside what is published.
  bool shows_truth() const { return shows_truth_; }
  /// Lines of another run in the picture; null: there is none.
  std::unique_ptr<RecordSink> beside(const std::string& name);

 private:
  std::vector<std::unique_ptr<RecordSink>> sinks_;
  PlotSvg* plot_ = nullptr;  // among them
  bool shows_truth_ = false;
};

}  // namespace jarol::tools
