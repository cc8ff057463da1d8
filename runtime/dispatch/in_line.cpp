#include "runtime/dispatch/in_line.h"

#include "runtime/dispatch/let_ends.h"
#include "runtime/dispatch/releases.h"

namespace jarol {
namespace {

// Digest and recorder are known to the compiler: an activation may take less time than asking for them.
template <bool Digest, bool Record>
class InLine : public Dispatcher {
 public:
  explicit InLine(Run& run) : run_(run), releases_(run) {}

  void end_lets(const Now& now) override {
    std::uint64_t digest = 0;
    jarol::end_lets(run_, now, [&](const Publish& what) { digest += publish<false>(what, now); });
    if constexpr (Digest) run_.publisher.add_to_digest(digest);
  }

  void release(const Now& now) override {
    RunningTask& running = running_task;
    std::uint64_t digest = 0;
    const auto run = [&](const Indices& tasks, const Tick& tick) __attribute__((always_inline)) {
      running.tick.store(&tick, std::memory_order_relaxed);
      digest += run_row(tasks, tick, now, running);
    };
    releases_.each_row(now, run);
    running.end();
    if constexpr (Digest) run_.publisher.add_to_digest(digest);
  }

 private:
  // Returns the digest's part.
  template <bool AtOnce>
  [[gnu::always_inline]] std::uint64_t publish(const Publish& what, const Now& now) {
    const std::uint64_t digest = make_visible<Digest, AtOnce>(what, now.digest_term);
    if constexpr (Record) run_.publisher.record(what, now);
    return digest;
  }

  // Returns the digest's part.
  [[gnu::always_inline]] std::uint64_t run_row(const Indices& tasks, const Tick& tick, const Now& now,
                                               RunningTask& running) {
    const Activation* next = run_.state.activations.data() + tasks.first;
    const Activation* const last = next + tasks.count;
    std::uint64_t digest = 0;
    while (next != last) {
      if (next->body != nullptr) {
        next = run_bodies(next, last, tick, running);
        continue;
      }
      const Activation& activation = *next++;
      running.next(activation.memory);
      const Outcome outcome = activation.run(activation.memory, tick);
      if (outcome == Outcome::good) [[likely]] {
        digest += publish<true>(activation.publish, now);  // nothing, of a task with a LET
      } else {
        run_.faults.on_bad(activation, {outcome, tick.activation, tick.now});
      }
    }
    return digest;
  }

  // Those in a row that are checked at the ends of their LETs; returns the first that is not one. What one throws ends
  // its own activation alone.
  [[gnu::noinline]] const Activation* run_bodies(const Activation* next, const Activation* last, const Tick& tick,
                                                 RunningTask& running) {
    while (next != last && next->body != nullptr) {
      const Outcome outcome = contain(
          [&] {
            for (; next != last && next->body != nullptr; ++next) {
              running.next(next->memory);
              next->body(next->memory, tick);
            }
          },
          [&]() -> FaultText& { return *next->memory.fault; });
      if (outcome != Outcome::good) run_.faults.on_bad(*next++, {outcome, tick.activation, tick.now});
    }
    return next;
  }

  Run& run_;
  Releases releases_;
};

}  // namespace

std::unique_ptr<Dispatcher> make_in_line(Run& run) {
  const bool record = run.publisher.recorder() != nullptr;
  if (run.publisher.with_digest()) {
    if (record) return std::make_unique<InLine<true, true>>(run);
    return std::make_unique<InLine<true, false>>(run);
  }
  if (record) return std::make_unique<InLine<false, true>>(run);
  return std::make_unique<InLine<false, false>>(run);
}

}  // namespace jarol
