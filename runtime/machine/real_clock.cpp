#include "runtime/machine/real_clock.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>

namespace jarol {
namespace {

constexpr Duration look_for_interrupt = std::chrono::milliseconds(100);
constexpr Duration spin_before = std::chrono::microseconds(100);  // more than a wake-up takes on a quiet machine
constexpr Duration short_slice = std::chrono::microseconds(100);  // the shortest that the kernel takes

void sleep_until(Duration monotonic) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(monotonic);
  const timespec until{whole.count(), (monotonic - whole).count()};
  // a signal ends it early; the caller looks at the clock again
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

std::string refused(const std::string& what, int error, const std::string& remedy) {
  return what + ": " + std::strerror(error) + "; " + remedy;
}

// What is allocated later is locked too, but not where a limit counts: there would be no thread and no memory to be had
// beyond it.
int lock_memory() {
  static std::mutex limits;
  const std::lock_guard lock(limits);
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return mlockall(MCL_CURRENT | MCL_FUTURE);
  // no limit counts for a process with CAP_IPC_LOCK, not even none at all; a user namespace may only seem to give it
  const rlimit nothing{0, limit.rlim_max};
  setrlimit(RLIMIT_MEMLOCK, &nothing);
  const int unlimited = mlockall(MCL_CURRENT | MCL_FUTURE);
  setrlimit(RLIMIT_MEMLOCK, &limit);
  return unlimited == 0 ? 0 : mlockall(MCL_CURRENT);
}

// A thread with a short slice goes before others when it wakes up, also under the ordinary scheduler, from Linux 6.12
// on; older kernels ignore it. Nobody has to permit it, and where it is refused all goes on as ever.
void ask_for_short_slice() {
  struct {
    std::uint32_t size, policy;
    std::uint64_t flags;
    std::int32_t nice;
    std::uint32_t priority;
    std::uint64_t runtime, deadline, period;
  } attributes{};  // struct sched_attr, which glibc has not
  attributes.size = sizeof attributes;
  attributes.policy = SCHED_OTHER;
  attributes.nice = getpriority(PRIO_PROCESS, 0);
  attributes.runtime = static_cast<std::uint64_t>(short_slice.count());
  syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace

RealTimeOptions RealTimeOptions::of_thread(std::size_t core, std::size_t urgency) const {
  RealTimeOptions options = *this;
  if (priority) options.priority = *priority - 1 - static_cast<int>(urgency);
  if (core < core_cpus.size()) options.cpus = {core_cpus[core]};
  return options;
}

std::vector<std::string> prepare_thread(const RealTimeOptions& options) {
  std::vector<std::string> refusals;
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  if (lock_memory() != 0)
    refusals.push_back(refused("memory can't be locked", errno,
                               "a page fault may delay a task; " + std::string(permit_locked_memory)));
  if (!options.cpus.empty()) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : options.cpus) CPU_SET(static_cast<std::size_t>(cpu), &set);
    if (sched_setaffinity(0, sizeof set, &set) != 0)
      refusals.push_back(refused("the thread can't be bound to the CPUs of --cpus", errno,
                                 "name CPUs that this machine has and lets the process use"));
  }
  if (options.priority) {
    sched_param parameter{};
    parameter.sched_priority = *options.priority;
    if (sched_setscheduler(0, SCHED_FIFO, &parameter) != 0)
      refusals.push_back(refused("SCHED_FIFO is refused", errno,
                                 "no task goes before another or before other programs; " + std::string(permit_fifo)));
  }
  if (sched_getscheduler(0) == SCHED_OTHER) ask_for_short_slice();
  return refusals;
}

RealClock::RealClock(std::size_t tasks, RealTimeOptions options) : options_(std::move(options)), timings_(tasks) {}

Duration RealClock::monotonic() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + Duration(now.tv_nsec);
}

void RealClock::start() { start_.store(monotonic(), std::memory_order_relaxed); }

void RealClock::wait_until(Duration instant, const std::atomic<bool>& interrupted) {
  const Duration due = start_.load(std::memory_order_relaxed) + instant;
  const Duration awake = options_.spin ? due - spin_before : due;
  Duration at = monotonic();
  while (at < awake) {
    if (interrupted.load(std::memory_order_relaxed)) return;
    sleep_until(std::min(awake, at + look_for_interrupt));
    at = monotonic();
  }
  while (at < due) at = monotonic();
  lateness_.add(at - due);
}

}  // namespace jarol
