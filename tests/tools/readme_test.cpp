// The README shows what the command really prints.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <string>

#include "graph/yaml/yaml.h"

namespace {
std::string output_of(const std::string& arguments) {
  std::string output;
  std::FILE* pipe = popen((std::string(JAROL_COMMAND) + " " + arguments).c_str(), "r");
  std::array<char, 4096> chunk{};
  for (std::size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), pipe)) > 0;) output.append(chunk.data(), n);
  pclose(pipe);
  return output;
}

std::string readme() { return jarol::read_source("README.md")->text; }
}  // namespace

TEST_SUITE("tools/readme") {
  TEST_CASE("the README shows the verdict on the demo as it is") {
    const std::string verdict = output_of("check specs/exolauv.yaml");
    CHECK(verdict.size() > 300);
    CHECK(readme().find(verdict) != std::string::npos);
  }

  TEST_CASE("the README shows the change that makes the demo unschedulable, and what check says to it") {
    const std::string verdict = output_of("check specs/exolauv.yaml --set tasks.speed.wcet=60ms");
    CHECK(verdict.size() > 300);
    CHECK(readme().find(verdict) != std::string::npos);
  }

  TEST_CASE("the README shows a message and a packet as the command tells them") {
    for (const char* arguments : {"messages imc DesiredZ", "messages javiator --decode"}) {
      const bool decode = std::string(arguments).ends_with("--decode");
      const std::string output = output_of(std::string(arguments) + (decode ? " <<END\nffff0f021f400070\nEND" : ""));
      CHECK(output.size() > 100);
      CHECK(readme().find(std::string(arguments) + "\n" + output) != std::string::npos);
    }
  }

  TEST_CASE("the README shows what the demo reaches as it is") {
    for (const std::string graph : {"exolauv", "javiator"}) {
      const std::string run = output_of("run specs/" + graph + ".yaml");
      const std::size_t begin = run.find("               commanded"), end = run.find("  digest");
      REQUIRE(begin < end);
      CHECK(readme().find(run.substr(begin, end - begin)) != std::string::npos);
    }
  }
}
