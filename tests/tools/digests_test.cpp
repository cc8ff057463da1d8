// One digest on every processor: applications x workers x what the C library may use of the processor x a run and its
// replay.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/how_many.h"
#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;
using nlohmann::json;

// by these glibc picks: as it finds the processor, without fused multiply-add, and as the oldest of this architecture
const std::vector<std::string> processors{"", "-AVX2,-FMA,-FMA4", "-AVX512F,-AVX2,-AVX,-FMA,-FMA4,-SSE4_1"};

void choose(const std::string& processor) { setenv("GLIBC_TUNABLES", ("glibc.cpu.hwcaps=" + processor).c_str(), 1); }

std::string digest_of(const std::string& arguments) {
  const command::Result result = command::run_jarol(arguments + " --json", "");
  INFO(arguments);
  CHECK(result.exit_code == 0);
  return json::parse(result.output)["digest"];
}

// what a shell prints
std::string output_of(const std::string& line) {
  std::FILE* pipe = popen(line.c_str(), "r");
  std::array<char, 256> text{};
  const std::size_t length = std::fread(text.data(), 1, text.size(), pipe);
  pclose(pipe);
  return {text.data(), length};
}

}  // namespace

TEST_SUITE("tools/digests") {
  TEST_CASE("functions of <math.h> give the same on all processors, whatever the C library's do") {
    std::set<std::string> theirs, ours;
    for (const std::string& processor : processors) {
      choose(processor);
      const std::string line = output_of(JAROL_MATH_PROBE);
      REQUIRE(line.size() == 34);
      theirs.insert(line.substr(0, 16));
      ours.insert(line.substr(17, 16));
    }
    unsetenv("GLIBC_TUNABLES");
    CHECK(ours.size() == 1);
    const std::string warning = theirs.size() > 1 ? "" : ": what is tested below proves little on this machine";
    MESSAGE("the C library's own functions give " << theirs.size() << " different results" << warning);
  }

  TEST_CASE("one digest for any processor and number of workers, in a run and in the replay of its log") {
    const TemporaryFolder folder;
    const std::string functions = folder.write("functions.yaml", std::string(R"(graph: functions
timing: {period: 1ms}
plugins: [)") + std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/functions.so").string() +
                                                                     R"(]
tasks:
  functions: {type: Functions}
  sum: {type: Accumulate}
connections: [functions.out -> sum.in]
)");
    const bool full = jarol::tests::is_full();
    const std::vector<std::string> applications{"specs/exolauv.yaml",
                                                "specs/exolauv.yaml --profile at_sea --seed 3",
                                                "specs/javiator.yaml",
                                                "specs/javiator.yaml --profile original",
                                                "specs/passthrough.yaml",
                                                "specs/counting.yaml",
                                                functions};
    for (const std::string& application : applications) {
      const bool endless = application == functions || application == "specs/counting.yaml";
      const std::string length = full && !endless ? "" : " --for 8s";
      std::map<std::string, std::vector<std::string>> found;
      for (const std::string& processor : processors)
        for (const int workers : {1, 2, 4, 8}) {
          choose(processor);
          const std::string with = std::to_string(workers) + " workers, " + processor, log = folder / "run.log";
          std::filesystem::remove(log);
          const std::string run =
              "run " + application + length + " --workers " + std::to_string(workers) + " --log " + log;
          found[digest_of(run)].push_back(with);
          // as on another machine: the log of this processor on the next one
          choose(processors[(static_cast<std::size_t>(workers) + processor.size()) % processors.size()]);
          found[digest_of("replay " + log + (application == functions ? " " + functions : ""))].push_back("replay of " +
                                                                                                          with);
        }
      std::string all;
      for (const auto& [digest, runs] : found)
        all += digest + ": " + std::to_string(runs.size()) + " runs, as with " + runs.front() + "\n";
      INFO(application << "\n" << all);
      CHECK(found.size() == 1);
    }
    unsetenv("GLIBC_TUNABLES");
  }
}
