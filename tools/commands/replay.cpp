// jarol replay: a run again, from its recording.
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "distributers/session/graph_run.h"
#include "distributers/session/only_tasks.h"
#include "distributers/session/recorded_truth.h"
#include "distributers/session/replay.h"
#include "distributers/session/rest_verdict.h"
#include "graph/text/escape.h"
#include "runtime/record/replayed_values.h"
#include "tools/commands/commands.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/commands/run/panels.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/commands/run/replay_start.h"
#include "tools/commands/run/run_files.h"
#include "tools/commands/run/run_report.h"
#include "tools/report/command_line.h"
#include "tools/report/differences_report.h"
#include "tools/report/fault_report.h"
#include "tools/report/json_line.h"
#include "tools/report/progress.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"

namespace jarol::tools {
namespace {

struct ReplayOptions {
  std::string log;
  std::string file;
  Overrides overrides;
  std::vector<std::string> only;
  std::string from;  // as in 30s; empty: from where the recording begins
  bool json = false;
  RunFileArguments files;
};

std::string text_of(const Comparison& comparison, const Report& report, const RecordedRun& log,
                    const Differences& differences, bool is_other_text, bool of_some) {
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
  if (!log.end())
    text += fmt::format("  log         breaks off {}, before {} s it is whole; how the run ended is not known\n",
                        printable(log.recording().text_of_break()), seconds_text(log.covered()));
  return text;
}

nlohmann::ordered_json json_of(const RunOutcome& outcome, const Comparison& comparison, const RecordedRun& log,
                               const Differences& differences, const ReplayOptions& options, std::size_t misses) {
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

// What is changed might have taken the vehicle elsewhere; where values are missing nobody knows where it was then.
RecordedWorld world_of(const ReplayOptions& options, Duration begin, const RecordedRun& log) {
  if (begin > Duration{}) return RecordedWorld::systems;
  const bool is_changed = !options.overrides.set.empty() || !options.overrides.profile.empty() || !options.only.empty();
  return is_changed || !log.gaps().empty() ? RecordedWorld::nothing : RecordedWorld::truth;
}

int replay(const ReplayOptions& options) {
  RecordedRun log(options.log);
  note_gaps(log.recording(), options.log);
  const Duration begin = replay_begin(options.from, log);
  const Overrides overrides = overrides_of(log.recording(), options.file, options.overrides);
  const RecordedWorld world = world_of(options, begin, log);
  Loaded whole = load_recorded(log.recording(), options.file, overrides, world);
  require_apart({{"LOG", options.log}, {"FILE", options.file.empty() ? log.header().file : options.file}},
                {{"--trace", options.files.trace}, {"--plot", options.files.plot}});
  if (begin > Duration{} && !options.only.empty())
    throw std::invalid_argument("--only begins at the start of a run; leave out --from, or replay a recording of that");
  std::vector<Miss> misses = log.begin(*whole.graph, begin);
  std::optional<OnlyTasks> only;
  if (!options.only.empty() && !log.gaps().empty())
    throw std::invalid_argument("--only: the recording lacks published values that these tasks may have read, from " +
                                seconds_text(Duration(log.gaps().front().from)) +
                                " s on, as they came faster than the disk took them; leave --only out");
  if (!options.only.empty()) {
    only.emplace(*whole.graph, options.only, log.recording());
    misses = only->misses_of(misses);
  } else {
    std::vector<std::unique_ptr<ExternalSystem>> replayed = recorded_channels(whole, log);
    whole.channels =
        begin > Duration{} ? with_state_of(std::move(whole.channels), std::move(replayed)) : std::move(replayed);
  }
  // conditions are about whole runs
  const bool judges = begin == Duration{} || whole.graph->expectations.empty();
  if (!judges) whole.graph->expectations.clear();
  Loaded loaded = only ? only->take() : std::move(whole);
  RunOrigin origin;
  if (begin > Duration{}) origin = origin_of(loaded, overrides, log.header().seed);
  const Graph& graph = *loaded.graph;
  const ReportsAside aside(options.files);
  RunFiles files(graph, options.files, note_of(overrides, log.header().seed), types_of_truth(loaded));
  Noted noted(graph);
  std::vector<RecordSink*> looking_on = files.sinks();
  noted.add_to(looking_on);
  ReplayedValues values(log, outputs_of(graph), only ? &only->outputs() : nullptr, begin);
  if (only && !values.has_any())
    throw std::invalid_argument("--only: the recording has no values of these tasks to compare with");
  if (values.has_any()) looking_on.push_back(&values);
  GraphRun graph_run(std::move(loaded), {.sinks = looking_on, .misses = misses, .truth = files.shows_truth()});
  if (begin > Duration{}) restore_recorded(graph_run, noted, log, begin, std::move(origin));
  RunSinks& sinks = graph_run.sinks();
  Executor& executor = graph_run.executor();
  if (log.rest_begun()) sinks.judge_before(*log.rest_begun());
  const auto start = std::chrono::steady_clock::now();
  ReplayRun attended(executor, log, !only);
  const CrashLine crash_line(graph);
  let_writing_fail();
  const Interruptible interruptible;
  std::optional<Progress> progress;
  progress.emplace(!options.json && isatty(STDERR_FILENO) != 0, log.covered(), [&] { return executor.now(); });
  const RunEnd run_end = attend(
      attended, [] {}, Interruptible::wish, [](const Ending&) {}, [] {}, {.report = report_stuck});
  progress.reset();
  if (run_end.failure) std::rethrow_exception(run_end.failure);
  Comparison& comparison = attended.comparison;
  comparison.interrupted = comparison.interrupted || run_end.hangs;
  const double seconds =
      std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (!comparison.interrupted && !only) log.require_all_taken();
  std::string unwritten;
  try {
    if (run_end.hangs && (!files.sinks().empty() || !graph.expectations.empty()))
      unwritten = "trace and picture are not written, as the replay has not ended";
    if (!run_end.hangs) sinks.close();
  } catch (const std::exception& error) { unwritten = error.what(); }
  const bool compared_all = run_end.hangs || !values.has_any() || sinks.why_not_all(values).empty();
  if (!compared_all && comparison.evidence == Evidence::same) comparison.evidence = Evidence::unknown;
  const Differences& differences = values.differences();
  if (differences.first() && !comparison.interrupted && compared_all) {
    comparison.evidence = Evidence::diverged;
    // where somebody has changed a recorded value its digests are still those of the run
    if (comparison.same_until) comparison.same_until = std::min(*comparison.same_until, differences.first()->instant);
  }
  const Report& report = executor.report();
  RunVerdict verdict;
  const Duration reached = comparison.interrupted || !log.end() ? report.simulated : Duration(log.end()->simulated);
  if (!run_end.hangs)
    verdict.expectations = sinks.judge(judged_until(log.rest_begun(), log.header().until, report.covered),
                                       why_cut_short(judged_until(log.rest_begun(), log.header().until, reached),
                                                     log.header().until, log.header().mission));
  const bool is_other_text = !options.file.empty() && !is_text_of_run(options.file, log.recording());
  judge_no_other_truth(graph, comparison.evidence, is_other_text, verdict.expectations);
  verdict.left_out = find_left_out(graph, report);
  // what is the same to the last value, in part too, is what that vehicle was flown by
  const bool is_of_run = comparison.evidence == Evidence::same ||
                         (world == RecordedWorld::truth && comparison.evidence != Evidence::diverged);
  if (is_of_run && !comparison.interrupted) verdict.mishaps = read_mishaps(log.recording());
  if (const auto rest = read_rest(log.recording());
      rest && !rest->reached && log.end() && is_of_run && !comparison.interrupted)
    verdict.not_at_rest = "the vehicle of the run did not come to rest";
  const RunOutcome outcome{.state = executor.state(),
                           .report = report,
                           .rest = executor.rest(),
                           .failsafe = executor.failsafe(),
                           .noted = noted,
                           .end = run_end,
                           .seconds = seconds,
                           .begun = begin,
                           .simulated = reached,
                           .verdict = verdict};
  if (options.json) {
    std::cout << json_line(json_of(outcome, comparison, log, differences, options, misses.size()));
  } else {
    const std::string from = begin > Duration{} ? ", from " + seconds_text(begin) + " s on," : "";
    std::cout << fmt::format("{}: replay of {} s{} in {:.2f} s, {:.0f} times real time{}\n", printable(graph.name),
                             seconds_text(outcome.simulated), from, seconds, real_time_factor(outcome),
                             comparison.interrupted ? " (interrupted)" : "")
              << to_text(outcome)
              << fmt::format("  log         {} values from outside, {} activations late or left out\n", log.values(),
                             misses.size());
    if (unwritten.empty()) std::cout << to_text(options.files);
    if (!judges) std::cout << "  expected    not judged, as the replay begins on the way\n";
    std::cout << text_of(comparison, report, log, differences, is_other_text, only.has_value());
    if (options.file.empty())
      for (const std::string& file : changed_files(log.recording()))
        std::cout << "  changed     '" << printable(file)
                  << "' is not what the run has read; it was replayed as it was then\n";
    std::cerr << fault_report(report);
  }
  std::cerr << failures_text(verdict);
  if (!unwritten.empty()) std::cerr << "error: " << unwritten << "\n";
  std::cerr << errors_of(run_end, executor.now());
  const int compared = comparison.interrupted || comparison.evidence == Evidence::same ? exit_good
                       : comparison.evidence == Evidence::diverged                     ? exit_negative
                                                                                       : exit_unfinished;
  const int judged = !comparison.interrupted && verdict.is_negative() ? exit_negative : exit_good;
  const int exit_code =
      exit_of({exit_code_of(run_end), compared, judged, unwritten.empty() ? exit_good : exit_unfinished});
  if (run_end.hangs) end_at_once(exit_code);
  return exit_code;
}

}  // namespace

void add_replay(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  Command* command = line.add_subcommand(
      "replay",
      "Run again what jarol run --record or --log has recorded: on the virtual clock, without vehicles or links, "
      "with what\n"
      "came from outside and what was late then. Every recorded value is compared: it is the same to the bit, or the\n"
      "first difference is shown, and of each signal by how much it differs.\n"
      "Exit code: 0 the same, 1 diverged, or the same and not what 'expect' says or too much left out by faults,\n"
      "2 bad input, as a recording with anything after its end, 3 one that breaks off,\n"
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
