// Who looks after a run, with a run that does as the test wants.
#include "runtime/execute/attend.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <atomic>
#include <thread>

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Covers until it is asked for rest or closed, then rests for a while.
class Run : public AttendedRun {
 public:
  void cover() override {
    while (!closed && !asked && !over) std::this_thread::sleep_for(1ms);
    if (closed || !longest) return;
    rests = true;
    const auto end = std::chrono::steady_clock::now() + takes;
    while (!closed && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
    if (fails) throw std::runtime_error("lost");
  }
  bool stopped_by_fault() const override { return has_fault; }
  std::optional<Duration> longest_rest() const override { return longest; }
  void ask_for_rest() override { asked = true; }
  bool resting() const override { return rests; }
  void close(const Ending&, Futex::Time) override { closed = true; }
  std::vector<HangingTask> running() const override { return now_running; }
  std::optional<Call> call() const override {
    std::optional<Call> now = in_call;
    if (calls_go_on && now) now->of.instant = looks++ * 1ms;
    return now;
  }
  Finish finish(Futex::Time) override {
    has_fault = has_fault || fails_at_last;
    return {};
  }

  std::optional<Duration> longest = 1h;
  Duration takes = 30ms;
  bool fails = false, fails_at_last = false;
  std::vector<HangingTask> now_running;
  std::optional<Call> in_call;
  bool calls_go_on = false;
  mutable int looks = 0;
  std::atomic<bool> over{false}, has_fault{false}, asked{false}, rests{false}, closed{false};
};

Wish no_wish() { return {}; }
}  // namespace

TEST_SUITE("runtime/execute/attend") {
  TEST_CASE("a signal is answered by the way to rest, which is said, and its end is that of the run") {
    Run run;
    std::vector<std::string> said;
    const RunEnd end = attend(
        run, [] {},
        [] {
          return Wish{SIGTERM, false};
        },
        [&](const Ending& why) { said.push_back(why.reason); });
    CHECK(run.asked);
    CHECK(end.ending.cause == Ending::Cause::signal);
    CHECK(end.ending.signal == SIGTERM);
    REQUIRE(end.before_rest.has_value());
    CHECK(end.before_rest->reason == "SIGTERM ended the run");
    CHECK(said == std::vector<std::string>{"SIGTERM ended the run"});
  }

  TEST_CASE("a fault of what had still to end when the time was over stops the run, too") {
    Run run;
    run.longest.reset();
    run.over = true;
    run.fails_at_last = true;
    CHECK(attend(
              run, [] {}, no_wish, [](const Ending&) {})
              .ending.cause == Ending::Cause::fault);
  }

  TEST_CASE("an activation that takes long is reported, once, and the run goes on") {
    Run run;
    run.longest.reset();
    run.now_running = {{"slow", 3, 30ms}};
    std::vector<std::string> reported;
    const auto begin = std::chrono::steady_clock::now();
    const RunEnd end = attend(
        run, [] {},
        [&] {
          if (!reported.empty() && std::chrono::steady_clock::now() - begin > 400ms) run.over = true;
          return Wish{};
        },
        [](const Ending&) {}, [] {},
        {.report = [&](const HangingTask& task) { reported.push_back(to_text(task)); }, .after = 100ms});
    CHECK(reported == std::vector<std::string>{"task 'slow' activation 3 at 0.03 s has not ended"});
    CHECK(end.ending.cause == Ending::Cause::over);
  }

  TEST_CASE("a distributer that does not return ends the run after a while, and is named") {
    Run run;
    run.longest.reset();
    run.in_call = Call{{"display", 2900ms}, 50ms};
    const RunEnd end = attend(
        run, [] {}, no_wish);
    CHECK(end.ending.cause == Ending::Cause::hung);
    CHECK(end.ending.reason == "distributer 'display' at 2.9 s has not returned, which ended the run");
    CHECK_FALSE(end.hangs);  // it did at last
  }

  TEST_CASE("one call of a distributer's after another does not end the run, however long they take together") {
    Run run;
    run.longest.reset();
    run.in_call = Call{{"display", 0ms}, 50ms};
    run.calls_go_on = true;
    const auto begin = std::chrono::steady_clock::now();
    const RunEnd end = attend(
        run, [] {},
        [&] {
          if (std::chrono::steady_clock::now() - begin > 300ms) run.over = true;
          return Wish{};
        });
    CHECK(run.looks > 5);
    CHECK(end.ending.cause == Ending::Cause::over);
  }

  TEST_CASE("what is not brought to rest ends at the first signal") {
    Run run;
    run.longest.reset();
    const RunEnd end = attend(
        run, [] {},
        [] {
          return Wish{SIGINT, false};
        });
    CHECK(!run.asked);
    CHECK(!end.before_rest.has_value());
    CHECK(end.ending.reason == "SIGINT ended the run");
  }

  TEST_CASE("a second signal ends it at once, and counts as the first one") {
    Run run;
    run.takes = 1h;
    std::atomic<bool> again{false};
    const RunEnd end = attend(
        run, [] {},
        [&] {
          return Wish{SIGTERM, again.load()};
        },
        [&](const Ending&) { again = true; });
    CHECK(run.closed);
    CHECK(end.ending.signal == SIGTERM);
    CHECK(end.ending.reason == "a second signal came");
    CHECK(end.before_rest->reason == "SIGTERM ended the run");
  }

  TEST_CASE("a run that is over comes to rest by itself; a first signal changes nothing then") {
    for (const int signal : {0, SIGINT}) {
      Run run;
      run.over = true;
      run.takes = 100ms;
      std::vector<std::string> said;
      const RunEnd end = attend(
          run, [] {},
          [&] {
            return Wish{run.rests ? signal : 0, false};
          },
          [&](const Ending& why) { said.push_back(why.reason); });
      CHECK(end.ending.cause == Ending::Cause::over);
      CHECK(end.ending.signal == 0);
      CHECK(end.before_rest->cause == Ending::Cause::over);
      CHECK(said == std::vector<std::string>{"the run was over"});
    }
  }

  TEST_CASE("a fault or a loss on the way to rest is the end of the run") {
    Run faulty;
    faulty.has_fault = true;
    const RunEnd fault = attend(
        faulty, [] {},
        [] {
          return Wish{SIGINT, false};
        });
    CHECK(fault.ending.cause == Ending::Cause::fault);
    CHECK(fault.before_rest->signal == SIGINT);
    Run lost;
    lost.fails = true;
    const RunEnd loss = attend(
        lost, [] {},
        [] {
          return Wish{SIGINT, false};
        });
    CHECK(loss.ending.cause == Ending::Cause::lost);
  }

  TEST_CASE("what holds the way to rest up ends a second after the longest time") {
    Run run;
    run.takes = 1h;
    run.longest = 50ms;
    const auto begin = std::chrono::steady_clock::now();
    const RunEnd end = attend(
        run, [] {},
        [] {
          return Wish{SIGINT, false};
        });
    CHECK(std::chrono::steady_clock::now() - begin >= 1050ms);
    CHECK(run.closed);
    CHECK(end.ending.reason == "SIGINT ended the run");
  }

  TEST_CASE("without a wish it goes on to its end") {
    Run run;
    run.longest.reset();
    run.over = true;
    CHECK(attend(
              run, [] {}, no_wish)
              .ending.cause == Ending::Cause::over);
  }
}
