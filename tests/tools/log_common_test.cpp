// jarol log diff --common: two recordings of graphs that are not the same.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;

// Of a graph of a counter and that task.
struct Recorded {
  std::string run(const std::string& name, const std::string& task) {
    const std::string graph = folder.write(name + ".yaml", R"(graph: g
timing: {period: 10ms}
tasks:
  count: {type: Counter, wcet: 10us}
  )" + task + "\n");
    const std::string file = folder / (name + ".mcap");
    REQUIRE(command::run_jarol("run " + graph + " --for 100ms --record " + file).exit_code == 0);
    return file;
  }
  TemporaryFolder folder;
};
}  // namespace

TEST_SUITE("tools/log_common") {
  TEST_CASE("two recordings are compared by the topics that both have, and those left out are named") {
    Recorded recorded;
    const std::string a = recorded.run("a", "first: {type: Counter, wcet: 10us}"),
                      b = recorded.run("b", "second: {type: Counter, wcet: 10us}");
    CHECK(command::run_jarol("log diff " + a + " " + b).output.starts_with("DIFFERENT, 10 values compared\n"));
    const auto common = command::run_jarol("log diff --common " + a + " " + b);
    CHECK(common.exit_code == 0);
    CHECK(common.output ==
          "the same, 10 values of topics that both have\n"
          "  left out    'first.out' is only in A\n  left out    'second.out' is only in B\n");
    const auto json = nlohmann::json::parse(command::run_jarol("log diff --common --json " + a + " " + b).output);
    CHECK(json["verdict"] == "same");
    CHECK(json["apart"].empty());
    CHECK(json["left_out"] == nlohmann::json{"'first.out' is only in A", "'second.out' is only in B"});
  }

  TEST_CASE("a value of both that differs is a difference") {
    Recorded recorded;
    const std::string a = recorded.run("a", "last: {type: Counter, wcet: 10us}"),
                      b = recorded.run("b", "last: {type: Counter, wcet: 10us, period: 5ms}");
    const auto common = command::run_jarol("log diff --common " + a + " " + b);
    CHECK(common.exit_code == 1);
    CHECK(common.output.starts_with("DIFFERENT, 20 values compared\n"));
  }

  TEST_CASE("recordings without a topic in common are nothing to compare, and only diff has that option") {
    const TemporaryFolder folder;
    const std::string a = folder / "a.mcap", b = folder / "b.mcap";
    const std::string run = "run specs/counting.yaml --for 100ms --record-what ";
    REQUIRE(command::run_jarol(run + "'count.*' --record " + a).exit_code == 0);
    REQUIRE(command::run_jarol(run + "'add.*' --record " + b).exit_code == 0);
    const auto nothing = command::run_jarol("log diff --common " + a + " " + b);
    CHECK(nothing.exit_code == 2);
    CHECK(nothing.output ==
          "NOTHING TO COMPARE: no topic of both has values\n"
          "  left out    'count.out' is only in A\n  left out    'add.out' is only in B\n");
    CHECK(command::run_jarol("log info --common " + a).output == "error: --common belongs to diff\n");
  }
}
