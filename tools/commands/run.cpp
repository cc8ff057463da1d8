// jarol run: a graph on the virtual clock or in real time.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>

#include "distributers/session/graph_run.h"
#include "distributers/session/guard.h"
#include "distributers/session/recorded_truth.h"
#include "distributers/session/rest_verdict.h"
#include "graph/text/escape.h"
#include "runtime/execute/executor_run.h"
#include "runtime/execute/log_end.h"
#include "runtime/files/atomic_file.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/at_console.h"
#include "tools/commands/run/connect.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/execution.h"
#include "tools/commands/run/guard_option.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/panels.h"
#include "tools/commands/run/print_run.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/commands/run/run_on_threads.h"
#include "tools/commands/run/run_options.h"
#include "tools/commands/run/watch_run.h"
#include "tools/commands/run/what_if.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"
#include "tools/report/noted.h"
#include "tools/report/progress.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"

namespace jarol::tools {
namespace {

void start_clock(RealClock& clock, const Executor& executor) {
  std::vector<std::string> refusals = clock.prepare_thread();
  for (const std::string& refusal : executor.refusals())
    if (std::find(refusals.begin(), refusals.end(), refusal) == refusals.end()) refusals.push_back(refusal);
  for (const std::string& refusal : refusals) std::cerr << "note: " << refusal << "\n";
  clock.start();
}

RecordingHeader header_of(const RunOptions& options, const Graph& graph, Duration begin, Duration until,
                          Duration mission) {
  return {.graph = graph.name,
          .file = SourceSet::full_path(options.file),
          .overrides = options.overrides,
          .clock = options.clock,
          .begin = begin,
          .until = until,
          .mission = mission,
          .seed = options.seed,
          .execution = recorded_execution(options.execution)};
}

// How fast it goes on the virtual clock; null: as fast as possible.
std::unique_ptr<Pace> pace_of(const RunOptions& options) {
  const ConsoleArguments& console = options.console;
  if (options.clock != "virtual" || (!console.wanted() && console.pace.empty())) return nullptr;
  return std::make_unique<Pace>(console.pace.empty() ? std::optional(1.0) : parse_pace(console.pace));
}

// Of what was to be written, and of checkpoints and what-ifs that the run was to come to: a signal ends these with it.
int exit_code_of_lost(bool all_written, bool none_lost) {
  if (!all_written) return exit_unfinished;
  if (none_lost) return exit_good;
  return Interruptible::signal() == 0 ? int{exit_unfinished} : exit_of_signal(Interruptible::signal());
}

int run(RunOptions options, WatchRun* watch) {
  if (options.guard) look_up_at_once();
  WhatIfs what_ifs(options.what_if);
  const std::vector<Save> saves = parse_saves(options.checkpoints.saves);
  require_files_apart(options, saves);
  std::optional<Checkpoint> resumed;
  if (!options.checkpoints.resume.empty())
    resumed = read_checkpoint(options.checkpoints.resume, options.overrides, options.seed);
  const SourceSet sources;
  Loaded loaded = load_graph(options.file, options.overrides, options.seed);
  const Graph& graph = *loaded.graph;
  const Duration begin = resumed ? resumed->instant() : Duration{}, end = end_of_run(options, loaded);
  if (end < begin)
    throw std::invalid_argument("the run ends at " + seconds_text(end) + " s, and goes on from " + seconds_text(begin) +
                                " s; say until when, as in --for 100s");
  require_clock(options, loaded);
  require_console(options, loaded);
  what_ifs.prepare(graph, options.file, options.overrides, options.seed, options.workers, options.execution, end);
  if (options.concurrency == "threads") return run_on_threads(loaded, end, options);
  Execution execution(options.execution, graph, options.seed);
  const ReportsAside aside(options.files);
  RunFiles files(graph, options.files, note_of(options.overrides, options.seed), types_of_truth(loaded));
  const std::unique_ptr<RecordingWriter> log = make_recording(
      options.recording, header_of(options, graph, begin, end, end_of_mission(pointers_to(loaded.channels))), sources,
      loaded);
  std::optional<RealClock> clock;
  std::optional<Guard> guard;
  std::vector<analysis::TaskThread> threads;
  if (options.clock == "real") {
    if (options.workers > 1)
      throw std::invalid_argument("--workers belongs to the virtual clock; the real one goes by 'platform'");
    require_executable(options.file, graph, options.real_time);
    RealTimeOptions real_time = options_of(options.real_time);
    threads = threads_for(options.file, graph, real_time);
    clock.emplace(graph.tasks.size(), real_time);
    guard.emplace(loaded, options.real_time.no_guardian ? "--no-guardian" : "", real_time.priority, print_note);
  }
  const CrashLine crash_line(graph, guard ? guard->process() : nullptr, options.recording.file());
  const std::unique_ptr<TaskGuard> task_guard = make_guard(options.guard, graph, pointers_to(loaded.channels));
  Noted noted(graph);
  std::vector<RecordSink*> looking_on = files.sinks();
  noted.add_to(looking_on);
  what_ifs.add_to(looking_on);
  if (log) looking_on.push_back(log->publications());
  const std::unique_ptr<Pace> pace = pace_of(options);
  const std::unique_ptr<console::View> console =
      options.console.wanted() ? watch(options, loaded, end, pace.get()) : nullptr;
  if (console) looking_on.push_back(&console->feed());
  RunOrigin origin = origin_of(loaded, options.overrides, options.seed);
  GraphRun graph_run(std::move(loaded),
                     {.sinks = looking_on,
                      .workers = options.workers,
                      .clock = clock ? &*clock : nullptr,
                      .threads = threads,
                      .log = log ? log->recorder() : nullptr,
                      .schedule = execution.schedule(),
                      .times = execution.times(),
                      .guard = task_guard.get(),
                      .truth = console != nullptr || files.shows_truth() || (log && !log->header().truths.empty()),
                      .watched = console != nullptr});
  Executor& executor = graph_run.executor();
  graph_run.set_origin(std::move(origin));
  SavedRun saved(graph_run, noted, end, pace.get());
  std::vector<Save> written_saves;
  for (const Save& save : saves) {
    require_no_input(save.file);
    Checkpoint::require_writable(save.file);
    saved.add({"--save", save.at,
               [&written_saves, &save](const Checkpoint& checkpoint) {
                 checkpoint.write(save.file);
                 written_saves.push_back(save);
               },
               "'" + save.file + "' is not written"});
  }
  what_ifs.add_to(saved);
  if (resumed) restore(graph_run, noted, *resumed, options.checkpoints.resume);
  const auto save_in_recording = [&](const Checkpoint& checkpoint) {
    const Archive::Bytes state = checkpoint.to_bytes();
    log->add_checkpoint(checkpoint.instant(), {reinterpret_cast<const char*>(state.data()), state.size()});
  };
  if (!options.recording.checkpoints.empty()) saved.take_each(checkpoint_period(options.recording), save_in_recording);
  saved.require_saveable(begin, end);
  const std::vector<ExternalSystem*>& channels = graph_run.channels();
  const bool steers =
      clock || std::any_of(channels.begin(), channels.end(), [](const ExternalSystem* c) { return c->outlives_run(); });
  const bool shown = !options.json && isatty(STDERR_FILENO) != 0 && end != Duration::max();
  let_writing_fail();
  if (console) {
    console->open();
    print_url(console->url(), options.console);
  }
  const std::optional<Duration> rest = clock ? longest_rest(graph) : std::nullopt;
  const Interruptible interruptible([] {}, steers ? HaltKey::ends : HaltKey::halts,
                                    rest ? SecondSignal::hastens : SecondSignal::ends);
  std::optional<Progress> progress;
  // made before the priority that threads of links take after this one
  progress.emplace(shown, end, [&] { return executor.now(); });
  const std::optional<int> priority = clock ? clock->options().priority : std::nullopt;
  if (clock) take_priority(priority);
  connect_unless_ended([&] { graph_run.connect(print_note); });
  if (log) connect_unless_ended([&] { log->open(); });
  if (log && resumed) save_in_recording(*resumed);
  take_priority_above(priority);
  auto start = std::chrono::steady_clock::now();
  ExecutorRun attended(executor, end, rest, [&](Duration begun) { graph_run.sinks().judge_before(begun); });
  RunEnd run_end = attend(
      clock ? attended : saved,
      [&] {
        if (clock) start_clock(*clock, executor);
        if (guard) guard->arm();
        start = std::chrono::steady_clock::now();
      },
      [&] {
        if (guard) guard->look(note_promptly);
        return Interruptible::wish();
      },
      [&](const Ending& why) { write_promptly(printable_lines(rest_begins_text(graph, why))); },
      Interruptible::forbid_haste, {.report = report_stuck});
  progress.reset();
  // a link that is in use can't be finished, and what it has to be handed is left to the guardian
  if (run_end.links_are_free()) graph_run.disconnect(run_end);
  if (guard && run_end.links_are_free()) guard->close();
  halt_if_asked(run_end);
  const double seconds =
      std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  const Report& report = executor.report();
  // the report is there whatever can't be written
  std::string unwritten;
  std::string not_run;  // of what-ifs
  const auto attempt = [](std::string& wrong, const std::function<void()>& to_do) {
    try {
      to_do();
    } catch (const std::exception& error) { wrong += (wrong.empty() ? "" : "; ") + std::string(error.what()); }
  };
  if (run_end.hangs) {
    // a recording is good up to its last chunk
    if (!files.sinks().empty() || !graph.expectations.empty())
      unwritten = "trace and picture are not written, as the run has not ended";
  } else {
    attempt(not_run, [&] { what_ifs.run(graph_run.sinks(), files); });
    attempt(unwritten, [&] { graph_run.close_sinks(); });
    const Ending ended = run_end.before_rest.value_or(run_end.ending);
    const bool by_signal = ended.cause == Ending::Cause::signal;
    if (log) attempt(unwritten, [&] { log->close(log_end_of(report), by_signal ? ended.reason : ""); });
    if (log) std::cerr << notes_of(options.recording, *log);
  }
  const bool written = unwritten.empty();
  std::string lost = saved.lost();
  if (!not_run.empty()) lost += (lost.empty() ? "" : "; ") + not_run;
  if (!lost.empty()) unwritten += (written ? "" : "; ") + lost;
  const RunVerdict verdict = graph_run.judge(end, run_end);
  const std::vector<FailsafeReport> failsafe = failsafe_after(run_end, graph, channels, executor.failsafe());
  const RunOutcome outcome{.state = executor.state(),
                           .report = report,
                           .rest = executor.rest(),
                           .failsafe = failsafe,
                           .noted = noted,
                           .end = run_end,
                           .clock = clock ? &*clock : nullptr,
                           .guard = guard ? &*guard : nullptr,
                           .workers = options.workers,
                           .team = executor.team(),
                           .links = graph_run.link_reports(),
                           .seconds = seconds,
                           .begun = begin,
                           .simulated = report.simulated,
                           .verdict = verdict,
                           .true_states = run_end.hangs ? std::vector<TrueState>{} : find_true_states(graph, channels)};
  Interruptible::report([&] { print(options, outcome, written_saves, what_ifs, written); });
  if (console) console->end(to_text(outcome) + failures_text(verdict));
  std::cerr << errors_of(run_end, executor.now()) << failures_text(verdict);
  if (!unwritten.empty()) std::cerr << "error: " << unwritten << "\n";
  const int exit_code = exit_of(
      {exit_code_of(run_end), exit_code_of(verdict), exit_code_of(failsafe), exit_code_of_lost(written, lost.empty())});
  if (run_end.must_end_at_once()) end_at_once(exit_code);
  return exit_code;
}

}  // namespace

void add_run(CommandLine& line, int& exit_code, WatchRun* watch) {
  auto options = std::make_shared<RunOptions>();
  Command* command = line.add_subcommand(
      "run",
      "Run a graph: on the virtual clock, as fast as possible and the same to the bit every time, or\n"
      "on the real clock.\n"
      "Exit code: 0 good, 1 not what 'expect' says, a vehicle that has crashed, capsized or sunk, or has not come to "
      "rest\n"
      "as 'at_end' says, too much left out by faults, or refused by the real clock, 2 bad input, 3 stopped by a "
      "fault,\n"
      "a lost vehicle, a task that does not end or a full disk, 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), "
      "SIGTERM");
  add_run_options(*command, *options);
  command->callback([options, command, watch, &exit_code] {
    require_effect(*command, *options);
    exit_code = run(*options, watch);
  });
}

}  // namespace jarol::tools
