// What parts of a plugin throw: the message names the part, and nothing is taken for an error of this program.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <filesystem>

#include "tests/tools/plugin_library.h"
#include "tests/tools/process.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;
using jarol::tests::library;

std::string plugin(const std::string& name) { return std::filesystem::absolute(library(name)).string(); }

// What `check` says of that graph on stderr, after it has loaded the plugin.
command::Result checked(const std::string& graph) {
  auto result = command::run_jarol("check " + graph, "2>&1 >/dev/null");
  const std::string note = "note: loads plugin '" + plugin("throws") + "'\n";
  REQUIRE(result.output.starts_with(note));
  result.output.erase(0, note.size());
  return result;
}

// With an operator over that link.
std::string write_with_link(const TemporaryFolder& folder, const std::string& link) {
  return folder.write("g.yaml", "graph: g\ntiming: {period: 10ms}\nplugins: [" + plugin("throws") +
                                    "]\ndistributers:\n  terminal:\n    type: JaviatorOperator\n    link: " + link +
                                    "\n");
}
}  // namespace

TEST_SUITE("tools/plugins_thrown") {
  TEST_CASE("what a link type throws where it makes a link is a problem of that link, and names the type") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& link, const std::string& text) {
      const auto result = checked(write_with_link(folder, link));
      CHECK(result.output.starts_with((folder / "g.yaml") +
                                      ":7:11: error: link of distributer 'terminal' can't be made: " + text + "\n"));
      CHECK(result.exit_code == 2);
    };
    check("{type: throwing, fault: text}", "link type 'throwing': there is no modem");
    check("{type: throwing, fault: number}", "link type 'throwing': it throws what is no std::exception");
    check("{type: throwing_channels}", "link type 'throwing_channels': there are no channels");
  }

  TEST_CASE("what a link type throws with a type of its own stays as it is") {
    const TemporaryFolder folder;
    const std::string graph = folder / "g.yaml";
    const auto unfinished = checked(write_with_link(folder, "{type: throwing, fault: unfinished}"));
    CHECK(unfinished.output == "error: the modem has no power\n" + graph + ": 1 error\n");
    CHECK(unfinished.exit_code == 3);
    const auto address = checked(write_with_link(folder, "{type: throwing, fault: address}"));
    CHECK(address.output.starts_with(graph +
                                     ":7:11: error: distributer 'terminal': nobody knows where to announce it\n"));
    CHECK(address.exit_code == 2);
  }

  TEST_CASE("a policy that throws is named, with what it says, and the verdict is not reached") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& tasks, const std::string& text) {
      const std::string graph =
          folder.write("g.yaml", "graph: g\nplugins: [" + plugin("throws") +
                                     "]\nplatform: {policy: throwing}\ntiming: {period: 10ms}\ntasks:\n" + tasks);
      const auto result = checked(graph);
      CHECK(result.output == "error: policy 'throwing': " + text + "\n" + graph + ": 1 error\n");
      CHECK(result.exit_code == 3);
    };
    const std::string one = "  a: {type: Counter, wcet: 1ms}\n";
    check(one, "there is no table for so few");
    check(one + "  b: {type: Counter, wcet: 1ms}\n", "it throws what is no std::exception");
  }

  TEST_CASE("a vehicle in lockstep that throws ends its serving, and the run reads why") {
    const TemporaryFolder folder;
    const std::string port = jarol::tests::free_port(SOCK_STREAM), world = plugin("world");
    folder.write("lamp.yaml", "vehicle: lamp\n");
    jarol::tests::Process vehicle("vehicle lamp --plugin " + world + " --link lockstep --listen " + port);
    REQUIRE(vehicle.says("in lockstep at"));
    const auto ran = command::run_jarol(
        "run " +
            folder.write("g.yaml",
                         "graph: g\ntiming: {period: 10ms}\nplugins: [" + world +
                             "]\ndistributers: {lamp: {type: LampSwitch, link: {type: lockstep, peer: " + port +
                             R"(}}}
communicators: {level: {channel: lamp.level, offset: 0ms}}
tasks: {count: {type: Counter, let: 10ms}}
connections: [count.out -> level]
)") + " --for 20s",
        "2>&1 >/dev/null");
    const std::string why = "vehicle 'lamp': its filament breaks at level 901\n";
    CHECK(command::has(ran.output, " s: " + why));
    CHECK(ran.exit_code == 3);
    REQUIRE(vehicle.says("\nerror: " + why));
    CHECK(vehicle.end() == 3);
  }

  TEST_CASE("a vehicle that throws where a script drives it is named, with what it says") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& level, const std::string& text) {
      const auto driven = command::run_jarol("vehicle lamp --plugin " + plugin("world") + " --script " +
                                                 folder.write("levels.csv", "time,level\n0,1\n0.1," + level + "\n") +
                                                 " --for 1s --csv " + (folder / "light.csv"),
                                             "2>&1 >/dev/null");
      CHECK(command::has(driven.output, "error: vehicle 'lamp': " + text + "\n"));
      CHECK(driven.exit_code == 3);
    };
    check("950", "its filament breaks at level 950");
    check("0.5", "it throws what is no std::exception");
  }
}
