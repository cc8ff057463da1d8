// jarol replay: a run again, from its recording.
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "distributers/session/recorded_events.h"
#include "distributers/session/recorded_truth.h"
#include "distributers/session/replayer.h"
#include "graph/text/escape.h"
#include "tools/commands/commands.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/commands/run/panels.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/commands/run/real_time.h"
#include "tools/commands/run/run_files.h"
#include "tools/commands/run/run_report.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/differences_report.h"
#include "tools/report/duration_option.h"
#include "tools/report/fault_report.h"
#include "tools/report/json_line.h"
#include "tools/report/progress.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"

namespace jarol::tools {
namespace {

struct ReplayArguments {
  std::string log;
  std::string file;
  Overrides overrides;
  std::vector<std::string> only;
  std::string from;  // as in 30s; empty: from where the recording begins
  bool json = false;
  RunFileArguments files;
};

// Of a recording without its run's end; else nothing.
std::string why_unknown(const RecordedRun& log, const std::string& file) {
  if (log.end()) return "";
  return fmt::format("{}, before {} s it is whole; how the run ended is not known",
                     break_text(log.recording(), is_damaged(file)), seconds_text(log.covered()));
}

std::string text_of(const Comparison& comparison, const Report& report, const RecordedRun& log,
                    const Differences& differences, const std::string& file, bool is_other_text, bool of_some) {
  if (comparison.interrupted) return "";
  const std::string run = "the run on the " + log.header().clock + " clock";
  std::string text;
  if (log.rest_begun())
    text += "  at end      from " + seconds_text(*log.rest_begun()) +
            " s on the run was to bring its vehicle to rest: " +
            std::string(words_of(read_rest(log.recording()), log.end().has_value())) + "\n";
  if (comparison.evidence == Evidence::same) {
    text += "  same        as " + run;
    if (differences.compared() > 0) text += fmt::format(", {} values compared", differences.compared());
    text += "\n";
  }
  if (comparison.evidence == Evidence::diverged) {
    text += "  DIVERGED    from " + run;
    if (comparison.same_until && *comparison.same_until > Duration{})
      text += " after " + seconds_text(*comparison.same_until) + " s";
    if (comparison.diverged_until) text += ", before " + seconds_text(*comparison.diverged_until) + " s";
    text += "\n";
    if (const std::optional<LogEnd>& end = log.end(); end && !of_some)
      text += fmt::format("  it had      activations {}, instants {}, faults {}, digest 0x{:016x}\n", end->activations,
                          end->instants, end->faults, end->digest);
    text += tools::text_of(differences);
    if (report.stopped && (!log.end() || log.end()->faults == 0))
      text +=
          "              a fault that stops it did not happen there; the replay went on to the end of the recording\n";
    if (is_other_text) text += "              the file of the graph is not what it was\n";
  }
  if (const std::string why = why_unknown(log, file); !why.empty()) text += "  log         " + why + "\n";
  return text;
}

nlohmann::ordered_json json_of(const RunOutcome& outcome, const Comparison& comparison, const RecordedRun& log,
                               const Differences& differences, const ReplayArguments& options, std::size_t misses) {
  auto json = to_json(outcome);
  const auto or_null = [](bool known, const auto& value) {
    return known ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  json["schema"] = "jarol.replay/2";
  json.erase("clock");  // that of the run stands in "log"
  json["log"] = {
      {"file", options.log},
      {"clock", log.header().clock},
      {"values", log.values()},
      {"misses", misses},
      {"digest", or_null(log.end().has_value(), fmt::format("0x{:016x}", log.end() ? log.end()->digest : 0))}};
  if (log.rest_begun()) json["log"]["rest_begun_ns"] = log.rest_begun()->count();
  if (outcome.begun > Duration{}) json["begun_ns"] = outcome.begun.count();
  json["interrupted"] = comparison.interrupted;
  json["verdict"] = comparison.evidence == Evidence::same       ? "same"
                    : comparison.evidence == Evidence::diverged ? "diverged"
                                                                : "unknown";
  json["changed_files"] = changed_files(log.recording());
  json.update(tools::json_of(differences));
  json["same_until_ns"] =
      or_null(comparison.same_until.has_value(), comparison.same_until.value_or(Duration{}).count());
  return json;
}

void print(const ReplayArguments& options, const Replayer& replayer, const ReplayOutcome& outcome,
           const RecordedRun& log, bool written) {
  const RunOutcome& run = outcome.run;
  const Comparison& comparison = outcome.comparison;
  if (options.json) {
    std::cout << json_line(json_of(run, comparison, log, outcome.differences, options, replayer.misses()));
    return;
  }
  const std::string from = run.begun > Duration{} ? ", from " + seconds_text(run.begun) + " s on," : "";
  std::cout << fmt::format("{}: replay of {} s{} in {:.2f} s, {:.0f} times real time{}\n", printable(run.graph().name),
                           seconds_text(run.simulated), from, run.seconds, real_time_factor(run),
                           comparison.interrupted ? " (interrupted)" : "")
            << to_text(run)
            << fmt::format("  log         {} values from outside, {} activations late or left out\n", log.values(),
                           replayer.misses());
  if (written) std::cout << to_text(options.files);
  if (!replayer.judges()) std::cout << "  expected    not judged, as the replay begins on the way\n";
  std::cout << text_of(comparison, run.report, log, outcome.differences, options.log, replayer.is_other_text(),
                       !options.only.empty());
  if (options.file.empty())
    for (const std::string& file : changed_files(log.recording()))
      std::cout << "  changed     '" << printable(file)
                << "' is not what the run has read; it was replayed as it was then\n";
  std::cerr << fault_report(run.report);
}

int exit_code_of_replay(const ReplayOutcome& outcome, bool written) {
  const Comparison& comparison = outcome.comparison;
  const int compared = comparison.interrupted || comparison.evidence == Evidence::same ? exit_good
                       : comparison.evidence == Evidence::diverged                     ? exit_negative
                                                                                       : exit_unfinished;
  const int judged = !comparison.interrupted && outcome.run.verdict.is_negative() ? exit_negative : exit_good;
  return exit_of({exit_code_of(outcome.run.end), compared, judged, written ? exit_good : exit_unfinished});
}

int replay(const ReplayArguments& options) {
  RecordedRun log(options.log);
  note_gaps(log.recording(), options.log);
  require_apart({{"LOG", options.log}, {"FILE", options.file.empty() ? log.header().file : options.file}},
                {{"--trace", options.files.trace}, {"--plot", options.files.plot}});
  Replayer replayer(log, built_in(),
                    {.file = options.file,
                     .overrides = options.overrides,
                     .only = options.only,
                     .from = options.from.empty() ? std::nullopt : std::optional(duration_of("--from", options.from)),
                     .note = note_once,
                     .words = run_words});
  const Graph& graph = *replayer.loaded().graph;
  const ReportsAside aside(options.files);
  RunFiles files(graph, options.files, note_of(replayer.overrides(), log.header().seed),
                 types_of_truth(replayer.loaded()));
  replayer.begin(files.sinks(), files.shows_truth());
  const CrashLine crash_line(graph);
  let_writing_fail();
  const Interruptible interruptible;
  std::optional<Progress> progress;
  progress.emplace(!options.json && isatty(STDERR_FILENO) != 0, log.covered(), [&] { return replayer.now(); });
  const RunEnd& run_end = replayer.attend({.wish = Interruptible::wish, .on_stuck = {.report = report_stuck}});
  progress.reset();
  const ReplayOutcome outcome = replayer.finish();
  std::string unwritten = outcome.run.unwritten;
  if (run_end.hangs && (!files.sinks().empty() || !graph.expectations.empty()))
    unwritten = "trace and picture are not written, as the replay has not ended";
  print(options, replayer, outcome, log, unwritten.empty());
  std::cerr << failures_text(outcome.run.verdict);
  if (!unwritten.empty()) std::cerr << "error: " << unwritten << "\n";
  const Comparison& comparison = outcome.comparison;
  if (const std::string why = why_unknown(log, options.log);
      comparison.evidence == Evidence::unknown && !comparison.interrupted && !why.empty())
    std::cerr << "error: '" << printable(options.log) << "' " << why << "\n";
  std::cerr << errors_of(run_end, replayer.now());
  const int exit_code = exit_code_of_replay(outcome, unwritten.empty());
  if (run_end.hangs) end_at_once(exit_code);
  return exit_code;
}

}  // namespace

void add_replay(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<ReplayArguments>();
  Command* command = line.add_subcommand(
      "replay",
      "Run again what jarol run --record or --log has recorded: on the virtual clock, without vehicles or links, "
      "with what\n"
      "came from outside and what was late then. Every recorded value is compared: it is the same to the bit, or the\n"
      "first difference is shown, and of each signal by how much it differs.\n"
      "Exit code: 0 the same, 1 diverged, or the same and not what 'expect' says or too much left out by faults,\n"
      "2 bad input, as a recording with anything after its end, 3 one that breaks off or is damaged,\n"
      "129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), SIGTERM");
  command->add_option("LOG", options->log, "The recording of a run")->file({"mcap"})->required();
  command
      ->add_option(
          "FILE", options->file,
          "Another graph than that of the run, or the same where it names plugins; default: as the run has read it")
      ->file({"yaml"});
  command
      ->add_option("--set", options->overrides.set,
                   "Change a value, beside those of the run: path=value, as in tasks.depth.parameters.kp=0.5")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use another profile of the file than the run");
  command->add_option("--only", options->only,
                      "Only these tasks, with what the recording has of the outputs that they read: names, as in "
                      "depth fins");
  command->add_option("--from", options->from,
                      "Begin at the newest checkpoint of the recording that is not later, as in 30s");
  add_no_plugins(*command, options->overrides);
  command->add_flag("--json", options->json, "One JSON object instead of text");
  add_run_file_options(*command, options->files);
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace jarol::tools
