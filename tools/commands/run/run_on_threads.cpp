#include "tools/commands/run/run_on_threads.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include "distributers/session/guard.h"
#include "distributers/session/linked.h"
#include "graph/text/escape.h"
#include "runtime/jarol/jarol_core.h"
#include "tools/commands/run/connect.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/print_run.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/commands/run/real_time.h"
#include "tools/report/exit_code.h"
#include "tools/report/noted.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {
namespace {

class ThreadsRun : public AttendedRun {
 public:
  ThreadsRun(JarolCore& core, Duration end, std::optional<Duration> longest_rest, const RealTimeOptions& options)
      : core_(core), end_(end), longest_rest_(longest_rest), options_(options) {}
  void cover() override {
    // what one thread is refused, all are
    core_.cover(end_, [this, caller = std::this_thread::get_id()] {
      const std::vector<std::string> refusals = prepare_thread(options_);
      if (std::this_thread::get_id() != caller) return;
      for (const std::string& refusal : refusals) std::cerr << "note: " << refusal << "\n";
    });
  }
  bool stopped_by_fault() const override { return core_.report().stopped; }
  std::optional<Duration> longest_rest() const override { return longest_rest_; }
  void ask_for_rest() override { core_.ask_for_rest(); }
  bool resting() const override { return core_.resting(); }
  void close(const Ending&, Futex::Time patience) override { core_.close(patience); }
  std::optional<Holdup> holdup() const override { return core_.holdup(); }
  std::vector<HangingTask> running() const override {
    std::optional<HangingTask> task = core_.running();
    return task ? std::vector{std::move(*task)} : std::vector<HangingTask>();
  }
  Finish finish(Futex::Time patience) override { return core_.finish(patience); }

 private:
  JarolCore& core_;
  Duration end_;
  std::optional<Duration> longest_rest_;
  const RealTimeOptions& options_;
};

}  // namespace

int run_on_threads(Loaded& loaded, Duration end, const RunOptions& run_options) {
  const RealTimeOptions options = options_of(run_options.real_time);
  Guard guard(loaded, run_options.real_time.no_guardian ? "--no-guardian" : "", options.priority, print_note);
  const CrashLine crash_line(*loaded.graph, guard.process());
  Noted noted(*loaded.graph);
  std::vector<RecordSink*> looking_on;
  noted.add_to(looking_on);
  const std::vector<ExternalSystem*> channels = pointers_to(loaded.channels);
  RunSinks sinks(*loaded.graph, looking_on);
  JarolCore core(*loaded.graph, std::move(loaded.channels), sinks.recorder());
  core.on_rest([&](Duration begun) { sinks.judge_before(begun); });
  let_writing_fail();
  const std::optional<Duration> rest = longest_rest(*loaded.graph);
  const Interruptible interruptible([] {}, HaltKey::ends, rest ? SecondSignal::hastens : SecondSignal::ends);
  take_priority(options.priority);
  std::optional<Linked> linked;
  connect_unless_ended([&] { linked.emplace(channels, print_note); });
  take_priority_above(options.priority);
  ThreadsRun attended(core, end, rest, options);
  auto start = std::chrono::steady_clock::now();
  RunEnd run_end = attend(
      attended,
      [&] {
        guard.arm();
        start = std::chrono::steady_clock::now();
      },
      [&] {
        guard.look(note_promptly);
        return Interruptible::wish();
      },
      [&](const Ending& why) { write_promptly(printable_lines(rest_begins_text(*loaded.graph, why))); },
      Interruptible::forbid_haste, {.report = report_stuck});
  if (run_end.links_are_free()) finish_links(*linked, *loaded.graph, run_end);
  if (run_end.links_are_free()) guard.close();
  halt_if_asked(run_end);
  const double seconds =
      std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  std::string unwatched;
  try {
    if (!run_end.hangs) show_mishaps_and_close(sinks, *loaded.graph, channels, core.report(), core.rest());
  } catch (const std::exception& error) { unwatched = error.what(); }
  const RunVerdict verdict = judge_run(*loaded.graph, core.report(), channels, sinks, core.rest(), end, run_end);
  const std::vector<FailsafeReport> failsafe = failsafe_after(run_end, *loaded.graph, channels, core.failsafe());
  const RunOutcome outcome{
      .state = core.state(),
      .report = core.report(),
      .rest = core.rest(),
      .failsafe = failsafe,
      .noted = noted,
      .end = run_end,
      .threads = &core,
      .guard = &guard,
      .links = linked->reports(),
      .seconds = seconds,
      .simulated = core.report().simulated,
      .verdict = verdict,
      .true_states = run_end.hangs ? std::vector<TrueState>{} : find_true_states(*loaded.graph, channels)};
  Interruptible::report([&] { print(run_options, outcome, {}, WhatIfs(std::vector<std::string>{}), false); });
  std::cerr << errors_of(run_end, core.now()) << failures_text(verdict);
  if (!unwatched.empty()) std::cerr << "error: " << unwatched << "\n";
  const int exit_code = exit_of({exit_code_of(run_end), exit_code_of(verdict), exit_code_of(failsafe),
                                 unwatched.empty() ? exit_good : exit_unfinished});
  if (run_end.must_end_at_once()) end_at_once(exit_code);
  return exit_code;
}

}  // namespace jarol::tools
