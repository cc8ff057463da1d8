// Runs a graph: on the virtual clock as fast as possible, in lockstep with the external systems in process; or instant
// by instant when the real clock has reached it.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graph/analysis/threads.h"
#include "runtime/dispatch/shared_stages.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/communicators.h"
#include "runtime/machine/real_clock.h"
#include "runtime/machine/running_task.h"

namespace jarol {
namespace analysis {
class Schedule;
}
class TaskGuard;

struct ExecutorOptions {
  bool digest = true;
  Recorder* recorder = nullptr;
  bool record_truth = false;  // the recorder gets true values too, for the conditions of the graph: see Expectations
  bool record_all_truth = false;                  // and of all vehicles, whatever the conditions ask for
  std::span<const expect::Condition> measured{};  // conditions beside those of the graph, likewise
  std::size_t workers = 1;  // threads that run tasks, the caller's among them; the outcome is the same for any number
  Sharing sharing = Sharing::if_it_pays;
  RealClock* clock = nullptr;                       // none: the virtual clock; with one there is a single worker
  std::span<const analysis::TaskThread> threads{};  // on the real clock: who runs the tasks; none: the caller
  Recorder* log = nullptr;                          // gets log_outputs: what the run has from outside
  // A replay on the virtual clock by a single worker: these come late or not at all. It goes as far as it is let, for
  // the run that it repeats may have known of a fault that stops it only at a later instant.
  std::optional<std::span<const Miss>> misses{};
  // On the virtual clock: what is late and left out there is so in the run; it outlives it.
  analysis::Schedule* schedule = nullptr;
  // On the virtual clock by a single worker, of a plan with Spacing::pages: tasks run under it; it outlives the run.
  TaskGuard* guard = nullptr;
};

class Executor {
 public:
  /// One ExternalSystem per distributer of the graph, in its order. Graph and recorder outlive the executor.
  Executor(PlanOfRun plan, std::vector<std::unique_ptr<ExternalSystem>> systems, const ExecutorOptions& options = {});

  /// Before the first instant: the run has other parameters of that task than its graph; a value of their type.
  void start_with(std::size_t task, const void* parameters) { run_.state.start_with(task, parameters); }

  /// Covers the instants from where it stands to before `end`, or stops at a fault. In pieces it is the same run.
  void run_until(Duration end);
  /// The same without waiting for threads that run tasks, which `finish` does.
  void cover(Duration end);

  /// On the real clock, of a graph with `at_end`: `cover` returns before its next instant. Any thread.
  void ask_for_rest() { rest_asked_.store(true, std::memory_order_relaxed); }
  /// After `cover`: from the next instant on, which is returned, `at_end` commands. None: the graph states nothing, a
  /// fault has stopped the run, or it was interrupted.
  std::optional<Duration> begin_rest();
  /// After `begin_rest`: covers the instants until the vehicle is at rest, or for the longest time that this may take.
  void cover_rest() { cover(communicators_.end_of_rest()); }
  bool resting() const { return communicators_.resting(); }
  /// Once the run has ended.
  std::optional<RestReport> rest() const { return communicators_.rest(run_.report.simulated); }

  /// No more is handed over, but now, once, all that is safe: on the real clock to every external system, else to those
  /// that outlive the run. Whatever thread calls, while another one may cover instants; what that one has begun to hand
  /// over is waited for until then.
  void close(Futex::Time patience = Futex::Time::max());
  /// Waits for threads that run tasks; what they still run at that time. Once done the report is
  /// complete.
  Finish finish(std::optional<Futex::Time> patience = {});
  /// What the thread that covers instants runs now, and what workers beside it do.
  std::vector<HangingTask> running() const;
  /// What it holds up: the thread that keeps the time, or one of several.
  std::optional<Holdup> holdup() const;
  /// The distributer that it is in a call of.
  std::optional<Call> call() const;

  /// What the run is, between two pieces of it on the virtual clock. Restored, it is that of the same graph but for
  /// parameters, and nobody runs it meanwhile. Throws NotSaveable.
  void serialize(Archive& archive);

  /// The logical instant reached, for progress; may be read by another thread.
  Duration now() const { return now_.load(std::memory_order_relaxed); }

  /// Ends run_until after the instant under way; may be called from another thread or a signal handler.
  void interrupt() { interrupted_.store(true, std::memory_order_relaxed); }

  /// The instant that is covered next, between two pieces of the run.
  Duration next_instant() const { return run_.state.release_queue.next(); }

  const Report& report() const { return run_.report; }
  const std::vector<FailsafeReport>& failsafe() const { return communicators_.failsafe(); }
  const RunState& state() const { return run_.state; }

  /// How the stages were shared among several workers; null with one.
  const StageTeam* team() const { return team_; }

  /// What this machine does not permit the threads that run tasks; a plain sentence each.
  std::vector<std::string> refusals() const { return dispatcher_->refusals(); }

  /// What a communicator last published, or its initial value.
  const void* last_value(std::size_t communicator) const { return run_.state.last[communicator]; }

 private:
  std::unique_ptr<Dispatcher> make_dispatcher(const ExecutorOptions& options);
  void walk(Duration end);
  bool wait_until(Duration instant);
  bool step(const Now& now);
  bool has_stopped() const { return stops_ && run_.report.stopped; }
  bool must_return() const {
    return interrupted_.load(std::memory_order_relaxed) || (rest_asked_.load(std::memory_order_relaxed) && !resting());
  }
  [[gnu::cold]] void log_checkpoint(Duration instant);
  [[gnu::cold]] void hand_on(Duration instant);
  std::optional<Holdup> holdup_of_thread() const;
  const Task* task_of(const RunningTask* running) const;
  HangingTask hanging(const Task& task) const;

  Run run_;
  Communicators communicators_;
  RealClock* const clock_;  // null: the virtual clock
  const bool stops_;        // at a fault that says so
  const StageTeam* team_ = nullptr;
  Duration hand_on_due_{};  // on the real clock
  std::unique_ptr<Dispatcher> dispatcher_;
  std::atomic<Duration> now_{};
  std::atomic<Duration> cover_end_{};
  std::atomic<bool> interrupted_{false};
  std::atomic<bool> rest_asked_{false};
  std::atomic<const RunningTask*> running_{nullptr};  // of the thread that covers instants, meanwhile
};

}  // namespace jarol
