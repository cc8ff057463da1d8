// A signal in every order of the steps of those who wait, signal and interrupt.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "runtime/jarol/signal.h"
#include "tests/runtime/model/model_threads.h"

namespace {
using namespace jarol;

using Explored = BasicSignal<model::ModelFutex>;

// What the threads of a program saw, in the order of their numbers.
struct Reported {
  Explored signal;
  std::vector<std::vector<std::string>> of;

  explicit Reported(std::size_t threads) : of(threads) {}
  void await(std::size_t thread, std::optional<std::int64_t> deadline = {}) {
    of[thread].emplace_back(to_text(signal.await(deadline)));
  }
  void notify(std::size_t thread) { of[thread].emplace_back(to_text(signal.signal())); }
  std::size_t count(const std::string& text) const {
    std::size_t found = 0;
    for (const auto& list : of) found += static_cast<std::size_t>(std::count(list.begin(), list.end(), text));
    return found;
  }
  std::string all() const {
    std::string text;
    for (const auto& list : of)
      for (const std::string& t : list) text += (text.empty() ? "" : "; ") + t;
    return text;
  }
};

// Explores and gathers all that the threads may see.
std::set<std::string> outcomes(std::size_t threads, const std::function<void(Reported&, std::size_t)>& thread,
                               const std::function<void(const Reported&)>& check = {}) {
  std::set<std::string> all;
  const model::Result result = model::explore([&] {
    auto reported = std::make_shared<Reported>(threads);
    model::Program program;
    for (std::size_t i = 0; i < threads; ++i) program.threads.emplace_back([=] { thread(*reported, i); });
    program.at_end = [&all, reported, check] {
      model::check(reported->signal.waiting() == 0, "somebody is still counted");
      if (check) check(*reported);
      all.insert(reported->all());
    };
    return program;
  });
  CHECK(result.failure == "");
  return all;
}
}  // namespace

TEST_SUITE("runtime/signal_model") {
  TEST_CASE("one who waits in time and one who signals: all that can happen" * doctest::skip(!model::available)) {
    const auto all = outcomes(2, [](Reported& reported, std::size_t thread) {
      if (thread == 0) reported.await(0, 0);
      if (thread == 1) reported.notify(1);
    });
    CHECK(all == std::set<std::string>{"was signalled; signalled", "waited in vain; signalled with no one waiting"});
  }

  TEST_CASE("nobody is missed by a signalling, whoever comes and goes" * doctest::skip(!model::available)) {
    const auto fits = [](const Reported& reported) {
      const std::size_t done = reported.count("signalled"), woken = reported.count("was signalled");
      model::check(woken >= done && woken <= 2 * done, "signallings and those they woke do not fit");
    };
    const auto two = outcomes(
        3,
        [](Reported& reported, std::size_t thread) {
          if (thread <= 1) reported.await(thread, 0);
          if (thread == 2)
            for (int i = 0; i < 2; ++i) reported.notify(thread);
        },
        fits);
    CHECK(two == std::set<std::string>{
                     "was signalled; was signalled; signalled; signalled",
                     "was signalled; was signalled; signalled; signalled during a signalling",
                     "was signalled; was signalled; signalled; signalled with no one waiting",
                     "was signalled; was signalled; signalled with no one waiting; signalled",
                     "was signalled; awaited during a signalling; signalled with no one waiting; signalled",
                     "awaited during a signalling; was signalled; signalled with no one waiting; signalled",
                     "was signalled; awaited during a signalling; signalled; signalled during a signalling",
                     "was signalled; awaited during a signalling; signalled; signalled with no one waiting",
                     "awaited during a signalling; was signalled; signalled; signalled during a signalling",
                     "awaited during a signalling; was signalled; signalled; signalled with no one waiting",
                     "was signalled; waited in vain; signalled; signalled during a signalling",
                     "was signalled; waited in vain; signalled; signalled with no one waiting",
                     "was signalled; waited in vain; signalled with no one waiting; signalled",
                     "waited in vain; was signalled; signalled; signalled during a signalling",
                     "waited in vain; was signalled; signalled; signalled with no one waiting",
                     "waited in vain; was signalled; signalled with no one waiting; signalled",
                     "waited in vain; waited in vain; signalled with no one waiting; signalled with no one waiting",
                 });
    const auto one = outcomes(
        2,
        [](Reported& reported, std::size_t thread) {
          for (int i = 0; i < 3; ++i) thread == 0 ? reported.await(0, 0) : reported.notify(1);
        },
        fits);
    CHECK(one.contains("was signalled; was signalled; was signalled; signalled; signalled; signalled"));
    CHECK(
        one.contains("was signalled; waited in vain; was signalled; signalled; signalled with no one waiting; "
                     "signalled"));
    CHECK(
        one.contains("waited in vain; was signalled; was signalled; signalled; signalled during a signalling; "
                     "signalled"));
  }

  TEST_CASE("of two who signal at once, one is reported" * doctest::skip(!model::available)) {
    const auto all = outcomes(3, [](Reported& reported, std::size_t thread) {
      if (thread == 0) {
        reported.await(0);
        reported.signal.interrupt();
      } else {
        reported.notify(thread);
        if (thread == 1 && reported.of[1].back() == to_text(Signalling::not_awaited)) reported.signal.interrupt();
      }
    });
    CHECK(all.contains("was signalled; signalled; signalled during a signalling"));
    CHECK(all.contains("was signalled; signalled during a signalling; signalled"));
    CHECK(all.contains("was signalled; signalled; signalled with no one waiting"));
    CHECK(all.contains("was signalled; signalled with no one waiting; signalled"));
    CHECK(all.contains("was interrupted while awaiting; signalled with no one waiting; signalled with no one waiting"));
    CHECK(!all.contains("was signalled; signalled; signalled"));
  }

  TEST_CASE("an interruption reaches everybody, whenever it comes" * doctest::skip(!model::available)) {
    const auto fits = [](const Reported& reported) {
      model::check((reported.count("signalled") == 1) == (reported.count("was signalled") > 0),
                   "signalled, and nobody was");
    };
    const auto two = outcomes(
        3,
        [](Reported& reported, std::size_t thread) {
          if (thread <= 1) reported.await(thread);
          if (thread == 2) {
            reported.notify(2);
            reported.signal.interrupt();
          }
        },
        fits);
    CHECK(two.contains("was signalled; was signalled; signalled"));
    CHECK(two.contains("was signalled; was interrupted while awaiting; signalled"));
    CHECK(two.contains("was interrupted while awaiting; was signalled; signalled"));
    CHECK(
        two.contains("was interrupted while awaiting; was interrupted while awaiting; signalled with no one waiting"));
    CHECK(two.contains("was signalled; awaited during a signalling; signalled"));

    const auto resumed = outcomes(
        3,
        [](Reported& reported, std::size_t thread) {
          if (thread == 0) reported.await(0);
          if (thread == 1) reported.notify(1);
          if (thread == 2) {
            reported.signal.interrupt();
            static_cast<void>(reported.signal.resume());
            reported.signal.interrupt();
          }
        },
        fits);
    CHECK(resumed == std::set<std::string>{"was signalled; signalled",
                                           "was interrupted while awaiting; signalled while interrupted",
                                           "was interrupted while awaiting; signalled with no one waiting"});
  }

  TEST_CASE("what is done before a signalling has happened for who was signalled" * doctest::skip(!model::available)) {
    const model::Result result = model::explore([] {
      struct Run {
        Explored signal;
        std::byte place{};
      };
      auto run = std::make_shared<Run>();
      return model::Program{{[run] {
                               const auto awaited = run->signal.await(0);
                               std::byte value{};
                               if (awaited == Awaiting::signalled)
                                 model::ModelMemory<>::copy_out(&value, &run->place, 1);
                             },
                             [run] {
                               const std::byte value{1};
                               model::ModelMemory<>::copy_in(&run->place, &value, 1);
                               static_cast<void>(run->signal.signal());
                             }},
                            {}};
    });
    CHECK(result.failure == "");
  }

  TEST_CASE("what is there before a signalling that nobody awaits is never slept through" *
            doctest::skip(!model::available)) {
    const model::Result result = model::explore([] {
      struct Run {
        Explored signal;
        model::ModelMemory<>::Atomic<std::uint32_t> there{0};
        Signalling signalled{};
      };
      auto run = std::make_shared<Run>();
      return model::Program{{[run] {
                               const auto ready = [&] { return run->there.load(std::memory_order_acquire) == 1; };
                               model::check(run->signal.await_unless(ready) == Awaiting::signalled, "not signalled");
                             },
                             [run] {
                               run->there.store(1, std::memory_order_release);
                               run->signalled = run->signal.signal();
                               model::check(run->signalled != Signalling::during_signalling, "of one who signals");
                             }},
                            [run] { model::check(run->signal.waiting() == 0, "somebody is still counted"); }};
    });
    CHECK(result.failure == "");
    CHECK(result.states > 20);
  }
}
