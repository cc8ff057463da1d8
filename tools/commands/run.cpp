// jarol run: a graph on the virtual clock or in real time.
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "distributers/session/recorded_truth.h"
#include "distributers/session/runner.h"
#include "graph/text/escape.h"
#include "runtime/files/atomic_file.h"
#include "runtime/machine/signal_stack.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/at_console.h"
#include "tools/commands/run/connect.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/guard_option.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/panels.h"
#include "tools/commands/run/print_run.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/commands/run/run_options.h"
#include "tools/commands/run/silent_vehicles.h"
#include "tools/commands/run/watch_run.h"
#include "tools/commands/run/what_if.h"
#include "tools/report/command_line.h"
#include "tools/report/progress.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"

namespace jarol::tools {
namespace {

// How fast it goes on the virtual clock; null: as fast as possible.
std::unique_ptr<Pace> pace_of(const RunArguments& arguments) {
  const ConsoleArguments& console = arguments.console;
  if (arguments.clock != "virtual" || (!console.wanted() && console.pace.empty())) return nullptr;
  return std::make_unique<Pace>(console.pace.empty() ? std::optional(1.0) : parse_pace(console.pace));
}

// Of what was to be written, and of checkpoints and what-ifs that the run was to come to: a signal ends these with it.
int exit_code_of_lost(bool all_written, bool none_lost) {
  if (!all_written) return exit_unfinished;
  if (none_lost) return exit_good;
  return Interruptible::signal() == 0 ? int{exit_unfinished} : exit_of_signal(Interruptible::signal());
}

// What the library runs, as the command line asks for it.
RunOptions options_of(const RunArguments& arguments, const Loaded& loaded) {
  return {.end = end_of_run(arguments, loaded),
          .overrides = arguments.overrides,
          .seed = arguments.seed,
          .real_clock = arguments.clock == "real",
          .threads = arguments.concurrency == "threads",
          .workers = arguments.workers,
          .real_time = options_of(arguments.real_time),
          .force = arguments.real_time.force,
          .note_force = true,
          .no_guardian = arguments.real_time.no_guardian ? "--no-guardian" : "",
          .execution = arguments.execution,
          .recording = options_of(arguments.recording),
          .note = print_note,
          .words = run_words};
}

// Each is written when the run has come there, and then stands among `written`.
void add_saves(const std::vector<Save>& saves, std::vector<Save>& written, std::vector<Stop>& stops) {
  for (const Save& save : saves) {
    require_no_input(save.file);
    Checkpoint::require_writable(save.file);
    stops.push_back({"--save", save.at,
                     [&written, &save](const Checkpoint& checkpoint) {
                       checkpoint.write(save.file);
                       written.push_back(save);
                     },
                     "'" + save.file + "' is not written"});
  }
}

bool steers(const RunArguments& arguments, const std::vector<ExternalSystem*>& systems) {
  return arguments.clock == "real" ||
         std::any_of(systems.begin(), systems.end(), [](const ExternalSystem* each) { return each->outlives_run(); });
}

// Begins and attends it at the terminal.
const RunEnd& attend(Runner& runner, const RunArguments& arguments, const std::vector<ExternalSystem*>& systems) {
  const bool shown = !arguments.json && isatty(STDERR_FILENO) != 0 && runner.end() != Duration::max() &&
                     arguments.concurrency != "threads";
  std::optional<Progress> progress;
  // made before the priority that threads of links take after this one
  progress.emplace(shown, runner.end(), [&] { return runner.joined().now(); });
  connect_unless_ended([&] { runner.begin(); });
  SilentVehicles silent(runner.graph(), systems);
  return runner.attend({.wish =
                            [&] {
                              silent.look();
                              return Interruptible::wish();
                            },
                        .note = note_promptly,
                        .on_rest =
                            [&](const Ending& why) {
                              silent.rest_begins();
                              write_promptly(printable_lines(rest_begins_text(runner.graph(), why)));
                            },
                        .on_end = Interruptible::forbid_haste,
                        .on_stuck = {.report = report_stuck}});
}

WhatIfSetup what_if_setup(const RunArguments& arguments, Duration end) {
  return {.load = [&](const Overrides& with) { return load_graph(arguments.file, with, arguments.seed); },
          .overrides = arguments.overrides,
          .seed = arguments.seed,
          .workers = arguments.workers,
          .execution = arguments.execution,
          .end = end,
          .option = "--what-if",
          .execution_option = "--execution"};
}

int run(RunArguments arguments, WatchRun* watch) {
  if (arguments.guard) look_up_at_once();
  const std::vector<WhatIf> asked = parse_what_ifs(arguments.what_if);
  const std::vector<Save> saves = parse_saves(arguments.checkpoints.saves);
  require_files_apart(arguments, saves);
  std::optional<Checkpoint> resumed;
  if (!arguments.checkpoints.resume.empty())
    resumed = read_checkpoint(arguments.checkpoints.resume, arguments.overrides, arguments.seed);
  const SourceSet sources;
  Loaded loaded = load_graph(arguments.file, arguments.overrides, arguments.seed);
  const Graph& graph = *loaded.graph;
  RunOptions options = options_of(arguments, loaded);
  options.recording.sources = &sources;
  options.resumed = resumed ? &*resumed : nullptr;
  options.resumed_from = arguments.checkpoints.resume;
  Runner::require_runnable(options, loaded);
  require_console(arguments, loaded);
  WhatIfs what_ifs(asked, what_if_setup(arguments, options.end), graph);
  const ReportsAside aside(arguments.files);
  RunFiles files(graph, arguments.files, note_of(arguments.overrides, arguments.seed), types_of_truth(loaded));
  const SignalStack signal_stack;  // of what reports a crash; before the guard, which leaves it writable
  const std::unique_ptr<TaskGuard> task_guard = make_guard(arguments.guard, graph, pointers_to(loaded.systems));
  const std::unique_ptr<Pace> pace = pace_of(arguments);
  const std::unique_ptr<console::View> console =
      arguments.console.wanted() ? watch(arguments, loaded, options.end, pace.get()) : nullptr;
  options.pace = pace.get();
  options.guard = task_guard.get();
  options.sinks = files.sinks();
  what_ifs.add_to(options.sinks);
  if (console) options.sinks.push_back(&console->feed());
  options.truth = console != nullptr || files.shows_truth();
  options.watched = console != nullptr;
  std::vector<Save> written_saves;
  add_saves(saves, written_saves, options.stops);
  what_ifs.add_to(options.stops);
  const std::vector<ExternalSystem*> systems = pointers_to(loaded.systems);
  const bool may_steer = steers(arguments, systems);
  std::optional<CrashLine> crash_line;
  Runner runner(std::move(loaded), std::move(options), [&](const Guard* guard) {
    crash_line.emplace(graph, guard != nullptr ? guard->process() : nullptr, arguments.recording.file());
  });
  let_writing_fail();
  if (console) {
    console->open();
    print_url(console->url(), arguments.console);
  }
  const Interruptible interruptible([] {}, may_steer ? HaltKey::ends : HaltKey::halts,
                                    runner.longest_rest() ? SecondSignal::hastens : SecondSignal::ends);
  const RunEnd& run_end = attend(runner, arguments, systems);
  halt_if_asked(run_end);
  std::string not_run;  // of what-ifs
  try {
    if (!run_end.hangs)
      what_ifs.run(
          runner.joined().sinks(), [&](std::size_t i) { return files.beside("what if " + std::to_string(i + 1)); },
          Interruptible::wish);
  } catch (const std::exception& error) { not_run = error.what(); }
  const RunOutcome outcome = runner.finish();
  if (runner.recording() != nullptr && !run_end.hangs) std::cerr << notes_of(arguments.recording, *runner.recording());
  std::string unwritten = outcome.unwritten, lost = outcome.unsaved;
  // a recording is good up to its last chunk
  if (run_end.hangs && outcome.threads == nullptr && (!files.sinks().empty() || !graph.expectations.empty()))
    unwritten = "trace and picture are not written, as the run has not ended";
  const bool written = unwritten.empty();
  if (!not_run.empty()) lost += (lost.empty() ? "" : "; ") + not_run;
  if (!lost.empty()) unwritten += (written ? "" : "; ") + lost;
  // the report is there whatever can't be written
  Interruptible::report([&] { print(arguments, outcome, written_saves, what_ifs, written); });
  if (console) console->end(to_text(outcome) + failures_text(outcome.verdict));
  std::cerr << errors_of(run_end, runner.joined().now()) << failures_text(outcome.verdict);
  if (!unwritten.empty()) std::cerr << "error: " << unwritten << "\n";
  const int exit_code = exit_of({exit_code_of(run_end), exit_code_of(outcome.verdict), exit_code_of(outcome.failsafe),
                                 exit_code_of_lost(written, lost.empty())});
  if (run_end.must_end_at_once()) end_at_once(exit_code);
  return exit_code;
}

}  // namespace

void add_run(CommandLine& line, int& exit_code, WatchRun* watch) {
  auto options = std::make_shared<RunArguments>();
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
