// jarol doctor reports facts of whatever machine the tests run on: their shape, and what must hold of each.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/tools/run_command.h"

namespace {
using command::run_jarol;

// Refused, and why; or permitted.
void check_permission(const nlohmann::json& permission) {
  CHECK(permission["permitted"].is_boolean());
  CHECK(permission.contains("refused") == !permission["permitted"]);
}
}  // namespace

TEST_SUITE("tools/doctor") {
  TEST_CASE("doctor reports facts and lateness as one JSON object") {
    const auto result = run_jarol("doctor --for 100ms --json");
    CHECK(result.exit_code == 0);
    const auto doctor = nlohmann::json::parse(result.output);
    CHECK(doctor["schema"] == "jarol.doctor/2");
    CHECK(doctor["kernel"].get<std::string>().size() > 3);
    CHECK(doctor["preempt_rt"].is_boolean());
    CHECK(doctor["cpus"] >= 1);
    CHECK(doctor["usable_cpus"].size() >= 1);
    CHECK(doctor["usable_cpus"].size() <= doctor["cpus"]);
    for (const char* name : {"affinity", "sched_fifo", "lock_memory", "guardian"}) check_permission(doctor[name]);
    CHECK((doctor["sched_fifo"]["highest_priority"] > 0) == doctor["sched_fifo"]["permitted"]);
    CHECK(doctor["min_timer_slack_ns"] == 1);
    CHECK(doctor["default_timer_slack_ns"] >= 1);
    CHECK(doctor["clock_resolution_ns"] >= 1);
    CHECK(doctor["governors"].is_array());
    CHECK(doctor["math"]["foreign_calls"] == nlohmann::json::array());
    CHECK(doctor["math"]["blas"].is_string());
    CHECK(doctor["math"]["blas_varies"].is_boolean());
    CHECK(doctor["period_ns"] == 1'000'000);

    std::vector<std::string> schedulers{"other"};
    if (doctor["sched_fifo"]["permitted"]) schedulers.emplace_back("fifo");
    REQUIRE(doctor["lateness"].size() == schedulers.size());
    for (std::size_t i = 0; i < schedulers.size(); ++i) {
      const auto& lateness = doctor["lateness"][i];
      CHECK(lateness["scheduler"] == schedulers[i]);
      CHECK(lateness["count"] == 100);
      CHECK(lateness["p50_ns"] > 0);
      CHECK(lateness["p50_ns"] <= lateness["p99_ns"]);
      CHECK(lateness["p99_ns"] <= lateness["worst_ns"]);
    }
  }

  TEST_CASE("doctor reports the same for people") {
    const std::string text = run_jarol("doctor --for 20ms").output;
    for (const char* part : {"this machine\n  kernel        ", "\n  CPUs          ", "\n  affinity      ",
                             "\n  SCHED_FIFO    ", "\n  memory        ", "\n  guardian      ", "\n  timer slack   ",
                             "\n  clock         CLOCK_MONOTONIC with a resolution of ", "\n  governor      ",
                             "\n  sin, exp, ... this program's own, for all libraries too\n  BLAS          ",
                             "\nlateness of bare sleeps at 1 kHz\n  ordinary      p50 ", "  of 20\n"}) {
      CAPTURE(part);
      CHECK(text.find(part) != std::string::npos);
    }
  }

  TEST_CASE("what is no duration, or too short a one, is an error") {
    const auto bare = run_jarol("doctor --for 10");
    CHECK(bare.exit_code == 2);
    CHECK(bare.output == "error: --for: '10' has no unit; write one of h, min, s, ms, us or ns, as in 10ms\n");
    const auto brief = run_jarol("doctor --for 10us");
    CHECK(brief.exit_code == 2);
    CHECK(brief.output == "error: --for: '10us' is less than one period of 1ms\n");
  }
}
