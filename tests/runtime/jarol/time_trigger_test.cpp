#include "runtime/jarol/time_trigger.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "tests/runtime/at_some_speed.h"
#include "tests/runtime/model/model_threads.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using ExploredTrigger = BasicTimeTrigger<model::ModelFutex>;

// A clock that stands still but while somebody sleeps, who wakes up a little late.
struct Sleeper {
  template <class T>
  using Atomic = std::atomic<T>;
  using Time = MachineClock::time_point;
  static inline Time time{};

  static Time now() { return time; }
  static bool wait(std::atomic<std::uint32_t>&, std::uint32_t, std::optional<Time> deadline) {
    time = *deadline + 300us;
    return false;
  }
  static void wake_all(std::atomic<std::uint32_t>&) {}
};
}  // namespace

TEST_SUITE("runtime/time_trigger") {
  TEST_CASE("ticks come on absolute time: they do not drift") {
    const auto first = MachineClock::now() + 2ms;
    TimeTrigger trigger(2ms, first);
    CHECK(trigger.period() == 2ms);
    for (int i = 0; i < 20; ++i) {
      const auto before = MachineClock::now();
      CHECK(trigger.await() == Awaiting::signalled);
      const auto after = MachineClock::now();
      // the first tick after `before` has come
      CHECK(after >= before + (2ms - (before - first + 2ms * 1000) % 2ms));
    }
    const auto ticks = [&] { return (MachineClock::now() - first) / 2ms + 1; };
    const auto before = ticks(), counted = 20 + trigger.unawaited(), after = ticks();
    CHECK(counted >= before);
    CHECK(counted <= after);
  }

  TEST_CASE("who wakes up late, or works on, is woken by the grid all the same") {
    const Sleeper::Time first = Sleeper::time + 5ms;
    BasicTimeTrigger<Sleeper> trigger(2ms, first);
    for (int i = 0; i < 20; ++i) {
      CHECK(trigger.await() == Awaiting::signalled);
      CHECK(Sleeper::time - 300us == first + i * 2ms);
      CHECK(trigger.ticks() == i + 1);
      Sleeper::time += 1ms;
    }
    CHECK(trigger.unawaited() == 0);
    Sleeper::time += 2ms;
    CHECK(trigger.await() == Awaiting::signalled);
    CHECK(Sleeper::time - 300us == first + 21 * 2ms);
    CHECK(trigger.unawaited() == 1);
  }

  TEST_CASE("a thread that works for most of the period is woken by the grid") {
    // a busy machine may delay some; who slept for a period, 7 ms after he woke up, would be spread over all of it
    CHECK(tests::at_some_speed([](int times) {
      const MachineClock::duration period = times * 10ms;
      const auto first = MachineClock::now() + period;
      TimeTrigger trigger(period, first);
      std::vector<MachineClock::duration> late;
      for (int i = 0; i < 15; ++i) {
        CHECK(trigger.await() == Awaiting::signalled);
        late.push_back((MachineClock::now() - first) % period);
        std::this_thread::sleep_for(times * 7ms);
      }
      std::sort(late.begin(), late.end());
      return late[late.size() / 2] < times * 3ms;
    }));
  }

  TEST_CASE("all who wait are woken by a tick") {
    TimeTrigger trigger(20ms);
    std::atomic<int> woken{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        if (trigger.await() == Awaiting::signalled) ++woken;
      });
    for (std::thread& thread : threads) thread.join();
    CHECK(woken == 4);
  }

  TEST_CASE("ticks that nobody awaits are counted") {
    const TimeTrigger late(1ms, MachineClock::now() + 1h);
    CHECK(late.unawaited() == 0);
    TimeTrigger trigger(1ms);
    std::this_thread::sleep_for(10ms);
    CHECK(trigger.unawaited() >= 9);
    const auto before = trigger.unawaited();
    CHECK(trigger.await() == Awaiting::signalled);
    CHECK(trigger.unawaited() >= before);
  }

  TEST_CASE("a timed await ends at its deadline if no tick comes before") {
    TimeTrigger trigger(1h);
    const auto before = MachineClock::now();
    CHECK(trigger.await(before + 5ms) == Awaiting::timed_out);
    CHECK(MachineClock::now() >= before + 5ms);
    CHECK(trigger.unawaited() == 0);
  }

  TEST_CASE("once stopped it wakes who waits, turns away who comes, and counts no more") {
    TimeTrigger trigger(1h);
    Awaiting result = Awaiting::signalled;
    std::thread thread([&] { result = trigger.await(); });
    std::this_thread::sleep_for(2ms);
    trigger.stop();
    trigger.stop();
    thread.join();
    CHECK(result == Awaiting::interrupted);
    CHECK(trigger.await() == Awaiting::interrupted);

    TimeTrigger quick(1ms);
    quick.stop();
    const auto counted = quick.unawaited();
    std::this_thread::sleep_for(5ms);
    CHECK(quick.await() == Awaiting::interrupted);
    CHECK(quick.unawaited() == counted);
  }

  TEST_CASE("a period is above zero") {
    CHECK_THROWS_WITH_AS(TimeTrigger(0ns), "the period of a time trigger is 0 ns; it must be above zero",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(TimeTrigger(-1ms), "the period of a time trigger is -1000000 ns; it must be above zero",
                         std::invalid_argument);
  }

  TEST_CASE("each tick is awaited or counted, however time and threads go" * doctest::skip(!model::available)) {
    struct Run {
      ExploredTrigger trigger{2, 2};  // ticks at 2, 4, 6
      std::array<std::vector<Awaiting>, 2> reported;

      void await(std::size_t thread, std::optional<std::int64_t> deadline = {}) {
        const Awaiting result = trigger.await(deadline);
        reported[thread].push_back(result);
        const std::int64_t now = model::time();
        if (result == Awaiting::timed_out) model::check(now >= *deadline, "timed out before the deadline");
        if (result != Awaiting::signalled) return;
        model::check(now >= 2, "signalled before a tick");
      }
      std::int64_t count(Awaiting result) const {
        return std::count(reported[0].begin(), reported[0].end(), result) +
               std::count(reported[1].begin(), reported[1].end(), result);
      }
      std::int64_t signalled() const { return count(Awaiting::signalled); }
      std::int64_t not_timed_out() const { return signalled() + count(Awaiting::interrupted); }
    };
    // Time goes up to 5: the ticks at 2 and 4 pass. Gathers how many are counted.
    const auto explore = [](const std::function<void(Run&)>& first, const std::function<void(Run&)>& second) {
      std::set<std::int64_t> counts;
      const model::Result result = model::explore([&] {
        auto run = std::make_shared<Run>();
        return model::Program{{[=] { first(*run); }, [=] { second(*run); },
                               [run] {
                                 for (const std::int64_t time : {2, 5}) model::set_time(time);
                                 run->trigger.stop();
                               }},
                              [run, &counts] {
                                const std::int64_t unawaited = run->trigger.unawaited();
                                counts.insert(unawaited);
                                model::check(unawaited <= 2, "more are counted than there were");
                                model::check(unawaited + run->not_timed_out() >= 2, "a tick is missing");
                                model::check(unawaited <= 1 || run->signalled() == 0, "a tick is counted twice");
                              }};
      });
      CHECK(result.failure == "");
      return counts;
    };
    const auto nothing = [](Run&) {};
    const auto twice = [](Run& run) {
      run.await(0);
      run.await(0);
    };
    CHECK(explore(nothing, nothing) == std::set<std::int64_t>{2});
    CHECK(explore(twice, nothing) == std::set<std::int64_t>{0, 1, 2});
    CHECK(explore([](Run& run) { run.await(0); }, [](Run& run) { run.await(1); }) == std::set<std::int64_t>{0, 1, 2});
    CHECK(explore([](Run& run) { run.await(0); }, [](Run& run) { run.await(1, 1); }) == std::set<std::int64_t>{1, 2});
  }
}
