// The threads on which tasks run in real time, where it takes more than one: of several cores, or of tasks that preempt
// each other. Who runs the graph, here the dispatcher, does all that takes no logical time: he latches inputs at the
// release and publishes outputs when they are due. The threads run what was released, and hand a data-flow task's
// outputs to those that follow it at its instant. No locks: who may touch what goes by the state of each job.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "graph/analysis/threads.h"
#include "runtime/machine/futex.h"
#include "runtime/machine/memory.h"
#include "runtime/machine/real_clock.h"
#include "runtime/run/ending.h"
#include "runtime/state/run_state.h"

namespace jarol {

class PreemptiveThreads {
 public:
  /// Begins the threads, with the priorities, CPUs and slack of the clock's options. All outlive them. Throws
  /// InputError for an input of changing size, and for a priority that leaves none for the threads;
  /// Unfinished where the system has no more threads.
  PreemptiveThreads(RunState& state, RealClock& clock, std::span<const analysis::TaskThread> threads);
  ~PreemptiveThreads();
  PreemptiveThreads(const PreemptiveThreads&) = delete;
  PreemptiveThreads& operator=(const PreemptiveThreads&) = delete;

  /// What this machine does not permit, a plain sentence each.
  const std::vector<std::string>& refusals() const { return refusals_; }

  // All below: the dispatcher.

  /// Latches the inputs of a task released now; it runs after `release`. Or it is left out: `overrun` where the
  /// activation before it still runs, `left_out` where it is to be skipped.
  Outcome add(std::size_t task, const Tick& tick);
  /// Has the threads run all that was added at this instant.
  void release();

  /// How the newest activation ended; none where it still runs, unless it is `due`: then it is late, whenever it ends.
  std::optional<Outcome> outcome(std::size_t task, bool due);
  /// The newest activation, and how long after its release it ended; none where it had not when it was due.
  const Tick& tick(std::size_t task) const { return jobs_[task].newest; }
  std::optional<Duration> ended_after(std::size_t task) const;
  const void* out(std::size_t task) const { return jobs_[task].memory.out; }
  /// Before its next activation the task is put back to before the newest; `skip` leaves that one out too, `restart`
  /// has it begin anew.
  void undo(std::size_t task, OnFault on_fault);

  /// The one that was released first of those that have not ended and wait for no other; any thread may ask.
  std::optional<HangingTask> first_under_way() const;
  /// Waits until nothing runs any more; what still runs at that time.
  std::vector<HangingTask> drain(std::optional<Futex::Time> patience = {});

 private:
  // idle: the dispatcher's. released: the thread's. ended: the dispatcher's, who has not looked yet. abandoned: the
  // thread's, but what comes of it no longer counts.
  enum class State : std::uint32_t { idle, released, ended, abandoned };

  struct Job;
  // A task that may follow another at its instant, and what it latches of it then.
  struct Follower {
    Job* job = nullptr;
    bool elsewhere = false;  // in another thread
    std::vector<Copy> copies;
  };
  struct alignas(apart) Job {
    Thunk run = nullptr;
    TaskMemory memory;  // `in` is what was latched
    const std::byte* published = nullptr;
    std::byte* latched = nullptr;
    std::size_t in_size = 0;
    std::size_t task = 0;
    std::size_t turn = 0;  // among those released at one instant
    std::size_t thread = 0;
    Duration deadline{};
    std::vector<Follower> followers;
    std::vector<Job*> producers;  // in other threads, that it may follow

    // the dispatcher's
    Tick newest;
    Outcome left_out = Outcome::good;
    bool abandoned = false;
    bool to_undo = false, to_skip = false, to_restart = false;

    Tick tick;                                    // of the activation that runs
    std::atomic<Duration> instant{Duration(-1)};  // of its release
    std::atomic<State> state{State::idle};
    std::atomic<std::uint32_t> awaited{0};  // producers of its instant, in other threads, that have not ended
    // of the thread, then of the dispatcher
    bool began = false;
    Outcome outcome = Outcome::good;
    Duration end{};
  };
  struct alignas(apart) Core {
    std::atomic<std::int64_t> busy{0};  // ns that tasks have run there
  };
  // A thread and the jobs given to it, in a ring; null is the last one.
  struct alignas(apart) Thread {
    std::vector<Job*> ring;
    std::uint32_t given = 0;
    Core* core = nullptr;
    std::atomic<std::uint32_t> released{0};  // jobs that it may take
    alignas(apart) std::atomic<std::uint32_t> done{0};
    std::atomic<bool> watched{false};  // the dispatcher waits for it
    std::thread thread;
  };

  void make_jobs();
  void connect_followers();
  void begin(std::span<const analysis::TaskThread> threads);
  void end();
  void give(Thread& thread, Job* job);
  static void let_go(Thread& thread);
  void run(Thread& thread);
  void execute(Job& job, Core& core);
  static void hand_on(const Job& job, Duration instant, bool good);

  const Graph& graph_;
  RunState& state_;
  RealClock& clock_;
  std::vector<std::byte> latched_;
  std::vector<Job> jobs_;  // per task
  std::vector<Core> cores_;
  std::vector<Thread> threads_;
  std::vector<Job*> added_;
  std::vector<std::string> refusals_;
};

}  // namespace jarol
