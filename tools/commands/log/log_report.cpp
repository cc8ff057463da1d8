// A recording as a page for people: one HTML file.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "distributers/session/replay_start.h"
#include "graph/language/problems.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "graph/text/shell_word.h"
#include "runtime/files/atomic_file.h"
#include "tools/commands/campaign/repeat.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/log_commands.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/commands/log/report_graph.h"
#include "tools/commands/log/report_replay.h"
#include "tools/commands/log/report_signals.h"
#include "tools/commands/run/apart.h"
#include "tools/drawing/graph/drawing_json.h"
#include "tools/drawing/graph/layout.h"
#include "tools/drawing/pages/page.h"
#include "tools/report/exit_code.h"
#include "tools/report/tracking.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

// As people call a file from where they are.
std::string near_path(const std::string& path) {
  if (path == "-") return path;
  const std::string near = std::filesystem::path(path).lexically_proximate(std::filesystem::current_path());
  return near.starts_with("..") ? path : near;
}

std::string run_command(const RecordedRun& run) {
  const RecordingHeader& header = run.header();
  const bool to_its_end = header.until == header.mission || header.until >= longest_duration;
  std::optional<Duration> length = to_its_end ? std::nullopt : std::optional(header.until);
  if (run.end() && !run.ended_by().empty()) length = run.rest_begun().value_or(run.covered());
  std::string command = repeat_command(near_path(header.file), header.overrides, length,
                                       {.index = 0, .values = {}, .set = {}, .seed = header.seed});
  const bool is_file = header.execution.starts_with('/');
  if (!header.execution.empty())
    command += " --execution " + shell_word(is_file ? near_path(header.execution) : header.execution);
  return command;
}

Json summary_json(const RecordedRun& run, const std::string& file) {
  const RecordingHeader& header = run.header();
  Json files = Json::array();
  for (const RecordedFile& read : run.recording().files()) files.push_back(near_path(read.path));
  Json json{{"graph", header.graph},
            {"recording", file},
            {"bytes", run.recording().size()},
            {"what", header.what},
            {"file", near_path(header.file)},
            {"files", std::move(files)},
            {"profile", header.overrides.profile},
            {"set", header.overrides.set},
            {"seed", header.seed},
            {"clock", header.clock},
            {"version", header.version.substr(0, header.version.find('\n'))},
            {"platform", header.platform},
            {"covered_ns", run.covered().count()},
            {"values_from_outside", run.values()},
            {"whole", run.recording().is_whole()},
            {"good_until", run.good_until()},
            {"replay_command", "jarol replay " + shell_word(file)}};
  if (header.clock != "real") json["run_command"] = run_command(run);
  if (run.rest_begun()) json["rest_begun_ns"] = run.rest_begun()->count();
  if (const std::optional<LogEnd>& end = run.end())
    json["end"] = {{"digest", fmt::format("0x{:016x}", end->digest)},
                   {"activations", end->activations},
                   {"instants", end->instants},
                   {"faults", end->faults}};
  return json;
}

Json replay_json(const ReportReplay& replay) {
  const char* const evidence = replay.evidence == Evidence::same       ? "same"
                               : replay.evidence == Evidence::diverged ? "diverged"
                                                                       : "unknown";
  return {{"evidence", evidence}, {"compared", replay.compared}, {"verdict", to_json(replay.verdict)}};
}

// Of tasks by their index in the graph. So many are listed; all are counted.
Json happenings_json(const RecordedRun& run, const std::vector<Miss>& misses, const RecordedEvents& recorded,
                     const Graph* graph) {
  constexpr std::size_t max = 5000;
  std::map<std::string_view, std::size_t> tasks;
  for (std::size_t i = 0; graph != nullptr && i < graph->tasks.size(); ++i) tasks.emplace(graph->tasks[i].name, i);
  Json events = Json::array(), late = Json::array(), gaps = Json::array();
  std::uint64_t more_events = recorded.more;
  std::map<std::string, std::uint64_t> faults;
  for (const TimedEvent& event : recorded.events) {
    const bool fault = event.kind == RunEvent::Kind::fault;
    if (fault) ++faults[event.task];
    if (events.size() == max) {
      ++more_events;
      continue;
    }
    Json json{{"instant_ns", event.instant.count()}};
    if (fault) {
      const auto task = tasks.find(event.task);
      json.update({{"task", event.task}, {"activation", event.activation}, {"cause", printable(event.cause)}});
      if (task != tasks.end()) json["index"] = task->second;
    } else {
      json["cause"] = printable(words_of(event));
    }
    events.push_back(std::move(json));
  }
  std::map<std::string, std::uint64_t> missed;
  for (const Miss& miss : misses) {
    if (graph != nullptr) ++missed[graph->tasks[miss.task].name];
    if (late.size() < max)
      late.push_back({miss.task, miss.activation, miss.ended_after == Miss::unknown ? Json() : Json(miss.ended_after),
                      miss.left_out != 0});
  }
  for (const Gap& gap : run.gaps()) gaps.push_back({{"from_ns", gap.from}, {"to_ns", gap.to}, {"values", gap.values}});
  return {{"events", std::move(events)},
          {"more_events", more_events},
          {"faults_of", faults},
          {"misses", std::move(late)},
          {"more_misses", misses.size() - std::min(misses.size(), max)},
          {"misses_of", missed},
          {"gaps", std::move(gaps)}};
}

// What was commanded and what was reported in answer, by names of signals.
Json pairs_json(const Graph& graph) {
  Json pairs = Json::array();
  for (const Reported& r : find_reported(graph)) {
    if (!r.command) continue;
    const auto name = [&](std::size_t communicator, const Leaf& leaf) {
      const std::string& of = graph.communicators[communicator].name;
      return leaf.path.empty() ? of : of + "." + leaf.path;
    };
    pairs.push_back({name(r.command->communicator, r.command->leaf), name(r.communicator, r.leaf)});
  }
  return pairs;
}

}  // namespace

int log_report(const LogOptions& options) {
  RecordedRun run(options.file);
  const int exit_code = note_break(run.recording(), options.file);
  if (run.header().begin > Duration{})
    throw InputError("'" + options.file + "' is of a run that went on from " + seconds_text(run.header().begin) +
                     " s; jarol log report shows whole runs");
  const std::string out =
      options.out.empty() ? std::filesystem::path(options.file).replace_extension(".html").string() : options.out;
  require_apart({{"FILE", options.file}, {"GRAPH", options.other}}, {{"--out", out}});
  Json data{{"schema", "jarol.report_page/2"}, {"summary", summary_json(run, options.file)}};
  const RecordedEvents events = read_events(run.recording());
  data.update(signals_json(run));
  data["paths"] = paths_json(data["signals"]);
  try {
    Loaded loaded = load_recorded_graph(run.recording(), options.other, "jarol log report", run.gaps().empty());
    const Graph& graph = *loaded.graph;
    data["drawing"] = to_json(lay_out(graph));
    data["schedule"] = schedule_json(graph);
    data["pairs"] = pairs_json(graph);
    data["happenings"] = happenings_json(run, run.begin(graph), events, &graph);
    data["tasks"] = tasks_json(graph);
    const std::vector<std::size_t> order = graph.order;
    const bool other_graph = !options.other.empty() && !is_text_of_run(options.other, run.recording());
    const ReportReplay replay = replay_for_report(run, std::move(loaded), other_graph);
    data["replay"] = replay_json(replay);
    for (std::size_t i = 0; i < order.size() && !replay.measured.empty(); ++i) {
      const MeasuredTask& measured = replay.measured[order[i]];
      data["tasks"][i]["measured"] = {{"activations", measured.activations},
                                      {"max_of_999_ns", measured.max_of_999.count()},
                                      {"max_ns", measured.max.count()}};
    }
  } catch (const SpecError& error) {
    // what the recording has needs no graph
    data["no_graph"] = printable_lines(error.what());
    if (!data.contains("happenings")) data["happenings"] = happenings_json(run, {}, events, nullptr);
  }
  const std::string page = page_of("Run of " + run.header().graph,
                                   {"base.js", "data.js", "steer.js", "plot.js", "plots.js", "drawing.js", "rows.js",
                                    "lines.js", "path.js", "summary.js", "report.js"},
                                   data);
  if (out == "-") {
    std::cout << page;
    return exit_code;
  }
  AtomicFile file(out);
  file.write(page);
  file.commit();
  std::cout << "  report      " << printable(out) << "\n";
  return exit_code;
}

}  // namespace jarol::tools
