#include "tools/commands/check/measure_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <iostream>

#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "runtime/files/atomic_file.h"
#include "tools/commands/check/measure.h"

namespace jarol::tools {
namespace {

// How long to measure: --for, else the mission, else ten seconds.
Duration measured_time(const MeasureOptions& options, const Loaded& loaded) {
  if (options.duration) return *options.duration;
  Duration end{};
  for (const auto& channels : loaded.channels) end = std::max(end, channels->end().value_or(Duration{}));
  return end > Duration{} ? end : std::chrono::seconds(10);
}

void require_in_process(const Loaded& loaded) {
  if (const Distributer* distributer = find_in_real_time(loaded))
    throw InputError("distributer '" + distributer->name +
                     "' has a link to what goes on by itself, from which nothing comes while tasks are "
                     "measured; choose a link in process, as simulation or script");
}

// A task of the measured graph, and what goes for it in the file.
struct Row {
  std::string name;
  MeasuredTask measured;
  std::optional<Duration> stated;
  std::optional<Duration> written;
  bool kept = false;
};

std::string row_text(const Row& row, std::size_t width, bool write) {
  const auto text = [](const std::optional<Duration>& time) { return time ? duration_text(*time) : "-"; };
  const bool ran = row.measured.activations > 0;
  std::string line = fmt::format("  {:<{}}  {:>11}  {:>9}  {:>9}  {:>9}", row.name, width, row.measured.activations,
                                 ran ? duration_text(row.measured.max_of_999) : "-",
                                 ran ? duration_text(row.measured.max) : "-", text(row.stated));
  if (write) line += fmt::format("  {:>9}", row.kept ? "kept" : text(row.written));
  if (!ran) return line + "  never released in that time\n";
  return line + (row.stated && row.measured.max > *row.stated ? "  LONGER THAN ITS WCET\n" : "\n");
}

std::string table(const std::vector<Row>& rows, bool write) {
  std::size_t width = 4;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string text = fmt::format("  {:<{}}  {:>11}  {:>9}  {:>9}  {:>9}{}\n", "task", width, "activations", "99.9 %",
                                 "max", "wcet", write ? fmt::format("  {:>9}", "written") : "");
  for (const Row& row : rows) text += row_text(row, width, write);
  return text;
}

// What lengthens an activation once in a while: an interrupt, cold caches, a page. It hit some task while these were
// measured, and may hit any other the next time.
Duration longest_disturbance(const std::vector<Row>& rows) {
  Duration longest{};
  for (const Row& row : rows) longest = std::max(longest, row.measured.max - row.measured.max_of_999);
  return longest;
}

// A measurement that met no disturbance does not know how long one is, and what it writes must hold when the next one
// meets it: tasks of a microsecond were seen to take 40 us of processor time on a busy machine.
constexpr Duration min_disturbance = std::chrono::microseconds(100);

// Decides what is written for the tasks of the file as it stands, without overrides.
void choose_written(const Graph& in_file, const MeasureOptions& options, std::vector<Row>& rows) {
  const Duration met = longest_disturbance(rows), expected = std::max(met, min_disturbance);
  const auto wcet_with = [&](const Row& row, Duration disturbance) {
    return with_margin(std::max(row.measured.max, row.measured.max_of_999 + disturbance), options.margin / 100);
  };
  for (Row& row : rows) {
    const auto task =
        std::find_if(in_file.tasks.begin(), in_file.tasks.end(), [&](const Task& t) { return t.name == row.name; });
    row.stated = task == in_file.tasks.end() ? std::nullopt : task->wcet;
    if (task == in_file.tasks.end() || row.measured.activations == 0) continue;
    const Duration wcet = wcet_with(row, expected);
    // one that is stated need not have room for what was not met
    row.kept = row.stated && *row.stated >= wcet_with(row, met) && (!options.lower || *row.stated <= wcet);
    if (!row.kept) row.written = wcet;
  }
}

void write_wcets(const std::string& file, const std::shared_ptr<const Source>& source, const Overrides& overrides,
                 const Loaded& in_file, const std::vector<Row>& rows) {
  std::vector<std::optional<Duration>> wcets;
  for (const Task& task : in_file.graph->tasks) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == task.name; });
    wcets.push_back(row == rows.end() ? std::nullopt : row->written);
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
  require_in_process(loaded);
  const Duration end = measured_time(options, loaded);
  const auto source = options.write ? read_source(file) : nullptr;
  const Loaded in_file = options.write ? load_graph(source, without_changes(overrides)) : Loaded{};
  Measurement measurement = measure_tasks(loaded, end);
  const std::vector<MeasuredTask>& measured = measurement.tasks;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < measured.size(); ++i)
    rows.push_back({loaded.graph->tasks[i].name, measured[i], loaded.graph->tasks[i].wcet, std::nullopt});
  if (options.write) choose_written(*in_file.graph, options, rows);
  const auto any = [&](auto is) { return std::any_of(rows.begin(), rows.end(), is); };
  const bool writes = any([](const Row& row) { return row.written.has_value(); });
  const auto report = [&](bool written) {
    std::cerr << file << ": measured over " << duration_text(end)
              << " of logical time on this machine, in processor time\n"
              << table(rows, written) << measurement.faults;
    if (!measurement.faults.empty()) std::cerr << "  the times of faulty activations are among those above\n";
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
  if (any([](const Row& row) { return row.kept; }))
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
