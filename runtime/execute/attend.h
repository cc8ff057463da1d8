// A run on a thread of its own, while the caller looks after it: whatever ends it, what has a `safe` gets that before
// anything is waited for, and what never ends is named.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/execute/stuck_watch.h"
#include "runtime/machine/futex.h"
#include "runtime/run/ending.h"

namespace jarol {

/// An activation on the thread that keeps the time: while it runs, nothing else does.
struct Holdup {
  HangingTask task;
  Duration late{};     // beyond its deadline; not above zero: not late
  bool stops = false;  // being late ends the run
  bool over = false;   // all that was to be covered lies in the past
};

/// A distributer that the thread that keeps the time is in a call of.
struct Call {
  HangingDistributer of;
  // how long it may hold up everything else; none: for ever, as on the virtual clock nothing is late
  std::optional<std::chrono::milliseconds> patience{};
};

class AttendedRun {
 public:
  virtual ~AttendedRun() = default;

  /// Covers the instants up to the end of the run, or to the fault that stops it. Throws what an external system that
  /// is lost throws.
  virtual void cover() = 0;
  virtual bool stopped_by_fault() const = 0;

  /// How long the vehicle may take to come to rest when the run ends in good order; none: it is not brought to rest.
  virtual std::optional<Duration> longest_rest() const { return std::nullopt; }
  /// `cover` goes on with that from its next instant, as it does of itself at the end, and returns when it is done.
  virtual void ask_for_rest() {}
  virtual bool resting() const { return false; }

  // by the thread that attends, while `cover` may be under way

  /// `cover` returns when the instant under way is done, and nothing is handed over any more but every `safe` that
  /// there is. An external system that is still in use at that time gets none.
  virtual void close(const Ending& ending, Futex::Time patience) = 0;
  virtual std::optional<Holdup> holdup() const { return std::nullopt; }
  /// Which it is in now, on either clock.
  virtual std::optional<Call> call() const { return std::nullopt; }
  /// What `cover` runs now, on whatever threads.
  virtual std::vector<HangingTask> running() const = 0;

  /// After `cover`: waits for threads; what they still run at that time.
  virtual Finish finish(Futex::Time patience) = 0;
};

struct RunEnd {
  Ending ending;
  std::optional<Ending> before_rest{};  // what the vehicle was brought to rest for, if it was
  std::exception_ptr failure;           // what `cover` threw
  bool hangs = false;                   // threads still run, and the process can only end at once, without destructors
  std::vector<HangingTask> hanging;
  std::optional<HangingDistributer> distributer{};  // that hangs
  std::vector<std::string> unkept{};                // what external systems could not keep for the next run, and why
  Futex::Time until{};                              // how long what is under way is waited for

  /// What hangs, if anything, runs a task.
  bool links_are_free() const { return !distributer && (!hangs || !hanging.empty()); }
  /// Something still runs that has to be left behind.
  bool must_end_at_once() const { return hangs || distributer; }
};

/// How long a run that ends waits for what is under way.
inline constexpr std::chrono::milliseconds end_patience{800};
/// How long links may take to finish, whatever else was waited for before.
inline constexpr std::chrono::milliseconds finish_patience{100};
/// How long, before that, a busy machine may take to begin with it.
inline constexpr std::chrono::milliseconds begin_patience{2000};
/// How long an activation that need not be in time may hold up everything else, beyond its deadline.
inline constexpr std::chrono::milliseconds holdup_patience{1000};
/// How long an external system may that is not on a link: in lockstep it waits 10 s for the other end itself.
inline constexpr std::chrono::milliseconds lockstep_patience{12'000};

/// What asks a run to end: a signal, or 0; and whether it is not to wait for rest.
struct Wish {
  int signal = 0;
  bool at_once = false;
};

/// `prepare` is called on the run's thread before it covers anything; `on_rest` when it is seen to
/// bring its vehicle to rest; `on_end` when it ends, and no wish is asked for any more.
RunEnd attend(
    AttendedRun& run, const std::function<void()>& prepare, const std::function<Wish()>& wish,
    const std::function<void(const Ending&)>& on_rest = [](const Ending&) {},
    const std::function<void()>& on_end = [] {}, const StuckNote& on_stuck = {});

}  // namespace jarol
