// Links and distributers of plugins that throw, or that never return: the run ends, and says whose fault it was.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>

#include "tests/tools/plugin_library.h"
#include "tests/tools/process.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol::tests;
using namespace std::chrono_literals;

struct FaultyRun {
  int exit_code = 0;
  std::string errors;
  nlohmann::json report;
  std::chrono::duration<double> took{};

  /// Why what is safe was not handed over; empty: it was.
  std::string lost() const {
    const nlohmann::json& level = report["failsafe"]["level"];
    return level["at_end"] == true ? "" : level["at_end_failure"].get<std::string>();
  }
};

FaultyRun run_faulty(const std::string& display, const std::string& fault, const std::string& length, int signal = 0) {
  const command::TemporaryFolder folder;
  const std::string graph = folder.write(
      "g.yaml", "graph: g\ntiming: {period: 10ms}\nplugins: [" + std::filesystem::absolute(library("faulty")).string() +
                    "]\ndistributers: {display: {type: " + display + ", link: {type: faulty, fault: " + fault + R"(}}}
communicators:
  level: {channel: display.level, offset: 0ms, safe: -1}
  pressed: {channel: display.pressed, timeout: 1min}
tasks:
  count: {type: Counter, let: 10ms, wcet: 100us, on_fault: hold}  # late on a busy machine
  seen: {type: Relay, let: 10ms, wcet: 100us, on_fault: hold}
connections: [count.out -> level, pressed -> seen.in]
)");
  const auto begin = std::chrono::steady_clock::now();
  Process run("run " + graph + " --clock real --force --json --for " + length);
  if (signal != 0) {
    std::this_thread::sleep_for(700ms);
    run.signal(signal);
  }
  FaultyRun ran;
  ran.exit_code = run.end();
  ran.took = std::chrono::steady_clock::now() - begin;
  ran.errors = run.errors();
  CAPTURE(ran.errors);
  CAPTURE(run.output());
  REQUIRE(run.output().starts_with("{"));
  ran.report = run.json();
  return ran;
}
}  // namespace

TEST_SUITE("tools/faulty_links") {
  TEST_CASE("a link that throws where it receives ends the run, which names it and hands over what is safe") {
    const FaultyRun run = run_faulty("GoodDisplay", "receive_throws", "1h");
    CAPTURE(run.errors);
    CHECK(run.exit_code == 3);
    CHECK(command::has(run.errors, " s: faulty: receiving has failed: the modem has reset itself\n"));
    CHECK(run.report["ending"]["cause"] == "lost");
    CHECK(run.lost() == "");
  }

  TEST_CASE("a link that throws where it sends ends the run, which says that what is safe was not handed over") {
    for (const auto& [fault, cause] : {std::pair{"send_throws", "no carrier"},
                                       std::pair{"send_throws_int", "something was thrown that is no exception"}}) {
      const FaultyRun run = run_faulty("GoodDisplay", fault, "1h");
      CAPTURE(run.errors);
      CHECK(run.exit_code == 3);
      CHECK(command::has(run.errors, std::string(" s: faulty: sending has failed: ") + cause + "\n"));
      CHECK(run.report["ending"]["cause"] == "lost");
      CHECK(run.lost() == std::string("faulty: sending has failed: ") + cause);
    }
  }

  TEST_CASE("what is safe and a link could not send at the end was not handed over, and the exit code says so") {
    const FaultyRun run = run_faulty("GoodDisplay", "send_fails", "500ms");
    CAPTURE(run.errors);
    CHECK(run.exit_code == 3);
    CHECK(run.report["ending"]["cause"] == "over");
    CHECK(run.lost() == "the link had no room for it, or nobody to send it to any more");
  }

  TEST_CASE("where a link never had anybody to send to the report says so") {
    const FaultyRun run = run_faulty("GoodDisplay", "send_never", "300ms");
    CAPTURE(run.errors);
    CHECK(run.lost() == "the link had nobody to send it to all along");
  }

  TEST_CASE("a link or a distributer that does not finish is left behind, by its name, within a second") {
    for (const auto& each : {std::pair{"GoodDisplay", "send_blocks"}, std::pair{"EndlessDisplay", "none"}}) {
      CAPTURE(each.first);
      const FaultyRun over = run_faulty(each.first, each.second, "300ms");
      CAPTURE(over.errors);
      CHECK(over.exit_code == 3);
      CHECK(over.errors.ends_with("error: distributer 'display' has not finished; the program ends without it\n"));
      CHECK(over.report["ending"]["cause"] == "over");
      CHECK(over.report["ending"]["hanging"] ==
            nlohmann::json::parse(R"([{"distributer":"display","instant_ns":null}])"));
      // a link that blocks has not sent it
      CHECK((over.lost() == "") == (std::string(each.second) == "none"));
      const FaultyRun ended = run_faulty(each.first, each.second, "1h", SIGTERM);
      CHECK(ended.exit_code == 3);
      CHECK(ended.report["ending"]["signal"] == "SIGTERM");
      CHECK(ended.took < 10s);  // a busy machine may take long
    }
  }

  TEST_CASE("a distributer that does not return ends the run a second later, by its name and instant") {
    const FaultyRun run = run_faulty("BlockingDisplay", "none", "1h");
    CAPTURE(run.errors);
    CHECK(run.exit_code == 3);
    CHECK(command::has(run.errors, "error: distributer 'display' at "));
    CHECK(command::has(run.errors, " s has not returned; the program ends without it\n"));
    CHECK(run.report["ending"]["cause"] == "hung");
    CHECK(run.report["ending"]["hanging"][0]["distributer"] == "display");
    CHECK(run.lost() == "the link has not done what it was given before");
  }
}
