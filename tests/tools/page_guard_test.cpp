// A guard that is closed and opened again and again, while other threads write all the time.
#include "runtime/machine/page_guard.h"

#include <dlfcn.h>
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace {
using jarol::PageGuard;

long this_thread() { return ::syscall(SYS_gettid); }

std::atomic<long> guarded_thread{0};
std::atomic<int> faults_of_guarded{0};

struct HandledFaults {
  HandledFaults();
  ~HandledFaults() { ::sigaction(SIGSEGV, &before, nullptr); }
  struct sigaction before {};
};

// It writes nothing for threads that wait: all memory may be closed.
void on_fault(int, siginfo_t* info, void*) {
  const PageGuard::Fault fault = PageGuard::judge(info->si_addr);
  if (this_thread() != guarded_thread.load()) return;
  // one that comes again and again is no wait
  if (fault != PageGuard::Fault::waited || ++faults_of_guarded > 1000) ::signal(SIGSEGV, SIG_DFL);
}

HandledFaults::HandledFaults() {
  guarded_thread = this_thread();
  faults_of_guarded = 0;
  struct sigaction handler {};
  handler.sa_sigaction = on_fault;
  handler.sa_flags = SA_SIGINFO | SA_NODEFER;
  ::sigaction(SIGSEGV, &handler, &before);
}
}  // namespace

TEST_SUITE("tools/page_guard") {
  TEST_CASE("who writes while it is closed waits, and what was opened is writable for all") {
    const HandledFaults handled;
    constexpr std::size_t size = 4 << 20, others = 3;
    std::array<std::vector<char>, others> rooms;
    for (auto& room : rooms) room.resize(size);
    std::atomic<bool> over{false};
    int rounds = 0;
    {
      PageGuard guard;
      std::vector<std::thread> threads;
      for (auto& room : rooms)
        threads.emplace_back([&] {
          for (std::size_t at = 0; !over.load(); at = (at + 4096) % size) const_cast<volatile char&>(room[at]) = 1;
        });
      const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
      while (std::chrono::steady_clock::now() < end) {
        guard.close({});
        guard.open();
        for (auto& room : rooms) const_cast<volatile char&>(room[0]) = 2;
        ++rounds;
      }
      over = true;
      for (std::thread& thread : threads) thread.join();
    }
    MESSAGE(rounds << " times");
    CHECK(faults_of_guarded.load() == 0);
  }

  TEST_CASE("what another thread lifts while it is being closed is writable once it is open") {
    const HandledFaults handled;
    std::vector<char> room(1 << 20);
    const auto first = reinterpret_cast<std::uintptr_t>(room.data()) / 4096 * 4096 + 4096;
    char& written = *reinterpret_cast<char*>(first);
    {
      PageGuard guard;
      guard.close({});
      PageGuard::lift();
      REQUIRE(::mprotect(&written, 4096, PROT_READ) == 0);  // the one that closes it has gone on
      guard.open();
      const_cast<volatile char&>(written) = 1;
    }
    CHECK(written == 1);
    CHECK(faults_of_guarded.load() == 0);
  }

  TEST_CASE(
      "data of a system's library stays closed until somebody writes to it, and is opened with the rest from then on") {
    const HandledFaults handled;
    void* const library = ::dlopen("libm.so.6", RTLD_NOW);
    REQUIRE(library != nullptr);
    volatile int& written = *static_cast<int*>(::dlsym(library, "signgam"));
    written = 1;
    std::array<int, 4> faults{};
    std::atomic<int> step{0};
    int while_closed = 0;
    // before the guard: a new thread's memory has it look for all regions again
    std::thread other([&] {
      while (step.load() != 1) {}
      step = 2;
      written = written + 1;
      step = 3;
    });
    {
      PageGuard guard;
      for (int& after : faults) {
        guard.close({});
        guard.open();
        written = written + 1;
        after = faults_of_guarded.load();
      }
      // closed with the rest, too: another thread's write waits. Nothing is called here, as that might write
      guard.close({});
      step = 1;
      while (step.load() < 2) {}
      for (int i = 0; i < 20'000'000; ++i) while_closed = step.load();
      guard.open();
      other.join();
    }
    written = written + 1;
    CHECK(written == 7);
    CHECK(faults == std::array{1, 1, 1, 1});
    CHECK(while_closed == 2);
    ::dlclose(library);
  }
}
