#include "tools/run/run_files.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "graph/language/problems.h"
#include "runtime/files/whole_file.h"
#include "runtime/record/trace_csv.h"
#include "tools/report/command_line.h"
#include "tools/report/commanded.h"

namespace jarol::tools {
namespace {

constexpr char of_stdout[] = "/dev/stdout";

std::string path_of(const std::string& name) { return name == "-" ? of_stdout : name; }

Panel panel_of(const Output& output, std::uint32_t index, const Leaf& leaf) {
  return {leaf.path.empty() ? output.name : output.name + "." + leaf.path, leaf.unit, index, leaf, std::nullopt};
}

// A panel for each number that is published, in order of name.
std::vector<Panel> all_panels(const std::vector<Output>& outputs) {
  std::vector<Panel> panels;
  for (std::uint32_t i = 0; i < outputs.size(); ++i)
    for (const Leaf& leaf : leaves_of(*outputs[i].type))
      if (!leaf.type->is_deep()) panels.push_back(panel_of(outputs[i], i, leaf));
  return panels;
}

// Those whose names fit one of the patterns, each once.
std::vector<Panel> panels_named(const std::string& patterns, const std::vector<Output>& outputs) {
  constexpr std::size_t most = 40;
  const std::vector<Panel> all = all_panels(outputs);
  std::vector<bool> taken(all.size());
  std::vector<Panel> panels;
  std::istringstream words(patterns);
  for (std::string word; std::getline(words, word, ',');) {
    if (word.empty())
      throw std::invalid_argument("--signals: '" + patterns + "' has an empty name; write them as in depth.*,fins.*");
    bool fits = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (fnmatch(word.c_str(), all[i].title.c_str(), 0) != 0) continue;
      fits = true;
      if (!taken[i]) panels.push_back(all[i]);
      taken[i] = true;
    }
    if (fits) continue;
    std::vector<std::string> names;
    for (const Panel& panel : all) names.push_back(panel.title);
    throw std::invalid_argument("--signals: nothing that is published has the name '" + word + "'" +
                                did_you_mean(word, names) + "; there are: " + list_of(names));
  }
  if (panels.size() > most)
    throw std::invalid_argument("--signals: '" + patterns + "' names " + std::to_string(panels.size()) +
                                " fields, more than the " + std::to_string(most) +
                                " that a picture has room for; name fewer");
  return panels;
}

// A name that promises another kind of picture.
void require_svg(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  if (!extension.empty() && extension != ".svg")
    throw std::invalid_argument("--plot: '" + path + "' would hold an SVG picture; name it " +
                                std::filesystem::path(path).replace_extension(".svg").string());
}

std::vector<Panel> panels_of(const Graph& graph, const std::vector<Output>& outputs) {
  const auto output_of = [&](std::size_t communicator) {
    const std::string& name = graph.communicators[communicator].name;
    const auto at = std::lower_bound(outputs.begin(), outputs.end(), name,
                                     [](const Output& o, const std::string& n) { return o.name < n; });
    return static_cast<std::uint32_t>(at - outputs.begin());
  };
  std::vector<Panel> panels;
  for (const Reported& r : find_reported(graph)) {
    Panel panel{r.title, r.leaf.unit, output_of(r.communicator), r.leaf, std::nullopt};
    if (r.command) panel.commanded = std::pair(output_of(r.command->communicator), r.command->leaf);
    panels.push_back(std::move(panel));
  }
  if (panels.empty()) {
    std::cerr
        << "note: no 'out' communicator of an operator reports what one of its 'in' communicators commands, so the "
           "picture shows what is published first; name fields by --signals\n";
    panels = all_panels(outputs);
  }
  constexpr std::size_t most = 8;
  if (panels.size() > most) panels.resize(most);
  return panels;
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

RunFiles::RunFiles(const Graph& graph, const RunFileArguments& arguments) {
  if (!arguments.signals.empty() && arguments.plot.empty())
    throw std::invalid_argument("--signals says what --plot draws; add --plot FILE, or leave it out");
  for (const auto& [given, name] : {std::pair(arguments.fill, "--trace-fill"), {arguments.words, "--trace-words"}})
    if (given && arguments.trace.empty())
      throw std::invalid_argument(std::string(name) + " is about --trace; add --trace FILE, or leave it out");
  if (arguments.trace.empty() && arguments.plot.empty()) return;
  const std::string trace = path_of(arguments.trace), plot = path_of(arguments.plot);
  for (const std::string& path : {trace, plot})
    if (!path.empty()) require_no_input(path);
  require_svg(plot);
  const std::vector<Output> outputs = outputs_of(graph);
  if (!trace.empty())
    sinks_.push_back(
        std::make_unique<TraceCsv>(trace, outputs, TraceOptions{.filled = arguments.fill, .words = arguments.words}));
  if (plot.empty()) return;
  auto picture = std::make_unique<PlotSvg>(
      plot, graph.name,
      arguments.signals.empty() ? panels_of(graph, outputs) : panels_named(arguments.signals, outputs));
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
