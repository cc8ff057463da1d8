#include "tools/run/run_files.h"

#include <algorithm>

#include "tools/files/trace_csv.h"
#include "tools/files/whole_file.h"
#include "tools/plot/plot_svg.h"
#include "tools/report/command_line.h"
#include "tools/report/commanded.h"

namespace jarol::tools {
namespace {

std::vector<Panel> panels_of(const Graph& graph, const Plan& plan) {
  const auto output_of = [&](std::size_t communicator) {
    const std::string& name = graph.communicators[communicator].name;
    const auto at = std::lower_bound(plan.outputs.begin(), plan.outputs.end(), name,
                                     [](const Output& o, const std::string& n) { return o.name < n; });
    return static_cast<std::uint32_t>(at - plan.outputs.begin());
  };
  std::vector<Panel> panels;
  for (const Reported& r : find_reported(graph)) {
    Panel panel{r.title, r.leaf.unit, output_of(r.communicator), r.leaf, std::nullopt};
    if (r.command) panel.commanded = std::pair(output_of(r.command->communicator), r.command->leaf);
    panels.push_back(std::move(panel));
  }
  // no operator: the first outputs, as many as fit
  constexpr std::size_t most = 8;
  for (std::uint32_t i = 0; panels.empty() && i < plan.outputs.size(); ++i)
    for (const Leaf& leaf : leaves_of(*plan.outputs[i].type))
      if (!leaf.type->is_deep())
        panels.push_back({leaf.path.empty() ? plan.outputs[i].name : plan.outputs[i].name + "." + leaf.path, leaf.unit,
                          i, leaf, std::nullopt});
  if (panels.size() > most) panels.resize(most);
  return panels;
}

}  // namespace

void add_run_file_options(Command& command, RunFileArguments& arguments) {
  command.add_option("--trace", arguments.trace, "Write every published value to this CSV file");
  command.add_option("--plot", arguments.plot, "Draw what was commanded and reached into this SVG file");
}

std::string to_text(const RunFileArguments& arguments) {
  return (arguments.trace.empty() ? "" : "  trace       " + arguments.trace + "\n") +
         (arguments.plot.empty() ? "" : "  picture     " + arguments.plot + "\n");
}

// The plan gives trace and plot their outputs before there is an executor.
RunFiles::RunFiles(const Graph& graph, const RunFileArguments& arguments) {
  if (arguments.trace.empty() && arguments.plot.empty() && graph.expectations.empty()) return;
  for (const std::string& path : {arguments.trace, arguments.plot})
    if (!path.empty()) require_no_input(path);
  const Plan plan(graph);
  if (!arguments.trace.empty()) sinks_.push_back(std::make_unique<TraceCsv>(arguments.trace, plan.outputs));
  if (!arguments.plot.empty())
    sinks_.push_back(std::make_unique<PlotSvg>(arguments.plot, graph.name, panels_of(graph, plan)));
  std::vector<RecordSink*> sinks;
  if (!graph.expectations.empty()) sinks.push_back(&expectations_.emplace(graph, plan.outputs));
  for (const auto& sink : sinks_) sinks.push_back(sink.get());
  recorder_ = std::make_unique<Recorder>(std::move(sinks));
}

RunFiles::~RunFiles() = default;

void RunFiles::close() {
  if (recorder_) recorder_->close();
}

std::vector<Verdict> RunFiles::judge(Duration end, const std::string& cut_short) const {
  return expectations_ ? expectations_->judge(end, cut_short) : std::vector<Verdict>();
}

}  // namespace jarol::tools
