// Runs a graph: on the virtual clock as fast as possible, in lockstep with the external systems in process; or instant
// by instant when the real clock has reached it.
#pragma once

#include <atomic>
#include <span>
#include <string>
#include <vector>

#include "runtime/channels.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/fault_summary.h"
#include "runtime/execute/rest.h"
#include "runtime/execute/safe_commands.h"
#include "runtime/execute/stage_team.h"
#include "runtime/execute/task_threads.h"
#include "runtime/machine/real_clock.h"
#include "runtime/machine/running_task.h"
#include "runtime/record/log.h"
#include "runtime/record/recorder.h"
#include "runtime/state/run_state.h"

namespace jarol {

/// One line, as it goes to people: "task 'a' activation 3 at 0.03s: ...".
std::string to_text(const Fault& fault);

struct Report {
  static constexpr std::size_t faults_kept = 1000;

  std::uint64_t digest = 0;
  Duration simulated{};
  Duration covered{};             // the instants before it were run
  std::uint64_t activations = 0;  // released tasks that ran
  std::uint64_t instants = 0;     // distinct instants at which anything was due
  std::vector<Fault> faults;      // the first of them; all are counted
  std::uint64_t fault_count = 0;
  std::uint64_t non_finite_inputs = 0;  // from outside, not taken
  bool stopped = false;                 // by a fault
  FaultSummary fault_summary;           // of all faults
  std::vector<std::uint64_t> left_out;  // per task: activations without outputs

  Report() { faults.reserve(faults_kept); }
  void add(Fault fault) {
    fault_summary.add(fault);
    if (faults.size() < faults_kept) faults.push_back(std::move(fault));
    ++fault_count;
  }
};

struct ExecutorOptions {
  bool digest = true;
  Recorder* recorder = nullptr;
  bool record_truth = false;  // the recorder gets true values too, for the conditions of the graph: see Expectations
  std::size_t workers = 1;    // threads that run tasks, the caller's among them; the outcome is the same for any number
  Sharing sharing = Sharing::if_it_pays;
  RealClock* clock = nullptr;                       // none: the virtual clock; with one there is a single worker
  std::span<const analysis::TaskThread> threads{};  // on the real clock: who runs the tasks; none: the caller
  Recorder* log = nullptr;                          // gets log_outputs: what the run has from outside
  // A replay on the virtual clock by a single worker: these come late or not at all. It goes as far as it is let, for
  // the run that it repeats may have known of a fault that stops it only at a later instant.
  std::optional<std::span<const Miss>> misses{};
};

class Executor {
 public:
  /// One Channels per distributer of the graph, in its order. Graph and recorder outlive the executor.
  Executor(PlanOfRun plan, std::vector<std::unique_ptr<Channels>> channels, const ExecutorOptions& options = {});

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
  void cover_rest();
  bool resting() const { return resting_.load(std::memory_order_relaxed); }
  /// Once the run has ended.
  std::optional<RestReport> rest() const;

  /// No more is handed over, but now, once, all that is safe: on the real clock to every external system, else to those
  /// that outlive the run. Whatever thread calls, while another one may cover instants; what that one has begun to hand
  /// over is waited for until then.
  void close(Futex::Time patience = Futex::Time::max());
  /// Waits for threads that run tasks; what they still run at that time. Once done the report is
  /// complete.
  Finish finish(std::optional<Futex::Time> patience = {});
  /// What the thread that covers instants runs now, and what workers beside it do.
  std::vector<HangingTask> running() const;
  /// The same where it is the thread that keeps the time.
  std::optional<Holdup> holdup() const;

  /// The logical instant reached, for progress; may be read by another thread.
  Duration now() const { return Duration(now_.load(std::memory_order_relaxed)); }

  /// Ends run_until after the instant under way; may be called from another thread or a signal handler.
  void interrupt() { interrupted_.store(true, std::memory_order_relaxed); }

  const Report& report() const { return report_; }
  const std::vector<SafeCommandReport>& safe_commands() const { return safe_commands_.reports(); }
  const RunState& state() const { return state_; }

  /// How the stages were shared among several workers; null with one.
  const StageTeam* team() const { return team_.get(); }

  /// What this machine does not permit the threads that run tasks; a plain sentence each.
  std::vector<std::string> refusals() const;

  /// What a communicator last published, or its initial value.
  const void* last_value(std::size_t communicator) const { return state_.last[communicator]; }

 private:
  template <bool Digest, bool Record, bool MayMiss>
  void walk(Duration end);
  template <bool Digest, bool Record, bool MayMiss>
  bool step_instant(std::int64_t instant);
  template <bool Digest, bool Record>
  void publish(const Publish& what, std::int64_t instant, std::uint64_t instant_term);
  template <bool Digest, bool Record, bool MayMiss>
  void run_segment(const Plan::Segment& segment, const Tick& tick, std::uint64_t instant_term);
  template <bool Digest, bool Record, bool MayMiss>
  void run_stages(std::int64_t instant, std::uint64_t instant_term);
  template <bool Digest, bool Record>
  void run_stages_shared(std::int64_t instant, std::uint64_t instant_term);
  template <bool Digest, bool Record>
  void run_level_shared(std::uint32_t level, std::uint64_t instant_term);
  template <bool Digest, bool Record>
  void publish_one_by_one(const Plan::Group& group, std::int64_t instant, std::uint64_t instant_term);
  bool has_late_fault(const LetEnd& let_end, std::int64_t instant);
  const Activation* run_bodies(const Activation* next, const Activation* last, const Tick& tick);
  const Task* task_of(const RunningTask* running) const;
  HangingTask hanging(const Task& task) const;
  bool must_return() const {
    return interrupted_.load(std::memory_order_relaxed) || (rest_asked_.load(std::memory_order_relaxed) && !resting());
  }
  void tell_bad_outcomes();
  void start_groups(std::int64_t instant);
  void gather_communicators();
  void hand_over(const CommunicatorAction& out, Duration instant);
  void take(const CommunicatorAction& in, Duration instant);
  Outcome run_in_time(const Activation& activation, const Tick& tick);
  Outcome run_as_logged(const Activation& activation, const Tick& tick);
  [[gnu::cold]] void on_bad_outcome(const Activation& activation, Outcome outcome, const Tick& tick);
  [[gnu::cold]] void record_fault(std::uint32_t task, std::int64_t instant);
  void add_fault(std::uint32_t task, std::int64_t activation, std::int64_t instant, const std::string& cause);
  void begin_log();
  void log_late(std::uint32_t task, std::int64_t activation, std::optional<Duration> ended_after, std::int64_t instant);
  void log_miss(const Miss& miss, std::int64_t instant);
  void log_rest();
  [[gnu::cold]] void log_checkpoint(std::int64_t instant);
  void record_true_values(std::int64_t instant);

  // with threads that run tasks
  void begin_threads();
  void settle(std::int64_t instant);
  void end_let(const LetEnd& let_end, std::int64_t instant);
  void release_on_threads(std::int64_t instant);
  void publish_in_time(const Publish& what, std::int64_t instant);
  void on_bad_outcome_in_time(std::uint32_t task, Outcome outcome, std::int64_t instant);

  const PlanOfRun shared_plan_;
  const Plan& plan_;
  const Graph& graph_;
  RunState state_;
  std::vector<std::unique_ptr<Channels>> channels_;
  ExecutorOptions options_;
  std::span<const std::uint32_t> due_;  // groups due now, in the calendar
  struct Cursor {
    const Plan::Segment* next = nullptr;
    const Plan::Segment* last = nullptr;
  };
  std::vector<Cursor> cursors_;                        // of the groups due now: what is still to be run
  std::vector<const Plan::Segment*> in_stage_;         // of the groups due now, null where none
  std::vector<Tick> ticks_;                            // of the groups due now
  std::vector<const CommunicatorAction*> outs_, ins_;  // due now
  std::vector<StageTeam::Item> bad_items_;             // of the stage under way, where workers share it
  std::unique_ptr<StageTeam> team_;                    // null: one worker
  SafeCommands safe_commands_;
  std::uint64_t refused_inputs_ = 0;  // values of `in` channels that were not finite
  Report report_;
  std::atomic<std::int64_t> now_{0};
  std::atomic<bool> interrupted_{false};
  std::atomic<std::int64_t> cover_end_{0};
  std::atomic<bool> rest_asked_{false}, resting_{false};
  std::unique_ptr<Rest> rest_;  // null: the virtual clock, or the graph states none
  Duration rest_begun_{};
  bool rest_reached_ = false;
  // of the channels, by an instant that covers them or by whoever closed the run
  enum class Use : std::uint32_t { free, covering, closed };
  class ChannelsInUse;
  std::atomic<Use> use_{Use::free};
  std::atomic<const RunningTask*> running_{nullptr};  // of the thread that covers instants, meanwhile
  std::vector<std::uint32_t> log_outputs_;            // per communicator: that of the log
  std::uint32_t log_misses_ = 0;               // the log's output for them; those for checkpoints and RestBegin follow
  std::int64_t checkpoint_due_ = 0;            // if there is a log
  std::unique_ptr<MissedActivations> missed_;  // null: this is no replay
  std::optional<Duration> ended_after_;        // of the activation that was found late last, from its release
  std::unique_ptr<TaskThreads> threads_;       // null: tasks run on the caller's
  std::vector<const Activation*> under_way_;   // data-flow tasks on threads that were not yet seen to end
  struct WatchedVehicle {
    std::size_t distributer;
    Value values;
  };
  std::vector<WatchedVehicle> watched_;  // whose true values are recorded
};

}  // namespace jarol
