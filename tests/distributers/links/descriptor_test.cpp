#include "distributers/links/descriptor.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <atomic>
#include <thread>

namespace {
using namespace jarol::distributers;
using namespace std::chrono_literals;
using Woken = Interrupter::Woken;
}  // namespace

TEST_SUITE("distributers/links/descriptor") {
  TEST_CASE("a wait that a signal comes into goes on, until its time is over or it is interrupted") {
    const auto before = signal(SIGUSR1, [](int) {});
    Interrupter interrupter;
    for (const bool interrupted : {false, true}) {
      CAPTURE(interrupted);
      std::atomic<bool> over{false};
      Woken woken{};
      const auto start = std::chrono::steady_clock::now();
      std::thread waiter([&] {
        woken = interrupter.wait(-1, interrupted ? -1ms : 100ms);
        over = true;
      });
      for (int signals = 0; !over; ++signals) {
        pthread_kill(waiter.native_handle(), SIGUSR1);
        std::this_thread::sleep_for(2ms);
        if (interrupted && signals == 5) interrupter.interrupt();
      }
      waiter.join();
      CHECK(woken == (interrupted ? Woken::interrupted : Woken::timed_out));
      if (!interrupted) CHECK(std::chrono::steady_clock::now() - start >= 100ms);
    }
    signal(SIGUSR1, before);
  }
}
