#include "runtime/execute/attend.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "runtime/machine/signal_stack.h"

namespace jarol {
namespace {

constexpr std::chrono::milliseconds look{10};

// Outlives a thread that never ends.
struct Worker {
  std::atomic<std::uint32_t> ended{0};
  std::exception_ptr failure;
  std::thread thread;

  bool ends_until(Futex::Time time) {
    while (ended.load(std::memory_order_acquire) == 0)
      if (!Futex::wait(ended, 0, time)) return ended.load(std::memory_order_acquire) != 0;
    return true;
  }
  // at the first look, also where a signal interrupted it
  bool has_ended() {
    if (ended.load(std::memory_order_acquire) == 0) Futex::wait(ended, 0, Futex::now() + look);
    return ended.load(std::memory_order_acquire) != 0;
  }
};

// Those that end a program, or halt it, go to the thread that attends.
void leave_signals_to_others() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}) sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

// How long the same has stood at one look after another. Time counts by looks: while the whole process is halted, or
// the machine, nobody could have gone on.
template <typename What>
class Standing {
 public:
  /// None: nothing stands. Zero at the first look at it.
  Futex::Time::duration look_at(const std::optional<What>& what) {
    const Futex::Time now = Futex::now();
    const auto passed = std::min<Futex::Time::duration>(now - looked_, 2 * look);
    looked_ = now;
    stood_ = what && what == what_ ? stood_ + passed : Futex::Time::duration{};
    what_ = what;
    return stood_;
  }

 private:
  Futex::Time looked_ = Futex::now();
  std::optional<What> what_;
  Futex::Time::duration stood_{};
};

// One activation that holds up everything else.
class HoldupWatch {
 public:
  std::optional<Ending> look_at(const AttendedRun& run) {
    const std::optional<Holdup> holdup = run.holdup();
    const bool late = holdup && holdup->late > Duration{};
    const Futex::Time::duration stood = standing_.look_at(late ? std::optional(holdup->task) : std::nullopt);
    if (stood == Futex::Time::duration{}) return std::nullopt;
    const std::string who = to_text(holdup->task);
    if (holdup->over && stood >= 2 * look) return Ending::over();
    if (holdup->stops && stood >= 2 * look)
      return Ending{Ending::Cause::fault, 0, who + " by its deadline, which ended the run"};
    if (stood >= holdup_patience) return Ending{Ending::Cause::hung, 0, who + ", which ended the run"};
    return std::nullopt;
  }

 private:
  Standing<HangingTask> standing_;
};

// One call of a distributer's that does so.
class CallWatch {
 public:
  std::optional<Ending> look_at(const AttendedRun& run) {
    const std::optional<Call> call = run.call();
    const Futex::Time::duration stood = standing_.look_at(call ? std::optional(call->of) : std::nullopt);
    if (!call || !call->patience || stood < *call->patience) return std::nullopt;
    return Ending{Ending::Cause::hung, 0, to_text(call->of) + ", which ended the run"};
  }

 private:
  Standing<HangingDistributer> standing_;
};

// The way of a vehicle to rest, once the run has ended in good order.
class RestWatch {
 public:
  RestWatch(AttendedRun& run, const std::function<void(const Ending&)>& on_rest) : run_(run), on_rest_(on_rest) {}

  /// As the signal asks; false: there is no such way.
  bool begin(const Ending& why) {
    const std::optional<Duration> longest = run_.longest_rest();
    if (!longest || before_) return before_.has_value();
    before_ = why;
    until_ = Futex::now() + *longest + holdup_patience;
    run_.ask_for_rest();
    on_rest_(why);
    return true;
  }
  /// At a look: by itself, at the end of what was to be covered.
  void look() {
    if (!before_ && run_.resting()) begin(Ending::over());
  }
  bool is_too_long() const { return before_ && Futex::now() >= until_; }
  const std::optional<Ending>& before() const { return before_; }

 private:
  AttendedRun& run_;
  const std::function<void(const Ending&)>& on_rest_;
  std::optional<Ending> before_;
  Futex::Time until_{};  // by then it is done, or something holds it up
};

Ending ending_of(const AttendedRun& run, const Worker& worker, const std::optional<Ending>& before_rest) {
  if (worker.failure) return Ending::lost();
  return run.stopped_by_fault() ? Ending::fault() : before_rest.value_or(Ending::over());
}

}  // namespace

RunEnd attend(AttendedRun& run, const std::function<void()>& prepare, const std::function<Wish()>& wish,
              const std::function<void(const Ending&)>& on_rest, const std::function<void()>& on_end,
              const StuckNote& on_stuck) {
  const auto worker = std::make_shared<Worker>();
  worker->thread = std::thread([&run, &prepare, worker] {
    leave_signals_to_others();
    const SignalStack stack;
    try {
      prepare();
      run.cover();
    } catch (...) { worker->failure = std::current_exception(); }
    worker->ended.store(1, std::memory_order_release);
    Futex::wake_all(worker->ended);
  });
  RunEnd end;
  HoldupWatch watch;
  CallWatch calls;
  RestWatch rest(run, on_rest);
  StuckWatch stuck([&run] { return run.running(); }, on_stuck);
  for (std::optional<Ending> why; !why;) {
    const bool ended = worker->has_ended();
    const Wish wished = wish();
    if (!ended) rest.look();
    if (!ended) stuck.look();
    if (ended)
      why = ending_of(run, *worker, rest.before());
    else if (rest.before() && wished.at_once)
      why = Ending{Ending::Cause::signal, wished.signal, "a second signal came"};
    else if (wished.signal != 0 && !rest.begin(Ending::of_signal(wished.signal)))
      why = Ending::of_signal(wished.signal);
    else if (rest.is_too_long())
      why = rest.before();
    else if (!(why = watch.look_at(run)))
      why = calls.look_at(run);
    if (why && why->cause == Ending::Cause::over && rest.before()) why = rest.before();
    if (why) end.ending = std::move(*why);
  }
  on_end();
  end.before_rest = rest.before();
  const Futex::Time until = end.until = Futex::now() + end_patience;
  run.close(end.ending, until);
  if (!worker->ends_until(Futex::now() + 2 * look)) {
    // what runs on may not keep those who send from the processor
    const sched_param ordinary{};
    pthread_setschedparam(worker->thread.native_handle(), SCHED_OTHER, &ordinary);
  }
  if (!worker->ends_until(until)) {
    end.hangs = true;
    end.hanging = run.running();
    if (const std::optional<Call> call = run.call()) end.distributer = call->of;
    worker->thread.detach();
    return end;
  }
  worker->thread.join();
  end.failure = worker->failure;
  Finish finish = run.finish(until);
  end.hangs = !finish.done;
  end.hanging = std::move(finish.hanging);
  // of an activation that had still to end when the time was over
  if (end.ending.cause == Ending::Cause::over && run.stopped_by_fault()) end.ending = Ending::fault();
  return end;
}

}  // namespace jarol
