#include "distributers/session/replayer.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "distributers/session/recorded_events.h"
#include "distributers/session/recorded_truth.h"
#include "distributers/session/rest_verdict.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

// What is changed might have taken the vehicle elsewhere; where values are missing nobody knows where it was then.
RecordedWorld world_of(const ReplayOptions& options, Duration begin, const RecordedRun& log) {
  if (begin > Duration{}) return RecordedWorld::systems;
  const bool is_changed = !options.overrides.set.empty() || !options.overrides.profile.empty() || !options.only.empty();
  return is_changed || !log.gaps().empty() ? RecordedWorld::nothing : RecordedWorld::truth;
}

}  // namespace

Replayer::Replayer(RecordedRun& log, const distributers::Registries& known, ReplayOptions options)
    : log_(log),
      options_(std::move(options)),
      begun_(replay_begin(options_.from, log, options_.words.from)),
      overrides_(overrides_of(log.recording(), options_.file, options_.overrides, options_.words.graph)),
      world_(world_of(options_, begun_, log)),
      whole_(load_recorded(log.recording(), known, options_.file, overrides_, world_, options_.note,
                           options_.words.graph)) {
  if (begun_ > Duration{} && !options_.only.empty())
    throw InputError(options_.words.only + " begins at the start of a run; leave out " + options_.words.from +
                     ", or replay a recording of that");
  misses_ = log_.begin(*whole_.graph, begun_);
  if (!options_.only.empty()) {
    take_only();
  } else {
    whole_.systems = begun_ > Duration{} ? resumed_systems(*whole_.graph, log_, std::move(whole_.systems))
                                         : recorded_systems(whole_, log_);
  }
  judges_ = begun_ == Duration{} || whole_.graph->expectations.empty();
  if (!judges_) whole_.graph->expectations.clear();
  loaded_ = only_ ? only_->take() : std::move(whole_);
  is_other_text_ = !options_.file.empty() && !is_text_of_run(options_.file, log_.recording());
}

void Replayer::take_only() {
  if (!log_.gaps().empty())
    throw InputError(options_.words.only +
                     ": the recording lacks published values that these tasks may have read, from " +
                     seconds_text(Duration(log_.gaps().front().from)) +
                     " s on, as they came faster than the disk took them; leave " + options_.words.only + " out");
  only_.emplace(*whole_.graph, options_.only, log_.recording());
  misses_ = only_->misses_of(misses_);
}

ReplayOutcome Replayer::run(const Attendant& attendant) {
  begin();
  attend(attendant);
  return finish();
}

void Replayer::begin(std::vector<RecordSink*> sinks, bool truth) {
  RunOrigin origin;
  if (begun_ > Duration{}) origin = origin_of(loaded_, overrides_, log_.header().seed);
  const Graph& graph = *loaded_.graph;
  noted_.emplace(graph);
  noted_->add_to(sinks);
  values_.emplace(log_, outputs_of(graph), only_ ? &only_->outputs() : nullptr, begun_);
  if (only_ && !values_->has_any())
    throw InputError(options_.words.only + ": the recording has no values of these tasks to compare with");
  if (values_->has_any()) sinks.push_back(&*values_);
  run_.emplace(std::move(loaded_), GraphRunOptions{.sinks = std::move(sinks), .misses = misses_, .truth = truth});
  if (begun_ > Duration{}) restore_recorded(*run_, *noted_, log_, begun_, std::move(origin));
  if (log_.rest_begun()) run_->sinks().judge_before(*log_.rest_begun());
  attended_.emplace(run_->executor(), log_, !only_);
}

const RunEnd& Replayer::attend(const Attendant& attendant) {
  const auto start = std::chrono::steady_clock::now();
  end_ = jarol::attend(
      *attended_, [] {}, attendant.wish, attendant.on_rest, attendant.on_end, attendant.on_stuck);
  if (end_->failure) std::rethrow_exception(end_->failure);
  seconds_ = std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return *end_;
}

// By the digests on the way and by each recorded value.
void Replayer::compare() {
  Comparison& comparison = attended_->comparison;
  const bool compared_all = end_->hangs || !values_->has_any() || run_->sinks().why_not_all(*values_).empty();
  if (!compared_all && comparison.evidence == Evidence::same) comparison.evidence = Evidence::unknown;
  const Differences& differences = values_->differences();
  if (!differences.first() || comparison.interrupted || !compared_all) return;
  comparison.evidence = Evidence::diverged;
  // where somebody has changed a recorded value its digests are still those of the run
  if (comparison.same_until) comparison.same_until = std::min(*comparison.same_until, differences.first()->instant);
}

RunVerdict Replayer::judge(Duration reached) {
  const Report& report = run_->report();
  const Comparison& comparison = attended_->comparison;
  const RecordingHeader& header = log_.header();
  RunVerdict verdict;
  if (!end_->hangs)
    verdict.expectations = run_->sinks().judge(
        judged_until(log_.rest_begun(), header.until, report.covered),
        why_cut_short(judged_until(log_.rest_begun(), header.until, reached), header.until, header.mission));
  judge_no_other_truth(run_->graph(), comparison.evidence, is_other_text_, verdict.expectations);
  verdict.left_out = find_left_out(run_->graph(), report);
  // what is the same to the last value, in part too, is what that vehicle was flown by
  const bool is_of_run = comparison.evidence == Evidence::same ||
                         (world_ == RecordedWorld::truth && comparison.evidence != Evidence::diverged);
  if (!is_of_run || comparison.interrupted) return verdict;
  verdict.mishaps = read_mishaps(log_.recording());
  if (const auto rest = read_rest(log_.recording()); rest && !rest->reached && log_.end())
    verdict.not_at_rest = "the vehicle of the run did not come to rest";
  return verdict;
}

ReplayOutcome Replayer::finish() {
  Comparison& comparison = attended_->comparison;
  comparison.interrupted = comparison.interrupted || end_->hangs;
  if (!comparison.interrupted && !only_) log_.require_all_taken();
  std::string unwritten;
  try {
    if (!end_->hangs) run_->sinks().close();
  } catch (const std::exception& error) { unwritten = error.what(); }
  compare();
  const Report& report = run_->report();
  const Duration reached = comparison.interrupted || !log_.end() ? report.simulated : Duration(log_.end()->simulated);
  return {.run = {.state = run_->state(),
                  .report = report,
                  .rest = run_->rest(),
                  .failsafe = run_->failsafe(),
                  .noted = *noted_,
                  .end = *end_,
                  .seconds = seconds_,
                  .begun = begun_,
                  .simulated = reached,
                  .verdict = judge(reached),
                  .unwritten = std::move(unwritten)},
          .comparison = comparison,
          .differences = values_->differences()};
}

}  // namespace jarol
