#include "runtime/execute/executor.h"

#include <cassert>

#include "graph/floating_point.h"
#include "runtime/dispatch/in_line.h"
#include "runtime/dispatch/on_threads.h"
#include "runtime/dispatch/one_by_one.h"
#include "runtime/dispatch/task_guard.h"

namespace jarol {
namespace {

// On the real clock the vehicle can be brought to rest, and a run or a replay of it always has a digest.
Run::Options options_of_run(const ExecutorOptions& options) {
  return {.digest = options.digest || options.clock != nullptr || options.misses,
          .recorder = options.recorder,
          .log = options.log,
          .may_rest = options.clock != nullptr};
}

Truth truth_of(const ExecutorOptions& options) {
  if (!options.record_truth) return Truth::none;
  return options.record_all_truth ? Truth::all : Truth::of_conditions;
}

// The calling thread covers instants while this lives.
struct RunningHere {
  explicit RunningHere(std::atomic<const RunningTask*>& to) : running(to) { running.store(&running_task); }
  ~RunningHere() { running.store(nullptr); }
  std::atomic<const RunningTask*>& running;
};

}  // namespace

Executor::Executor(PlanOfRun plan, std::vector<std::unique_ptr<ExternalSystem>> systems, const ExecutorOptions& options)
    : run_(std::move(plan), options_of_run(options)),
      communicators_(run_, std::move(systems), truth_of(options), options.measured),
      clock_(options.clock),
      stops_(!options.misses),
      dispatcher_(make_dispatcher(options)) {
  if (clock_ == nullptr) return;
  for (Recorder* recorder : {options.recorder, options.log})
    if (recorder != nullptr) recorder->never_wait();
}

std::unique_ptr<Dispatcher> Executor::make_dispatcher(const ExecutorOptions& options) {
  assert(!options.misses || (options.clock == nullptr && options.workers == 1));
  assert(options.schedule == nullptr || (options.clock == nullptr && !options.misses));
  assert(options.guard == nullptr || (options.clock == nullptr && options.workers == 1));
  if (options.guard != nullptr) options.guard->take(run_.state);
  if (options.misses) return std::make_unique<OneByOne<AsLogged>>(run_, AsLogged(run_.graph, *options.misses));
  if (!options.threads.empty()) return std::make_unique<OnThreads>(run_, *options.clock, options.threads);
  if (options.clock != nullptr) return std::make_unique<OneByOne<InTime>>(run_, InTime(run_.graph, *options.clock));
  std::unique_ptr<Dispatcher> alone = make_in_line(run_);
  if (options.schedule != nullptr)
    alone = std::make_unique<OneByOne<AsScheduled>>(run_, AsScheduled(*options.schedule));
  if (options.workers == 1 && options.sharing != Sharing::measure) return alone;
  auto shared =
      std::make_unique<SharedStages>(run_, options.workers, options.sharing, std::move(alone), options.schedule);
  team_ = &shared->team();
  return shared;
}

void Executor::run_until(Duration end) {
  try {
    cover(end);
  } catch (...) {
    // an external system is lost; what was released before is part of the run
    finish();
    throw;
  }
  finish();
}

void Executor::cover(Duration end) {
  if (has_stopped()) return;
  cover_end_.store(end, std::memory_order_relaxed);
  const MemoryScope scope(no_heap());  // a task with a heap has a scope of its own
  const RunningHere here(running_);
  const DefaultFloatingPoint arithmetic;
  walk(end);
}

void Executor::walk(Duration end) {
  ReleaseQueue& queue = run_.state.release_queue;
  while (queue.next() < end) {
    if (must_return()) return;
    const Duration instant = queue.next();
    if (clock_ != nullptr && !wait_until(instant)) return;
    if (run_.log.is_checkpoint_due(instant)) log_checkpoint(instant);
    now_.store(instant, std::memory_order_relaxed);
    if (!step(run_.publisher.at(instant, queue.take()))) return;
    Report& report = run_.report;
    report.instants += 1;
    report.simulated = instant;
    report.covered = instant + Duration(1);
    communicators_.require_none_lost();
    if (has_stopped() || communicators_.has_come_to_rest(instant)) return;
  }
  run_.report.simulated = end;
  run_.report.covered = end;
  now_.store(end, std::memory_order_relaxed);
}

// False: the run ends before the instant.
bool Executor::wait_until(Duration instant) {
  clock_->wait_until(instant, interrupted_);
  if (must_return()) return false;
  if (instant >= hand_on_due_) hand_on(instant);
  dispatcher_->settle(instant);
  return !has_stopped();
}

// Now and then those who look on see all that was published, however little it is.
void Executor::hand_on(Duration instant) {
  Recorder* const recorder = run_.publisher.recorder();
  hand_on_due_ = instant + (recorder != nullptr ? recorder->hand_on_period() : Duration(std::chrono::seconds(1)));
  if (recorder != nullptr) recorder->hand_on();
}

// False: the run was closed before anything of the instant took place.
bool Executor::step(const Now& now) {
  Communicators::Turn communicators(communicators_, now);
  if (communicators.closed()) return false;
  if (!run_.plan.let_ends.empty()) dispatcher_->end_lets(now);
  communicators.act(now);
  dispatcher_->release(now);
  return true;
}

// When all that was due before the instant is known, but for tasks on threads that have not ended.
void Executor::log_checkpoint(Duration instant) {
  const Duration settled = dispatcher_->settled(instant);
  run_.log.checkpoint(instant, settled, run_.report.digest, settled == instant);
}

}  // namespace jarol
