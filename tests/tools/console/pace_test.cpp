// A run on the virtual clock beside the wall clock: halted, stepped, and the same whatever its pace.
#include "distributers/session/pace.h"

#include <doctest/doctest.h>

#include <thread>

#include "graph/text/errors.h"
#include "tools/commands/run/load_graph.h"
#include "tools/console/console.h"
#include "tools/console/options.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tools::parse_pace;
using tools::console::obey;

// Counts every 10 ms.
constexpr const char* counting_text = R"(
graph: counting
timing: {period: 10ms}
tasks: {count: {type: Counter, wcet: 10us}}
)";

GraphRun make_run() {
  return GraphRun(tools::load_graph(std::make_shared<Source>(Source{"counting.yaml", counting_text}), {}), {});
}

std::string refused(Pace& pace, const std::string& message) {
  try {
    obey(pace, message);
    return "nothing";
  } catch (const InputError& error) { return error.what(); }
}
}  // namespace

TEST_SUITE("console/pace") {
  TEST_CASE("a run is the same at any pace") {
    GraphRun plain = make_run(), paced = make_run(), fast = make_run();
    plain.executor().cover(300ms);
    Pace(100.0).cover(paced, 300ms);
    Pace(std::nullopt).cover(fast, 300ms);
    CHECK(plain.executor().report().activations == 30);
    for (const GraphRun* other : {&paced, &fast}) {
      CHECK(other->executor().report().digest == plain.executor().report().digest);
      CHECK(other->executor().report().activations == 30);
      CHECK(other->executor().report().covered == 300ms);
    }
  }

  TEST_CASE("a run does not go faster than its pace") {
    GraphRun run = make_run();
    Pace pace(2.0);
    const auto begun = std::chrono::steady_clock::now();
    pace.cover(run, 200ms);
    CHECK(std::chrono::steady_clock::now() - begun >= 100ms);
  }

  TEST_CASE("a paused run goes on by instants, as many as are asked for") {
    GraphRun run = make_run();
    Pace pace(std::nullopt);
    pace.step(3);
    CHECK(pace.state().paused);
    std::thread thread([&] { pace.cover(run, 1s); });
    while (run.executor().now() < 20ms + 1ns) std::this_thread::yield();
    CHECK(run.executor().now() == 20ms + 1ns);
    pace.step(1);
    while (run.executor().now() < 30ms + 1ns) std::this_thread::yield();
    pace.end();
    thread.join();
    CHECK(run.executor().now() == 30ms + 1ns);
    CHECK(run.executor().report().activations == 4);
  }

  TEST_CASE("a paused run that goes on ends where it was to end") {
    GraphRun run = make_run();
    Pace pace(std::nullopt);
    pace.pause();
    pace.go_on();
    CHECK_FALSE(pace.state().paused);
    pace.cover(run, 1s);
    CHECK(run.executor().report().covered == 1s);
  }

  TEST_CASE("who pauses drops the steps that are not taken yet") {
    GraphRun run = make_run();
    Pace pace(std::nullopt);
    pace.step(10000);
    pace.pause();
    std::thread thread([&] { pace.cover(run, 100s); });
    std::this_thread::sleep_for(20ms);
    pace.end();
    thread.join();
    CHECK(run.executor().report().activations == 0);
  }

  TEST_CASE("steps add up to as many as one may ask for at once") {
    GraphRun run = make_run();
    Pace pace(std::nullopt);
    for (int i = 0; i < 80; ++i) pace.step(Pace::max_steps);
    std::thread thread([&] { pace.cover(run, 200s); });
    const Duration last = (Pace::max_steps - 1) * 10ms + 1ns;
    while (run.executor().now() < last) std::this_thread::yield();
    std::this_thread::sleep_for(20ms);
    pace.end();
    thread.join();
    CHECK(run.executor().now() == last);
  }

  TEST_CASE("pages ask in JSON") {
    Pace pace(1.0);
    obey(pace, R"({"do": "pause"})");
    CHECK(pace.state().paused);
    obey(pace, R"({"do": "go_on"})");
    CHECK_FALSE(pace.state().paused);
    obey(pace, R"({"do": "speed", "speed": 0.25})");
    CHECK(pace.state().speed == 0.25);
    obey(pace, R"({"do": "speed", "speed": "max"})");
    CHECK(pace.state().speed == std::nullopt);
    obey(pace, R"({"do": "step", "instants": 2})");
    CHECK(pace.state().paused);
  }

  TEST_CASE("what a page asks for and makes no sense is refused, and changes nothing") {
    Pace pace(1.0);
    const std::string object = R"(expected an object as in {"do": "pause"})";
    for (const std::string garbage : {"", "\xff", "[]", "1", "{", R"({"do": 1})", R"({"go": "on"})"})
      CHECK(refused(pace, garbage) == object);
    CHECK(refused(pace, R"({"do": "step", "instants": )" + std::string(100'000, '[') + std::string(100'000, ']') +
                            "}") == "the message is nested deeper than 64 levels");
    CHECK(refused(pace, R"({"do": "fly"})") == "there is no 'fly' to do; there are: pause, go_on, step, speed");
    for (const std::string speed : {"0", "-1", "1e9", "\"fast\"", "null", "true"})
      CHECK(refused(pace, R"({"do": "speed", "speed": )" + speed + "}") ==
            "'speed' is no number from 0.001 to 1000, nor \"max\"");
    for (const std::string instants : {"0", "-1", "1.5", "10001", "\"one\""})
      CHECK(refused(pace, R"({"do": "step", "instants": )" + instants + "}") ==
            "'instants' of step is no whole number from 1 to 10000");
    CHECK(pace.state() == Pace::State{1.0, false});
  }

  TEST_CASE("a pace is a number or max") {
    CHECK(parse_pace("0.1") == 0.1);
    CHECK(parse_pace("10") == 10.0);
    CHECK(parse_pace("max") == std::nullopt);
    for (const std::string wrong : {"", "fast", "0", "-1", "1x", "nan", "inf", "1e9"})
      CHECK_THROWS_WITH_AS(
          parse_pace(wrong),
          ("--pace: '" + wrong + "' is no number from 0.001 to 1000, nor max; write it as in 1, 0.1 or 10").c_str(),
          InputError);
  }
}
