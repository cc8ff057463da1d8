#include "distributers/session/runner.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "distributers/session/real_time.h"
#include "distributers/session/record_run.h"
#include "distributers/session/rest_verdict.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "runtime/execute/log_end.h"

namespace jarol {
namespace {

void require_clock(const RunOptions& options, const Loaded& loaded) {
  if (options.real_clock) return;
  if (const Distributer* distributer = find_in_real_time(loaded))
    throw NeedsRealClock("distributer '" + distributer->name + "' has a link to what goes on by itself; run it with " +
                         options.words.real_clock);
}

// What the virtual clock alone has.
void require_options_of_clock(const RunOptions& options) {
  if (options.workers < 1 || options.workers > max_workers)
    throw NotExecutable("a run has 1 to " + std::to_string(max_workers) + " workers, not " +
                        std::to_string(options.workers));
  if (!options.real_clock) return;
  if (options.workers > 1)
    throw NotExecutable(options.words.workers + " belongs to the virtual clock; the real one goes by 'platform'");
  if (!options.execution.empty())
    throw InputError(options.words.execution +
                     " belongs to the virtual clock; on the real one activations take the time that they "
                     "take");
}

void require_end(const RunOptions& options, Duration begun) {
  if (options.end < begun)
    throw WrongInstant("the run ends at " + seconds_text(options.end) + " s, and goes on from " + seconds_text(begun) +
                       " s; say until when, as in " + options.words.end);
}

Duration begin_of(const RunOptions& options) {
  return options.resumed != nullptr ? options.resumed->instant() : Duration{};
}

void add_text(std::string& all, const std::string& text) { all += (all.empty() ? "" : "; ") + text; }

}  // namespace

Runner::Runner(Loaded loaded, RunOptions options, const OnGuard& on_guard)
    : options_(std::move(options)),
      name_(loaded.files.front()->name),
      begun_(begin_of(options_)),
      until_(options_.end) {
  require_runnable(options_, loaded);
  if (!options_.threads) {
    execution_.emplace(options_.execution, *loaded.graph, options_.seed, options_.words.execution);
    recording_ = make_recording(options_, loaded);
  }
  if (options_.real_clock) make_clock(loaded);
  on_guard(guard_ ? &*guard_ : nullptr);
  noted_.emplace(*loaded.graph);
  if (options_.threads)
    make_threads(std::move(loaded));
  else
    make_exotasks(std::move(loaded));
}

Runner::~Runner() = default;

void Runner::require_runnable(const RunOptions& options, const Loaded& loaded) {
  require_end(options, begin_of(options));
  require_clock(options, loaded);
  require_options_of_clock(options);
}

void Runner::make_clock(const Loaded& loaded) {
  const Graph& graph = *loaded.graph;
  RealTimeOptions real_time = options_.real_time;
  longest_rest_ = jarol::longest_rest(graph);
  if (!options_.threads) {
    require_executable(name_, graph, options_);
    task_threads_ = threads_for(name_, graph, real_time, options_.words);
    clock_.emplace(graph.tasks.size(), real_time);
  }
  guard_.emplace(loaded, options_.no_guardian, real_time.priority, options_.note);
}

void Runner::make_threads(Loaded loaded) {
  loaded_ = std::move(loaded);
  std::vector<RecordSink*> sinks = options_.sinks;
  noted_->add_to(sinks);
  auto made =
      std::make_unique<ThreadsRun>(loaded_, sinks, options_.end, longest_rest_, options_.real_time, options_.note);
  threads_ = made.get();
  joined_ = std::move(made);
}

void Runner::make_exotasks(Loaded loaded) {
  std::vector<RecordSink*> sinks = options_.sinks;
  noted_->add_to(sinks);
  if (recording_) sinks.push_back(recording_->publications());
  RunOrigin origin = origin_of(loaded, options_.overrides, options_.seed, options_.fed);
  auto made = std::make_unique<GraphRun>(
      std::move(loaded),
      GraphRunOptions{.sinks = sinks,
                      .workers = options_.workers,
                      .clock = clock_ ? &*clock_ : nullptr,
                      .threads = task_threads_,
                      .log = recording_ ? recording_->recorder() : nullptr,
                      .schedule = execution_->schedule(),
                      .times = execution_->times(),
                      .guard = options_.guard,
                      .truth = options_.truth || (recording_ && !recording_->header().truths.empty()),
                      .watched = options_.watched});
  exotasks_ = made.get();
  joined_ = std::move(made);
  exotasks_->set_origin(std::move(origin));
  if (clock_) {
    attended_ = std::make_unique<ExecutorRun>(exotasks_->executor(), options_.end, longest_rest_,
                                              [this](Duration begun) { joined_->sinks().judge_before(begun); });
  } else {
    add_stops();
  }
}

void Runner::add_stops() {
  auto saved = std::make_unique<SavedRun>(*exotasks_, *noted_, options_.end, options_.pace);
  saved_ = saved.get();
  attended_ = std::move(saved);
  for (const Stop& stop : options_.stops) saved_->add(stop);
  if (options_.resumed != nullptr) restore(*exotasks_, *noted_, *options_.resumed, options_.resumed_from);
  if (const Duration each = options_.recording.checkpoints; recording_ && each > Duration{})
    saved_->take_each(options_.words.checkpoints, each,
                      [this](const Checkpoint& checkpoint) { save_in_recording(checkpoint); });
  saved_->require_saveable(begun_, options_.end);
}

void Runner::save_in_recording(const Checkpoint& checkpoint) {
  const Archive::Bytes state = checkpoint.to_bytes();
  recording_->add_checkpoint(checkpoint.instant(), {reinterpret_cast<const char*>(state.data()), state.size()});
}

RunOutcome Runner::run(const Attendant& attendant) {
  begin();
  attend(attendant);
  return finish();
}

void Runner::begin() {
  const std::optional<int> priority = clock_ ? clock_->options().priority : options_.real_time.priority;
  if (options_.real_clock) take_priority(priority);
  connect();
  if (options_.real_clock) take_priority_above(priority);
}

void Runner::connect() {
  joined_->connect(options_.note);
  if (recording_) recording_->open();
  if (recording_ && options_.resumed != nullptr) save_in_recording(*options_.resumed);
}

void Runner::start() {
  if (clock_) {
    std::vector<std::string> refusals = clock_->prepare_thread();
    for (const std::string& refusal : exotasks_->executor().refusals())
      if (std::find(refusals.begin(), refusals.end(), refusal) == refusals.end()) refusals.push_back(refusal);
    for (const std::string& refusal : refusals) options_.note(refusal);
    clock_->start();
  }
  if (guard_) guard_->arm();
}

void Runner::stop(Duration until) {
  until_ = until;
  exotasks_->executor().close();
  exotasks_->executor().finish();
  joined_->disconnect();
  if (guard_) guard_->close();
  end_.emplace().ending = Ending::over();
}

const RunEnd& Runner::attend(const Attendant& attendant) {
  auto start = std::chrono::steady_clock::now();
  AttendedRun& attended = threads_ != nullptr ? static_cast<AttendedRun&>(*threads_) : *attended_;
  end_ = jarol::attend(
      attended,
      [&] {
        this->start();
        start = std::chrono::steady_clock::now();
      },
      [&] {
        if (guard_) guard_->look(attendant.note);
        return attendant.wish();
      },
      attendant.on_rest, attendant.on_end, attendant.on_stuck);
  // a link that is in use can't be finished, and what it has to be handed is left to the guardian
  if (end_->links_are_free()) joined_->disconnect(*end_);
  if (guard_ && end_->links_are_free()) guard_->close();
  seconds_ = std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return *end_;
}

RunOutcome Runner::finish() {
  std::string unwritten;
  const auto attempt = [&](const auto& to_do) {
    try {
      to_do();
    } catch (const std::exception& error) { add_text(unwritten, error.what()); }
  };
  // of a run that has not ended a recording is good up to its last chunk
  if (!end_->hangs) {
    attempt([&] { joined_->close_sinks(); });
    const Ending ended = end_->before_rest.value_or(end_->ending);
    const bool by_signal = ended.cause == Ending::Cause::signal;
    if (recording_) attempt([&] { recording_->close(log_end_of(joined_->report()), by_signal ? ended.reason : ""); });
  }
  return {.state = joined_->state(),
          .report = joined_->report(),
          .rest = joined_->rest(),
          .failsafe = failsafe_after(*end_, graph(), joined_->systems(), joined_->failsafe()),
          .noted = *noted_,
          .end = *end_,
          .clock = clock_ ? &*clock_ : nullptr,
          .threads = threads_ != nullptr ? &threads_->core() : nullptr,
          .guard = guard_ ? &*guard_ : nullptr,
          .workers = options_.workers,
          .team = exotasks_ != nullptr ? exotasks_->executor().team() : nullptr,
          .links = joined_->link_reports(),
          .seconds = seconds_,
          .begun = begun_,
          .simulated = joined_->report().simulated,
          .verdict = joined_->judge(until_, *end_),
          .true_states = end_->hangs ? std::vector<TrueState>{} : find_true_states(graph(), joined_->systems()),
          .unwritten = std::move(unwritten),
          .unsaved = saved_ != nullptr ? saved_->lost() : ""};
}

}  // namespace jarol
