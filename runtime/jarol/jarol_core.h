// The Jarol core on ordinary threads, in real time: a sensor thread keeps the time, a core thread runs the tasks, an
// actuator thread and a terminal thread carry values to and from the outside. Ports and signals tie them. The graph and
// its tasks are those that run as exotasks; what is not kept is determinism: which value a task reads depends on when
// threads run.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/execute/attend.h"
#include "runtime/execute/failsafe.h"
#include "runtime/execute/rest.h"
#include "runtime/external_system.h"
#include "runtime/jarol/push_port.h"
#include "runtime/jarol/signal.h"
#include "runtime/jarol/time_trigger.h"
#include "runtime/machine/histogram.h"
#include "runtime/run/run.h"

namespace jarol {

/// What a run on threads reports beside the report.
struct ThreadsReport {
  std::uint64_t rounds = 0;           // of the core
  std::uint64_t core_busy = 0;        // signals of the sensor thread that found the core at work
  std::uint64_t unawaited_ticks = 0;  // that found the sensor thread at work; their rounds are left out
  Histogram lateness;                 // ns from the tick to the moment at which the sensor thread had woken up
  Histogram round;                    // ns from the tick to the round's last output
  std::vector<Histogram> execution;   // ns, of each task, with what preempted it
};

class JarolCore {
 public:
  /// One ExternalSystem per distributer of the graph, in its order. The graph outlives the core. Throws
  /// InputError for a graph whose periods can't be counted in those of the sensor thread, or with deep
  /// values between threads. `recorder`: gets what is published, and true values for the conditions of the graph; or
  /// null.
  JarolCore(PlanOfRun plan, std::vector<std::unique_ptr<ExternalSystem>> systems, Recorder* recorder = nullptr);
  ~JarolCore();

  /// Covers the instants before `end`, unless a fault stops it or it is interrupted; once. `prepare` is called in each
  /// thread, in the caller's last, before the clock starts. The first exception that a thread ends with is thrown here
  /// when all have ended; Unfinished where the system has no more threads.
  void run_for(
      Duration end, const std::function<void()>& prepare = [] {});
  /// The same without the end of its threads, which `finish` waits for; what one of them has thrown by then.
  void cover(Duration end, const std::function<void()>& prepare);

  // as of Executor, by any thread
  void close(Futex::Time patience = Futex::Time::max());
  Finish finish(std::optional<Futex::Time> patience = {});
  std::optional<HangingTask> running() const;
  std::optional<Holdup> holdup() const;

  // as of Executor; the rest begins by itself at the end, and `on_rest` is called before with the instant
  void ask_for_rest() { rest_asked_.store(true, std::memory_order_relaxed); }
  void on_rest(std::function<void(Duration)> call) { on_rest_ = std::move(call); }
  bool resting() const { return rest_from_.load(std::memory_order_relaxed) >= 0; }
  std::optional<RestReport> rest() const;

  void interrupt() { interrupted_.store(true, std::memory_order_relaxed); }

  /// The period of the sensor thread: the shortest of the vehicle's channels, else of all.
  Duration period() const { return period_; }
  /// The digest counts rounds as instants; nothing is claimed of it.
  const Report& report() const { return run_.report; }
  const ThreadsReport& threads_report() const { return threads_report_; }
  const std::vector<FailsafeReport>& failsafe() const { return failsafe_.reports(); }
  /// The instant reached, as of Executor.
  Duration now() const { return now_.load(std::memory_order_relaxed); }
  const void* last_value(std::size_t communicator) const { return run_.state.last[communicator]; }
  const RunState& state() const { return run_.state; }

 private:
  // What is due once in so many rounds: in the first that is run of these, as others may be left out.
  class Cadence {
   public:
    explicit Cadence(std::int64_t rounds = 1) : rounds_(rounds) {}
    bool due(std::int64_t round) {
      const std::int64_t before = std::exchange(last_, round / rounds_);
      return last_ != before;
    }

   private:
    std::int64_t rounds_;
    std::int64_t last_ = -1;
  };

  // A communicator, and the port between the thread that serves its channel and the core.
  struct Carried {
    std::size_t communicator = 0;
    const CommunicatorAction* action = nullptr;
    Cadence core, outside;  // of the core thread, and of the one that serves it
    bool terminal = false;  // served by the terminal thread
    std::unique_ptr<PushBytesPort> port;
    std::vector<std::byte> room;  // of the thread that serves it
  };
  // A vehicle whose true values are recorded, from the thread that serves it to the core's.
  struct Watched {
    Watched(std::size_t of, const Type& type) : distributer(of), port(1, type.size), outside(type), core(type) {}
    std::size_t distributer;
    PushBytesPort port;
    Value outside, core;  // of these threads
  };
  struct Counted {
    const Activation* activation = nullptr;
    const Publish* publish = nullptr;
    Cadence cadence;
    Duration period{};
  };

  // A thread, and whether it has ended.
  struct Part {
    Signal* signal = nullptr;
    std::thread thread;
    std::atomic<std::uint32_t> ended{0};
  };

  Duration choose_period() const;
  std::int64_t rounds_of(const std::string& what, Duration period) const;
  void gather();
  bool on_vehicle(std::size_t communicator) const;

  bool stopped() const { return stopped_.load(std::memory_order_acquire); }
  void fail(std::exception_ptr failure);
  void throw_failure();
  template <class Work>
  void begin(Part& part, Signal& signal, const std::function<void()>& prepare, Work work);

  void run_sensor(Duration end);
  std::optional<Duration> end_at(std::int64_t round, std::int64_t& last, Duration end);
  void run_core();
  void run_actuator();
  void run_terminal();
  bool await_core(Signal& signal, std::uint64_t& seen) const;
  void sense(bool terminal, std::int64_t round);
  void act(bool terminal);
  void run_round(std::int64_t round);
  void run_task(Counted& task, const Now& now);
  void record_true_values(Duration instant);
  void on_bad(const Activation& activation, const BadActivation& bad);

  Run run_;  // of the core thread
  const Graph& graph_;
  std::vector<std::unique_ptr<ExternalSystem>> systems_;
  std::vector<std::unique_ptr<std::mutex>> system_mutexes_;  // sensor and actuator thread share a vehicle's
  std::vector<char> ending_known_;                           // per system, guarded likewise
  Duration period_{};
  std::vector<std::unique_ptr<Watched>> watched_;
  std::vector<Carried> ins_, outs_;
  std::vector<Counted> tasks_;  // data-flow order
  Failsafe failsafe_;           // of the core thread
  std::atomic<std::uint64_t> refused_inputs_{0};
  ThreadsReport threads_report_;
  Signal start_signal_, core_signal_, actuator_signal_, terminal_signal_;
  std::atomic<std::int64_t> rounds_begun_{0};
  std::atomic<std::uint64_t> rounds_done_{0};
  std::atomic<Duration> now_{};
  std::atomic<Duration> tick_{};  // the newest, of the monotonic clock
  std::atomic<bool> interrupted_{false};
  std::atomic<bool> stopped_{false};  // at the end, by a fault or a failure
  std::atomic<bool> closed_{false};
  bool reached_end_ = false;    // of the sensor thread
  std::unique_ptr<Rest> rest_;  // of the core thread; null: the graph states none
  std::function<void(Duration)> on_rest_ = [](Duration) {};
  std::atomic<bool> rest_asked_{false};
  std::atomic<std::int64_t> rest_from_{-1}, rest_reached_{-1};  // rounds; below zero: not yet
  // what the core thread runs; for others who ask why it does not end
  struct Running {
    std::atomic<const Counted*> task{nullptr};
    std::atomic<std::int64_t> activation{0};
    std::atomic<Duration> instant{};
  } running_;
  std::mutex failure_mutex_;
  std::exception_ptr failure_;  // the first
  std::optional<TimeTrigger> trigger_;
  Part sensor_, core_, actuator_, terminal_;
};

}  // namespace jarol
