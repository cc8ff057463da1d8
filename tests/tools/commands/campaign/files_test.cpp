// Plugins and builds of a campaign: what it has begun with.
#include <doctest/doctest.h>

#include <filesystem>

#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::TemporaryFolder;
namespace fs = std::filesystem;
}  // namespace

TEST_SUITE("tools/commands/campaign/files") {
  TEST_CASE("a plugin that is gone once the campaign has begun is still the one of all runs") {
    const TemporaryFolder folder;
    fs::copy_file(JAROL_PLUGIN_FOLDER "/low_pass.so", folder / "low_pass.so");
    const std::string graph =
        folder.write("g.yaml",
                     "graph: g\nplugins: [low_pass.so]\ntiming: {period: 10ms}\n"
                     "tasks: {count: {type: Counter, wcet: 1us}, smooth: {type: LowPass, wcet: 1us}}\n"
                     "connections: [count.out -> smooth.in]\n");
    // a plan of its own for each of many runs
    const std::string of = "campaign " + graph +
                           " --for 20s --workers 1 --vary 'tasks.smooth.priority=grid(1..400, "
                           "400)' --metric 'z=final(smooth.out)' ";
    REQUIRE(command::run_jarol(of + "--results " + (folder / "whole") + " --csv " + (folder / "whole.csv")).exit_code ==
            0);
    const std::string results = folder / "r";
    const auto gone = command::run_jarol(of + "--results " + results + " --csv " + (folder / "r.csv"),
                                         "2>&1 & id=$!; until [ -s " + results +
                                             "-wal ] || ! kill -0 $id 2>&-; do sleep 0.01; done; rm " +
                                             (folder / "low_pass.so") + "; wait $id; echo code $?");
    CHECK(gone.output.find("400 of 400 runs, 400 good; 400 of them") != std::string::npos);
    CHECK(gone.output.ends_with("code 0\n"));
    CHECK(content(folder / "r.csv") == content(folder / "whole.csv"));
  }

  TEST_CASE("another build of jarol from the same commit is another campaign") {
    const TemporaryFolder folder;
    const std::string of = " campaign specs/counting.yaml --for 1s --vary seed=1..3 --results " + (folder / "r");
    REQUIRE(command::run_jarol(of).exit_code == 0);
    const std::string other = folder / "jarol";
    const auto copied = command::run_jarol(
        "; id=$(readelf -n " JAROL_COMMAND " | sed -n 's/.*Build ID: //p'); echo $id", "2>&1", "true");
    const std::string id = copied.output.substr(0, copied.output.find('\n'));
    REQUIRE(id.size() == 40);
    std::string bytes = content(JAROL_COMMAND), note;
    for (std::size_t i = 0; i < id.size(); i += 2) note += static_cast<char>(std::stoi(id.substr(i, 2), nullptr, 16));
    const std::size_t at = bytes.find(note);
    REQUIRE(at != std::string::npos);
    fs::copy_file(JAROL_COMMAND, other);
    CHECK(command::run_jarol(of, "2>&1", other).exit_code == 0);  // a copy is the same build
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    std::ofstream(other, std::ios::binary | std::ios::in).write(bytes.data(), static_cast<std::streamsize>(at + 1));
    const auto refused = command::run_jarol(of, "2>&1", other);
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.starts_with("error: '" + (folder / "r") +
                                     "' has the results of another campaign: its 'build' was '" + id + "', not '"));
  }
}
