#include "tools/commands/run/run_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "graph/text/errors.h"
#include "runtime/files/atomic_file.h"
#include "runtime/record/trace_csv.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/panels.h"
#include "tools/report/command_line.h"

namespace jarol::tools {
namespace {

constexpr char of_stdout[] = "/dev/stdout";

std::string path_of(const std::string& name) {
  if (name != "-") return name;
  // one that was closed is open for reading: nothing else takes its place
  if ((::fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY)
    throw InputError("'-' is stdout, which is closed; name a file, or open it");
  return of_stdout;
}

}  // namespace

void add_run_file_options(Command& command, RunFileArguments& arguments) {
  command.add_option("--trace", arguments.trace, "Write every published value to this CSV file; -: to stdout")
      ->file({"csv"});
  command.add_flag("--trace-fill", arguments.fill,
                   "Repeat in each row of the trace what was published last, in place of empty cells");
  command.add_flag(
      "--trace-words", arguments.words,
      "In the trace a second row with the units, and words for truth values and enumerators, as in 'landing'");
  command.add_option("--plot", arguments.plot, "Draw what was commanded and reached into this SVG file; -: to stdout")
      ->file({"svg"});
  command.add_option("--signals", arguments.signals,
                     "Draw these published fields instead: names with * for any part, as in depth.*,fins.*");
}

std::string to_text(const RunFileArguments& arguments) {
  const auto line = [](const std::string& title, const std::string& path) {
    return path.empty() ? "" : title + (path == "-" ? "stdout" : path) + "\n";
  };
  return line("  trace       ", arguments.trace) + line("  picture     ", arguments.plot);
}

ReportsAside::ReportsAside(const RunFileArguments& arguments) {
  if (arguments.trace == "-" || arguments.plot == "-") stdout_ = std::cout.rdbuf(std::cerr.rdbuf());
}

ReportsAside::~ReportsAside() {
  if (stdout_ != nullptr) std::cout.rdbuf(stdout_);
}

RunFiles::RunFiles(const Graph& graph, const RunFileArguments& arguments, std::string note,
                   const std::vector<const Type*>& truths) {
  if (!arguments.signals.empty() && arguments.plot.empty())
    throw InputError("--signals says what --plot draws; add --plot FILE, or leave it out");
  for (const auto& [given, name] : {std::pair(arguments.fill, "--trace-fill"), {arguments.words, "--trace-words"}})
    if (given && arguments.trace.empty())
      throw InputError(std::string(name) + " is about --trace; add --trace FILE, or leave it out");
  if (arguments.trace.empty() && arguments.plot.empty()) return;
  const std::string trace = path_of(arguments.trace), plot = path_of(arguments.plot);
  for (const std::string& path : {trace, plot})
    if (!path.empty()) require_no_input(path);
  require_extension({"--plot", plot}, ".svg", "an SVG picture");
  const std::vector<Output> outputs = outputs_of(graph);
  if (!trace.empty())
    sinks_.push_back(
        std::make_unique<TraceCsv>(trace, outputs, TraceOptions{.filled = arguments.fill, .words = arguments.words}));
  if (plot.empty()) return;
  Picture shown = arguments.signals.empty() ? picture_of(graph, outputs, truths)
                                            : Picture{panels_named(arguments.signals, outputs), {}};
  shown.extras.note = std::move(note);
  shows_truth_ = shown.extras.true_path.has_value() || std::any_of(shown.panels.begin(), shown.panels.end(),
                                                                   [](const Panel& p) { return p.truth.has_value(); });
  auto picture = std::make_unique<PlotSvg>(plot, graph.name, std::move(shown.panels), std::move(shown.extras));
  plot_ = picture.get();
  sinks_.push_back(std::move(picture));
}

std::unique_ptr<RecordSink> RunFiles::beside(const std::string& name) {
  return plot_ != nullptr ? plot_->beside(name) : nullptr;
}

RunFiles::~RunFiles() = default;

std::vector<RecordSink*> RunFiles::sinks() const {
  std::vector<RecordSink*> sinks;
  for (const auto& sink : sinks_) sinks.push_back(sink.get());
  return sinks;
}

}  // namespace jarol::tools
