// Every message that the loader and the validator can give has a file in specs/broken, and its whole text beside this.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "graph/yaml/problems.h"
#include "graph/yaml/yaml.h"
#include "tools/load_graph.h"

namespace {
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) { return jarol::read_source(path.string())->text; }

std::string report_on(const std::string& file) {
  try {
    jarol::tools::load_graph(file, {});
  } catch (const jarol::SpecError& error) { return error.what() + std::string("\n"); }
  return "";
}

std::vector<std::string> broken_graphs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator("specs/broken"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}
}  // namespace

TEST_SUITE("tools/broken") {
  TEST_CASE("each broken graph gets the report that is expected, word for word") {
    const auto names = broken_graphs();
    CHECK(names.size() > 100);
    for (const std::string& name : names) {
#ifndef JAROL_VEHICLES
      if (name.starts_with("vehicle_")) continue;  // this build has no vehicles
#endif
      CAPTURE(name);
      const std::string expected = text_of("tests/tools/broken/" + name + ".txt");
      CHECK(expected != "");
      CHECK(report_on("specs/broken/" + name + ".yaml") == expected);
    }
  }

  TEST_CASE("no expectation is left without its graph") {
    const auto names = broken_graphs();
    for (const auto& entry : fs::directory_iterator("tests/tools/broken"))
      CHECK(std::binary_search(names.begin(), names.end(), entry.path().stem().string()));
  }
}
