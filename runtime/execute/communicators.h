// The communicators of a run and the external systems behind them: steps 0, 2 and 3 of each instant. Nobody else may
// use the systems then, and nothing uses them once the run is closed.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/execute/failsafe.h"
#include "runtime/execute/rest.h"
#include "runtime/external_system.h"
#include "runtime/machine/futex.h"
#include "runtime/run/run.h"

namespace jarol {

/// Of which vehicles the run's recorder gets true values, too: of those that the conditions of the graph, and those
/// that are measured, ask for; or of all.
enum class Truth { none, of_conditions, all };

class Communicators {
 public:
  /// One ExternalSystem per distributer, in the order of the graph. The run outlives it.
  Communicators(Run& run, std::vector<std::unique_ptr<ExternalSystem>> systems, Truth truth,
                std::span<const expect::Condition> measured = {});

  /// An instant, from its begin until `act` has been called.
  class Turn {
   public:
    /// Step 0: external systems reach the instant with the inputs that they held before it.
    Turn(Communicators& all, const Now& now) : all_(all) {
      if (all_.are_any_) all_.begin(*this, now);
    }
    ~Turn() {
      if (uses_) all_.end(*this);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    /// The run was closed: nothing of the instant takes place.
    bool closed() const { return closed_; }
    /// Steps 2 and 3: communicators act, by name. What an external system throws ends the run after the instant.
    void act(const Now& now) {
      if (uses_) all_.act(*this, now);
    }

   private:
    friend Communicators;
    Communicators& all_;
    bool uses_ = false, closed_ = false;
  };

  /// After an instant: throws what an external system has thrown in it. Until then none is called any more, and the
  /// instant is whole.
  void require_none_lost() const {
    if (lost_) [[unlikely]]
      std::rethrow_exception(lost_);
  }

  /// The vehicle may be brought to rest.
  bool may_rest() const { return rest_ != nullptr; }
  /// From that instant on it is.
  void begin_rest(Duration instant);
  /// After an instant: it has come to rest.
  bool has_come_to_rest(Duration instant);
  /// Until when it may take at the latest.
  Duration end_of_rest() const { return rest_begun_ + rest_->longest(); }
  bool resting() const { return resting_.load(std::memory_order_relaxed); }
  /// None: it did not begin. `reached`: the instant that the run has reached.
  std::optional<RestReport> rest(Duration reached) const;

  /// No more is handed over, but now, once, all that is safe; with `outliving` only to external systems that outlive
  /// the run. Any thread; what an instant has begun to hand over is waited for until then.
  void close(Futex::Time patience, bool outliving, const std::function<Duration()>& time);

  /// The external system that an instant is in a call of, by distributer; none: it is in none. Any thread.
  std::optional<std::size_t> called() const {
    const std::uint32_t number = called_.load(std::memory_order_relaxed);
    return number == 0 ? std::nullopt : std::optional<std::size_t>(number - 1);
  }
  bool on_link(std::size_t distributer) const { return systems_[distributer]->needs_real_clock(); }

  const std::vector<FailsafeReport>& failsafe() const { return failsafe_.reports(); }
  /// Values from outside that were not taken as they were not finite.
  std::uint64_t non_finite_inputs() const;

  /// Between two instants, of a run that can't be brought to rest. Throws NotSaveable, with the distributer.
  void serialize(Archive& archive);

 private:
  void begin(Turn& turn, const Now& now);
  void act(Turn& turn, const Now& now);
  void end(Turn& turn);
  void gather(const Now& now);
  ExternalSystem& call(std::size_t distributer);
  template <class Do>
  void attempt(Do act);
  void reach(Duration instant);
  void hand_over(const CommunicatorAction& out, Duration instant);
  void take(const CommunicatorAction& in, Duration instant);

  Run& run_;
  std::vector<std::unique_ptr<ExternalSystem>> systems_;
  Failsafe failsafe_;
  const bool are_any_;
  std::vector<const CommunicatorAction*> outs_, ins_;  // due now
  std::uint64_t refused_ = 0;                          // values of `in` channels that were not finite
  struct WatchedVehicle {
    std::size_t distributer;
    Value values;
  };
  std::vector<WatchedVehicle> watched_;  // whose true values are recorded
  // of the systems, by an instant or by whoever closed the run
  enum class Use : std::uint32_t { free, covering, closed };
  std::atomic<Use> use_{Use::free};
  std::atomic<std::uint32_t> called_{0};  // the number of the distributer from 1, 0: none
  std::exception_ptr lost_;               // what an external system has thrown
  std::unique_ptr<Rest> rest_;            // null: the run can't be brought to rest
  std::atomic<bool> resting_{false};
  Duration rest_begun_{};
  bool rest_reached_ = false, ending_known_ = false;  // the latter: to the external systems
};

}  // namespace jarol
