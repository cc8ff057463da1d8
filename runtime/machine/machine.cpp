#include "runtime/machine/machine.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <thread>

#include "runtime/machine/real_clock.h"

namespace jarol {
namespace {

constexpr std::int64_t ns_per_second = 1'000'000'000;

// Empty, or why the call failed.
std::string refusal(int result) { return result == 0 ? "" : std::strerror(errno); }

void on_a_thread(const std::function<void()>& work) { std::thread(work).join(); }

std::int64_t nanoseconds_of(const timespec& time) { return time.tv_sec * ns_per_second + time.tv_nsec; }

std::string use_fifo(int priority) {
  sched_param parameter{};
  parameter.sched_priority = priority;
  return refusal(sched_setscheduler(0, SCHED_FIFO, &parameter));
}

void find_priority(MachineFacts& facts) {
  const int max = sched_get_priority_max(SCHED_FIFO);
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  on_a_thread([&] {
    facts.fifo_refused = use_fifo(max);
    if (facts.fifo_refused.empty()) facts.fifo_priority = max;
    const int allowed = static_cast<int>(std::min<rlim_t>(limit.rlim_cur, static_cast<rlim_t>(max)));
    if (facts.fifo_priority == 0 && allowed > 0 && (facts.fifo_refused = use_fifo(allowed)).empty())
      facts.fifo_priority = allowed;
  });
}

void find_cpus(MachineFacts& facts) {
  facts.cpus = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(static_cast<std::size_t>(cpu), &set)) facts.usable.push_back(cpu);
  on_a_thread([&] {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(facts.usable.empty() ? 0 : facts.usable.back()), &one);
    facts.affinity_refused = refusal(sched_setaffinity(0, sizeof one, &one));
  });
}

void find_slack(MachineFacts& facts) {
  on_a_thread([&] {
    facts.default_slack = std::chrono::nanoseconds(prctl(PR_GET_TIMERSLACK));
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    facts.min_slack = std::chrono::nanoseconds(prctl(PR_GET_TIMERSLACK));
  });
}

void find_governors(MachineFacts& facts) {
  for (const int cpu : facts.usable) {
    std::ifstream file("/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/cpufreq/scaling_governor");
    std::string governor;
    if (file >> governor &&
        std::find(facts.governors.begin(), facts.governors.end(), governor) == facts.governors.end())
      facts.governors.push_back(governor);
  }
}

}  // namespace

MachineFacts find_machine_facts() {
  MachineFacts facts;
  utsname kernel{};
  uname(&kernel);
  facts.kernel = kernel.release;
  facts.preempt_rt = std::strstr(kernel.version, "PREEMPT_RT") != nullptr;
  find_cpus(facts);
  find_priority(facts);
  find_slack(facts);
  find_governors(facts);
  facts.lock_refused = refusal(mlockall(MCL_CURRENT));
  if (facts.lock_refused.empty()) munlockall();
  timespec resolution{};
  clock_getres(CLOCK_MONOTONIC, &resolution);
  facts.resolution = std::chrono::nanoseconds(nanoseconds_of(resolution));
  return facts;
}

std::optional<Histogram> measure_lateness(std::chrono::nanoseconds period, std::chrono::nanoseconds duration,
                                          std::optional<int> fifo_priority) {
  std::optional<Histogram> lateness;
  on_a_thread([&] {
    if (fifo_priority && !use_fifo(*fifo_priority).empty()) return;
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    lateness.emplace();
    const Duration start = RealClock::monotonic();
    for (Duration due = start + period; due <= start + duration; due += period) {
      const timespec until{due.count() / ns_per_second, due.count() % ns_per_second};
      while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {}
      lateness->add(RealClock::monotonic() - due);
    }
  });
  return lateness;
}

}  // namespace jarol
