#include "tools/commands/check/measure_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <iostream>

#include "graph/language/quantities.h"
#include "graph/model/with_wcets.h"
#include "runtime/files/atomic_file.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/load_graph.h"
#include "tools/report/fault_report.h"

namespace jarol::tools {
namespace {

// A task of the measured graph, and what goes for it in the file.
struct Row {
  std::string name;
  MeasuredTask measured;
  ChosenWcet wcet;
};

std::string row_text(const Row& row, std::size_t width, bool write) {
  const auto text = [](const std::optional<Duration>& time) { return time ? duration_text(*time) : "-"; };
  const bool ran = row.measured.activations > 0;
  std::string line = fmt::format("  {:<{}}  {:>11}  {:>9}  {:>9}  {:>9}", row.name, width, row.measured.activations,
                                 ran ? duration_text(row.measured.max_of_999) : "-",
                                 ran ? duration_text(row.measured.max) : "-", text(row.wcet.stated));
  if (write) line += fmt::format("  {:>9}", row.wcet.kept ? "kept" : text(row.wcet.written));
  if (!ran) return line + "  never released in that time\n";
  return line + (row.wcet.stated && row.measured.max > *row.wcet.stated ? "  LONGER THAN ITS WCET\n" : "\n");
}

std::string table(const std::vector<Row>& rows, bool write) {
  std::size_t width = 4;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string text = fmt::format("  {:<{}}  {:>11}  {:>9}  {:>9}  {:>9}{}\n", "task", width, "activations", "99.9 %",
                                 "max", "wcet", write ? fmt::format("  {:>9}", "written") : "");
  for (const Row& row : rows) text += row_text(row, width, write);
  return text;
}

void write_wcets(const std::string& file, const std::shared_ptr<const Source>& source, const Overrides& overrides,
                 const Loaded& in_file, const std::vector<Row>& rows) {
  std::vector<std::optional<Duration>> wcets;
  for (const Task& task : in_file.graph->tasks) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == task.name; });
    wcets.push_back(row == rows.end() ? std::nullopt : row->wcet.written);
  }
  const std::string edited = with_wcets(source->text, in_file.spec, *in_file.graph, wcets);
  if (read_source(file)->text != source->text)
    throw InputError("'" + file + "' was changed while it was measured; nothing is written, measure again");
  load_graph(std::make_shared<Source>(Source{file, edited}), overrides);
  AtomicFile whole(file, Replaces::all);
  whole.write(edited);
  whole.commit();
}

}  // namespace

Measurement measure_file(const std::string& file, const Overrides& overrides, const MeasureOptions& options) {
  Loaded loaded = load_graph(file, overrides);
  const auto source = options.write ? read_source(file) : nullptr;
  const Loaded in_file = options.write ? load_graph(source, without_changes(overrides)) : Loaded{};
  const Graph& graph = *loaded.graph;
  const Measurement measurement = [&] {
    const CrashLine crash_line(graph);
    return measure_tasks(loaded, options.duration);
  }();
  std::vector<Row> rows;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    rows.push_back({graph.tasks[i].name, measurement.tasks[i], {graph.tasks[i].wcet, {}}});
  if (options.write) {
    const auto wcets = choose_wcets(graph, measurement, *in_file.graph, options.margin / 100, options.lower);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].wcet = wcets[i];
  }
  const std::string faults = fault_report(measurement.report);
  const auto any = [&](auto is) { return std::any_of(rows.begin(), rows.end(), is); };
  const bool writes = any([](const Row& row) { return row.wcet.written.has_value(); });
  const auto report = [&](bool written) {
    std::cerr << file << ": measured over " << duration_text(measurement.over)
              << " of logical time on this machine, in processor time\n"
              << table(rows, written) << faults;
    if (!faults.empty()) std::cerr << "  the times of faulty activations are among those above\n";
  };
  try {
    if (writes) write_wcets(file, source, without_changes(overrides), in_file, rows);
  } catch (...) {
    // what was measured is worth its time, also where it can't be written
    report(false);
    throw;
  }
  report(options.write);
  if (!options.write) return measurement;
  std::cerr << (writes ? fmt::format(
                             "  written into {}: 99.9 % and the longest disturbance of any task, but no less than {}, "
                             "with {:g} % on top\n",
                             file, duration_text(min_disturbance), options.margin)
                       : fmt::format("  nothing is written into {}\n", file));
  if (any([](const Row& row) { return row.wcet.kept; }))
    std::cerr << (options.lower
                      ? fmt::format("  a 'wcet' was kept that leaves no more than the margin over a disturbance "
                                    "of {}\n",
                                    duration_text(min_disturbance))
                      : "  a 'wcet' that is no shorter than that was kept; --lower lowers it\n");
  if (!overrides.set.empty() || !overrides.profile.empty())
    std::cerr << "  measured with --set or --profile; what follows is said of the file as it stands, without them\n";
  return measurement;
}

}  // namespace jarol::tools
