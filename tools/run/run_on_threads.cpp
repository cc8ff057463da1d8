#include "tools/run/run_on_threads.h"

#include <fmt/format.h>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "distributers/session/guard.h"
#include "distributers/session/linked.h"
#include "graph/text/escape.h"
#include "runtime/jarol/threads_core.h"
#include "tools/report/commanded.h"
#include "tools/report/exit_code.h"
#include "tools/report/guard_report.h"
#include "tools/report/json_line.h"
#include "tools/report/noted.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"
#include "tools/report/told_faults.h"
#include "tools/report/value_json.h"
#include "tools/report/verdicts.h"
#include "tools/run/crash_line.h"
#include "tools/run/interrupt.h"
#include "tools/run/prompt_line.h"
#include "tools/run/real_time.h"

namespace jarol::tools {
namespace {

void print_text(const Graph& graph, const ThreadsCore& core, const Noted& noted, const std::vector<LinkReport>& links,
                const Guard& guard, const RunEnd& end, const RunVerdict& verdict,
                const std::vector<TrueState>& true_states) {
  const Report& report = core.report();
  const ThreadsReport& threads = core.threads_report();
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-3; };
  std::cout << fmt::format("{}: {} s in real time on threads{}\n", graph.name, seconds_text(report.simulated),
                           suffix_of(end))
            << reached_text(
                   graph, [&](std::size_t communicator) { return core.last_value(communicator); }, true_states)
            << fmt::format("  activations {}, rounds {} of {}\n", report.activations, threads.rounds,
                           duration_text(core.period()))
            << fmt::format("  digest      0x{:016x}; nothing is claimed of it\n", report.digest)
            << fmt::format("  outputs     {:.1f} us after the tick median, {:.1f} us 99 %, {:.1f} us worst\n",
                           us(threads.round.percentile(0.5)), us(threads.round.percentile(0.99)),
                           us(threads.round.most()));
  std::cout << fmt::format("  lateness    {:.1f} us median, {:.1f} us 99 %, {:.1f} us worst\n",
                           us(threads.lateness.percentile(0.5)), us(threads.lateness.percentile(0.99)),
                           us(threads.lateness.most()));
  std::size_t width = 4;
  for (const Task& task : graph.tasks) width = std::max(width, task.name.size());
  std::cout << fmt::format("  {:<{}}  {:>11}  {:>10}  {:>10}\n", "task", width, "activations", "99 % us", "worst us");
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Histogram& execution = threads.execution[i];
    std::cout << fmt::format("  {:<{}}  {:>11}  {:>10.1f}  {:>10.1f}\n", graph.tasks[i].name, width, execution.count(),
                             us(execution.percentile(0.99)), us(execution.most()));
  }
  if (threads.core_busy > 0) std::cout << "  core        " << threads.core_busy << " ticks found it at work\n";
  if (threads.unawaited_ticks > 0)
    std::cout << "  sensors     " << threads.unawaited_ticks << " ticks found their thread at work\n";
  std::cout << noted.told.to_text() << noted.logged.to_text();
  for (const LinkReport& link : links) std::cout << to_text(link);
  std::cout << to_text(graph, core.rest(), end) << to_text(graph, core.safe_commands(), end.ending) << to_text(guard);
  if (report.non_finite_inputs > 0)
    std::cout << "  " << report.non_finite_inputs << " values from outside were not finite and not taken\n";
  std::cout << to_text(verdict);
  std::cerr << told_faults(report);
}

void print_json(const Graph& graph, const ThreadsCore& core, const Noted& noted, const std::vector<LinkReport>& links,
                const Guard& guard, const RunEnd& end, const RunVerdict& verdict,
                const std::vector<TrueState>& true_states) {
  const Report& report = core.report();
  const ThreadsReport& threads = core.threads_report();
  nlohmann::ordered_json json{{"schema", "jarol.run/1"},
                              {"graph", graph.name},
                              {"clock", "real"},
                              {"concurrency", "threads"},
                              {"digest", fmt::format("0x{:016x}", report.digest)},
                              {"digest_claimed", false},
                              {"simulated_ns", report.simulated.count()},
                              {"activations", report.activations},
                              {"rounds", threads.rounds},
                              {"core_busy", threads.core_busy},
                              {"unawaited_ticks", threads.unawaited_ticks},
                              {"outputs_50_ns", threads.round.percentile(0.5)},
                              {"outputs_99_ns", threads.round.percentile(0.99)},
                              {"outputs_most_ns", threads.round.most()},
                              {"faults", faults_to_json(report)},
                              {"fault_count", report.fault_count},
                              {"fault_summary", fault_summary_to_json(report)},
                              {"non_finite_inputs", report.non_finite_inputs},
                              {"ending", to_json(end)},
                              {"rest", to_json(graph, core.rest(), end)},
                              {"safe_commands", to_json(graph, core.safe_commands())},
                              {"told", noted.told.to_json()},
                              {"logged", noted.logged.to_json()}};
  json["outputs"] = outputs_to_json(graph, [&](std::size_t communicator) { return core.last_value(communicator); });
  auto tasks = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Histogram& execution = threads.execution[i];
    tasks[graph.tasks[i].name] = {{"activations", execution.count()},
                                  {"execution_99_ns", execution.percentile(0.99)},
                                  {"execution_most_ns", execution.most()}};
  }
  json["real_time"] = {{"lateness_50_ns", threads.lateness.percentile(0.5)},
                       {"lateness_99_ns", threads.lateness.percentile(0.99)},
                       {"lateness_most_ns", threads.lateness.most()},
                       {"tasks", tasks}};
  json["guardian"] = to_json(guard);
  for (const LinkReport& link : links) json["links"].push_back(to_json(link));
  json["true_values"] = to_json(true_states);
  json["judgement"] = to_json(verdict);
  std::cout << json_line(json);
}

class ThreadsRun : public AttendedRun {
 public:
  ThreadsRun(ThreadsCore& core, Duration end, std::optional<Duration> longest_rest, const RealTimeOptions& options)
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
  ThreadsCore& core_;
  Duration end_;
  std::optional<Duration> longest_rest_;
  const RealTimeOptions& options_;
};

}  // namespace

int run_on_threads(Loaded& loaded, Duration end, const RealTimeArguments& arguments, bool json) {
  const RealTimeOptions options = options_of(arguments);
  Guard guard(loaded, arguments.no_guardian ? "--no-guardian" : "", options.priority, print_note);
  const CrashLine crash_line(*loaded.graph, guard.process());
  Noted noted(*loaded.graph);
  std::vector<RecordSink*> looking_on;
  noted.add_to(looking_on);
  const std::vector<Channels*> channels = pointers_to(loaded.channels);
  RunSinks sinks(*loaded.graph, looking_on);
  ThreadsCore core(*loaded.graph, std::move(loaded.channels), sinks.recorder());
  core.on_rest([&](Duration begun) { sinks.judge_before(begun); });
  let_writing_fail();
  const std::optional<Duration> rest = longest_rest(*loaded.graph);
  const Interruptible interruptible([] {}, HaltKey::ends, rest ? SecondSignal::hastens : SecondSignal::ends);
  take_priority(options.priority);
  Linked linked(channels, print_note);
  take_priority_above(options.priority);
  ThreadsRun attended(core, end, rest, options);
  const RunEnd run_end = attend(
      attended, [&] { guard.arm(); }, Interruptible::wish,
      [&](const Ending& why) { write_promptly(printable_lines(rest_begins_text(*loaded.graph, why))); },
      Interruptible::forbid_haste);
  if (run_end.links_are_free()) {
    linked.finish();
    guard.close();
  }
  halt_if_asked(run_end);
  std::string unwatched;
  try {
    if (!run_end.hangs) sinks.close();
  } catch (const std::exception& error) { unwatched = error.what(); }
  const RunVerdict verdict =
      judge_run(*loaded.graph, core.report(), channels, sinks, core.rest(), end, run_end, unwatched);
  const std::vector<TrueState> true_states =
      run_end.hangs ? std::vector<TrueState>{} : find_true_states(*loaded.graph, channels);
  json ? print_json(*loaded.graph, core, noted, linked.reports(), guard, run_end, verdict, true_states)
       : print_text(*loaded.graph, core, noted, linked.reports(), guard, run_end, verdict, true_states);
  std::cerr << errors_of(run_end, core.now()) << failures_text(verdict);
  if (!unwatched.empty()) std::cerr << "error: " << unwatched << "\n";
  const int exit_code =
      exit_of({exit_code_of(run_end), exit_code_of(verdict), unwatched.empty() ? exit_good : exit_unfinished});
  if (run_end.hangs) end_at_once(exit_code);
  return exit_code;
}

}  // namespace jarol::tools
