#include "runtime/dispatch/workers.h"

#include "graph/floating_point.h"
#include "graph/values/heap.h"
#include "runtime/machine/signal_stack.h"

namespace jarol {
namespace {

constexpr std::uint64_t ended = std::uint64_t{1} << 63;
constexpr int spins = 2000;  // some 50 to 100 us: longer than the serial part between two stages of most graphs

inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Waits until the word is no longer `old`: first awake, then asleep.
std::uint64_t await_change(const std::atomic<std::uint64_t>& word, std::uint64_t old) {
  for (int i = 0; i < spins; ++i) {
    const std::uint64_t now = word.load(std::memory_order_acquire);
    if (now != old) return now;
    pause();
  }
  word.wait(old, std::memory_order_acquire);
  return word.load(std::memory_order_acquire);
}

}  // namespace

Workers::Workers(std::size_t count, std::size_t parts) : claims_(parts), others_(count - 1) {
  // each begins at a place of its own, so that neighbouring parts go to one
  try {
    for (std::size_t i = 1; i < count; ++i)
      threads_.emplace_back([this, i, count, parts] { work(i * parts / count, others_[i - 1]); });
  } catch (...) {
    end();
    throw;
  }
}

Workers::~Workers() { end(); }

void Workers::end() {
  round_.fetch_or(ended, std::memory_order_release);
  round_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(Job job, void* context) {
  job_ = job;
  context_ = context;
  const std::uint64_t round = round_.load(std::memory_order_relaxed) + 1;
  round_.store(round, std::memory_order_release);
  round_.notify_all();
  take_parts(0, round);
  const std::uint64_t all = round * parts();
  for (std::uint64_t done = done_.load(std::memory_order_acquire); done != all;) done = await_change(done_, done);
}

void Workers::work(std::size_t first, std::atomic<const RunningTask*>& running) {
  running.store(&running_task, std::memory_order_release);
  const SignalStack signal_stack;
  set_floating_point_control(default_floating_point_control());
  const MemoryScope scope(no_heap());
  for (std::uint64_t round = 0;;) {
    round = await_change(round_, round);
    if ((round & ended) != 0) return;
    take_parts(first, round);
  }
}

// Job and context are read only once a part is taken: then the caller waits, and they stay as they are.
void Workers::take_parts(std::size_t first, std::uint64_t round) {
  for (std::size_t i = 0; i < parts(); ++i) {
    const std::size_t part = (first + i) % parts();
    std::uint64_t before = round - 1;
    if (!claims_[part].round.compare_exchange_strong(before, round, std::memory_order_acquire)) continue;
    job_(context_, part);
    done_.fetch_add(1, std::memory_order_release);
    done_.notify_one();
  }
}

}  // namespace jarol
