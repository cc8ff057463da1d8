// The Jarol signal: a strict point of synchronisation between threads; it carries no value.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/machine/futex.h"

namespace jarol {

/// What came of signalling; `done` alone is no error.
enum class [[nodiscard]] Signalling{done, not_awaited, during_signalling, interrupted};
/// What came of awaiting.
enum class [[nodiscard]] Awaiting{signalled, during_signalling, timed_out, interrupted};

std::string_view to_text(Signalling result);
std::string_view to_text(Awaiting result);

/// A signalling lasts until all have left who waited when it began. What the signalling thread did before happens
/// before what they do next. Any number of threads may await and signal; signalling takes no lock.
template <class Threads>
class BasicSignal {
 public:
  using Time = typename Threads::Time;

  BasicSignal() = default;
  BasicSignal(const BasicSignal&) = delete;
  BasicSignal& operator=(const BasicSignal&) = delete;

  /// Waits to be signalled, interrupted, or until the deadline. Who waits when it is signalled was signalled, whatever
  /// else happens before he has left.
  Awaiting await(std::optional<Time> deadline = {}) {
    return await_unless([] { return false; }, deadline);
  }

  /// The same, but looks once more whether there is a reason to wait, after whoever signals would find him waiting:
  /// what becomes `ready` before it is signalled is never slept through. It counts as signalled then.
  template <class Ready>
  Awaiting await_unless(Ready ready, std::optional<Time> deadline = {}) {
    std::uint32_t state = 0;  // mostly nobody else waits; the exchange shows what is true
    while (!state_.compare_exchange_weak(state, state + 1, std::memory_order_acq_rel, std::memory_order_acquire)) {
      if ((state & interrupted) != 0) return Awaiting::interrupted;
      if ((state & signalling) != 0) return Awaiting::during_signalling;
    }
    ++state;
    if (ready()) {
      const Awaiting result = *leave(state, false);
      return result == Awaiting::timed_out ? Awaiting::signalled : result;
    }
    for (;;) {
      const bool in_time = Threads::wait(state_, state, deadline);
      state = state_.load(std::memory_order_acquire);
      if (const std::optional<Awaiting> result = leave(state, in_time)) return *result;
    }
  }

  /// Wakes all who wait.
  Signalling signal() {
    std::uint32_t state = 1;  // mostly one waits
    for (;;) {
      const Signalling result = signalling_in(state);
      // what is refused is exchanged for itself: who comes to wait next has seen what the refused thread did before
      const std::uint32_t next = result == Signalling::done ? state | signalling : state;
      if (!state_.compare_exchange_weak(state, next, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      if (result == Signalling::done) Threads::wake_all(state_);
      return result;
    }
  }

  /// From now on nobody waits: who does is woken, who comes is turned away, until `resume`.
  void interrupt() {
    state_.fetch_or(interrupted, std::memory_order_acq_rel);
    Threads::wake_all(state_);
  }

  /// Ends an interruption. False, and nothing changes, while those who were interrupted have not all left.
  bool resume() {
    std::uint32_t state = interrupted;
    return state_.compare_exchange_strong(state, 0, std::memory_order_acq_rel, std::memory_order_acquire) || state == 0;
  }

  /// Threads that wait, or were woken and have not left.
  std::uint32_t waiting() const { return state_.load(std::memory_order_acquire) & count; }

 private:
  // One word: how many wait, and what is going on. As nobody enters during a signalling, who waited sees it until he
  // himself has left: rounds need not be told apart by a number that could wrap.
  static constexpr std::uint32_t signalling = 1U << 31;
  static constexpr std::uint32_t interrupted = 1U << 30;
  static constexpr std::uint32_t count = interrupted - 1;

  static Signalling signalling_in(std::uint32_t state) {
    if ((state & interrupted) != 0) return Signalling::interrupted;
    if ((state & signalling) != 0) return Signalling::during_signalling;
    return state == 0 ? Signalling::not_awaited : Signalling::done;
  }

  // The last one to leave ends the signalling.
  std::optional<Awaiting> leave(std::uint32_t& state, bool in_time) {
    for (;;) {
      const bool was_signalled = (state & signalling) != 0;
      if (!was_signalled && (state & interrupted) == 0 && in_time) return std::nullopt;
      std::uint32_t left = state - 1;
      if ((left & count) == 0) left &= ~signalling;
      if (!state_.compare_exchange_weak(state, left, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      if (was_signalled) return Awaiting::signalled;
      return (state & interrupted) != 0 ? Awaiting::interrupted : Awaiting::timed_out;
    }
  }

  typename Threads::template Atomic<std::uint32_t> state_{0};
};

extern template class BasicSignal<Futex>;
using Signal = BasicSignal<Futex>;

}  // namespace jarol
