#include "tools/commands/log/report_replay.h"

#include "distributers/session/graph_run.h"
#include "distributers/session/recorded_truth.h"
#include "distributers/session/rest_verdict.h"
#include "runtime/machine/thread_time.h"
#include "runtime/record/replayed_values.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/commands/run/crash_line.h"

namespace jarol::tools {
namespace {

std::vector<MeasuredTask> measure(RecordedRun& run, const Graph& graph) {
  if (thread_time_between_readings() == Duration{}) return {};
  // what was late then is run, too
  run.begin(graph);
  Executor executor(graph, replayed_systems(graph, run), {.digest = false, .sharing = Sharing::measure});
  executor.run_until(run.covered());
  std::vector<MeasuredTask> measured;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Histogram& took = executor.team()->took(i);
    measured.push_back({took.count(), took.max(), took.percentile(0.999)});
  }
  return measured;
}

}  // namespace

ReportReplay replay_for_report(RecordedRun& run, Loaded loaded, bool other_graph) {
  ReportReplay replayed;
  const CrashLine crash_line(*loaded.graph);
  replayed.measured = measure(run, *loaded.graph);
  const std::vector<Miss> misses = run.begin(*loaded.graph);
  loaded.systems = recorded_systems(loaded, run);
  ReplayedValues values(run, outputs_of(*loaded.graph));
  std::vector<RecordSink*> sinks;
  if (values.has_any()) sinks.push_back(&values);
  GraphRun graph_run(std::move(loaded), {.sinks = sinks, .misses = misses});
  if (run.rest_begun()) graph_run.sinks().judge_before(*run.rest_begun());
  Executor& executor = graph_run.executor();
  ReplayRun replay(executor, run);
  replay.cover();
  executor.finish();
  run.require_all_taken();
  graph_run.sinks().close();
  replayed.evidence = values.differences().first() ? Evidence::diverged : replay.comparison.evidence;
  replayed.compared = values.differences().compared();
  const RecordingHeader& header = run.header();
  const Duration reached = run.end() ? Duration(run.end()->simulated) : executor.report().simulated;
  replayed.verdict.expectations = graph_run.sinks().judge(
      judged_until(run.rest_begun(), header.until, executor.report().covered),
      why_cut_short(judged_until(run.rest_begun(), header.until, reached), header.until, header.mission));
  judge_no_other_truth(graph_run.graph(), replayed.evidence, other_graph, replayed.verdict.expectations);
  replayed.verdict.mishaps = read_mishaps(run.recording());
  replayed.verdict.left_out = find_left_out(graph_run.graph(), executor.report());
  return replayed;
}

}  // namespace jarol::tools
