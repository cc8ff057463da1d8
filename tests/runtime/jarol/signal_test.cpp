#include "runtime/jarol/signal.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/how_many.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

void await_waiting(const Signal& signal, std::uint32_t count) {
  while (signal.waiting() != count) std::this_thread::yield();
}
}  // namespace

TEST_SUITE("runtime/signal") {
  TEST_CASE("signalling with no one waiting is an error") {
    Signal signal;
    CHECK(signal.signal() == Signalling::not_awaited);
    CHECK(signal.waiting() == 0);
  }

  TEST_CASE("signalling wakes all who wait, and they see what was done before") {
    Signal signal;
    int value = 0;
    std::atomic<int> woken{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        if (signal.await() == Awaiting::signalled && value == 7) ++woken;
      });
    await_waiting(signal, 4);
    value = 7;
    CHECK(signal.signal() == Signalling::done);
    for (std::thread& thread : threads) thread.join();
    CHECK(woken == 4);
    CHECK(signal.signal() == Signalling::not_awaited);
  }

  TEST_CASE("a timed await ends at its deadline, on the monotonic clock") {
    Signal signal;
    const auto before = MachineClock::now();
    CHECK(signal.await(before + 20ms) == Awaiting::timed_out);
    CHECK(MachineClock::now() - before >= 20ms);
    CHECK(signal.await(before) == Awaiting::timed_out);
    CHECK(signal.await(MachineClock::time_point{} - 1h) == Awaiting::timed_out);
    CHECK(signal.waiting() == 0);
    CHECK(signal.signal() == Signalling::not_awaited);
  }

  TEST_CASE("an interruption wakes who waits and turns away who comes, until it is over") {
    Signal signal;
    Awaiting result = Awaiting::signalled;
    std::thread thread([&] { result = signal.await(); });
    await_waiting(signal, 1);
    signal.interrupt();
    thread.join();
    CHECK(result == Awaiting::interrupted);
    CHECK(signal.await() == Awaiting::interrupted);
    CHECK(signal.signal() == Signalling::interrupted);
    CHECK(signal.resume());
    CHECK(signal.resume());
    CHECK(signal.signal() == Signalling::not_awaited);
    CHECK(signal.await(MachineClock::now()) == Awaiting::timed_out);
  }

  TEST_CASE("each error has its text") {
    CHECK(to_text(Signalling::not_awaited) == "signalled with no one waiting");
    CHECK(to_text(Signalling::during_signalling) == "signalled during a signalling");
    CHECK(to_text(Awaiting::during_signalling) == "awaited during a signalling");
  }

  TEST_CASE("two threads that signal each other, many times") {
    const bool full = tests::is_full();
    const std::uint64_t max = full ? 10'000'000 : 20'000;
    Signal there, back;
    std::uint64_t value = 0, wrong = 0;
    std::thread other([&] {
      for (;;) {
        if (there.await() == Awaiting::interrupted) return;
        value = 2 * value;
        while (back.signal() != Signalling::done) std::this_thread::yield();
      }
    });
    const auto end = MachineClock::now() + 300ms;
    for (std::uint64_t i = 1; i <= max && (full || MachineClock::now() < end); ++i) {
      value = i;
      while (there.signal() != Signalling::done) std::this_thread::yield();
      if (back.await() != Awaiting::signalled || value != 2 * i) ++wrong;
    }
    there.interrupt();
    other.join();
    CHECK(wrong == 0);
  }

  TEST_CASE("many who wait for moments and many who signal: every signalling is somebody's") {
    const auto end = MachineClock::now() + (tests::is_full() ? 30000ms : 300ms);
    Signal signal;
    std::atomic<std::uint64_t> done{0}, woken{0};
    // longer where a busy machine let them never meet
    const auto goes_on = [&] {
      const auto now = MachineClock::now();
      return now < end || (done == 0 && now < end + 20s);
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i)
      threads.emplace_back([&] {
        while (goes_on())
          if (signal.await(MachineClock::now() + 20us) == Awaiting::signalled) ++woken;
      });
    for (int i = 0; i < 2; ++i)
      threads.emplace_back([&] {
        while (goes_on())
          if (signal.signal() == Signalling::done) ++done;
      });
    for (std::thread& thread : threads) thread.join();
    CHECK(signal.waiting() == 0);
    CHECK(done > 0);
    CHECK(woken >= done);
    CHECK(woken <= 3 * done);
  }
}
