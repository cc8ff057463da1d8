// Memory that runs out while a graph is loaded: said so, whatever it was taken for.
#include <doctest/doctest.h>

#include <filesystem>

#include "tests/tools/run_command.h"

namespace {
// With so many KiB of address space.
command::Result within(int size, const std::string& arguments) {
  const std::string limited =
      "sh -c 'ulimit -v " + std::to_string(size) + "; exec " JAROL_COMMAND " " + arguments + "' 2>&1";
  command::Result result;
  std::FILE* pipe = popen(limited.c_str(), "r");
  std::array<char, 4096> chunk{};
  for (std::size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), pipe)) > 0;)
    result.output.append(chunk.data(), n);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

[[maybe_unused]] std::string large_graph() {
  std::string text = "graph: g\ntasks:\n", connections = "connections:\n";
  for (int i = 0; i < 3000; ++i) {
    const std::string name = "t" + std::to_string(i);
    text += "  " + name + ": {type: Relay, period: 10ms, wcet: 1us}\n";
    connections += "  - " + std::string(i == 0 ? "first" : "t" + std::to_string(i - 1)) + ".out -> " + name + ".in\n";
  }
  return text + "  first: {type: Counter, period: 10ms, wcet: 1us}\n" + connections;
}
// What the program takes before it begins.
int size_at_start() {
  int size = 16'000;
  while (within(size, "--version").exit_code != 0 && size < 4'000'000) size += 4'000;
  return size + 1'000;
}
}  // namespace

TEST_SUITE("tools/memory") {
  TEST_CASE("a large file that is not what it should be is not read to its end") {
    const command::TemporaryFolder folder;
    const std::string large = folder.write("large", ""), graph = folder.write("g.yaml", "graph: g\nplugins: [large]\n");
    std::filesystem::resize_file(large, std::uintmax_t{1} << 30);
    const int size = size_at_start() + 200'000;
    const auto has = [](const command::Result& result, const std::string& text) {
      CAPTURE(result.output);
      CHECK(result.exit_code == 2);
      CHECK(result.output.find(text) != std::string::npos);
    };
    has(within(size, "run specs/counting.yaml --for 1s --resume " + large), "is no checkpoint of this version");
    has(within(size, "check " + graph), "is no shared library with tasks");
    has(within(size, "isolation " + large), "is no object file for x86-64 that can be read");
  }

  TEST_CASE("where memory runs out while a graph is loaded, that is said, and the exit code is 3") {
    const command::TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", large_graph());
    int size = size_at_start();
    int too_little = 0;
    command::Result result;
    do {
      CAPTURE(size);
      result = within(size, "check " + graph);
      CAPTURE(result.output.substr(0, 300));
      REQUIRE((result.exit_code == 0 || result.exit_code == 3));
      too_little += result.exit_code == 3;
      if (result.exit_code == 3)
        REQUIRE(result.output.find("error: there is not enough memory for this\n") != std::string::npos);
      size += 500 + size / 50;
    } while (result.exit_code != 0);
    CHECK(too_little > 3);
    const auto json = within(size / 2, "check --json " + graph);
    if (json.exit_code == 3) CHECK(json.output.find("{\"schema\":\"jarol.problems/1\"") != std::string::npos);
  }

  TEST_CASE("what is repeated for megabytes is refused within a hundred of them") {
    const command::TemporaryFolder folder;
    const int size = size_at_start() + 100'000;
    for (const std::string token : {"[", "{", "\n", "[]", "\"", "&a ", "- [\n", "[a,\n"}) {
      CAPTURE(token);
      std::string text;
      while (text.size() < 10'000'000) text += token;
      const auto refused = within(size, "graph " + folder.write("g.yaml", text));
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.find(": error: ") != std::string::npos);
    }
    const std::string lines = folder.write("g.yaml", std::string(70'000'000, '\n'));
    CHECK(within(size, "graph " + lines).output ==
          "error: can't read '" + lines + "': it is larger than 64 MiB\n1 error\n");
  }
}
