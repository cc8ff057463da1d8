#include "tools/report/graph_schema.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "graph/language/tables.h"
#include "graph/language/yaml.h"
#include "tools/library/built_in.h"

namespace {
std::string text_of(const std::string& path) { return jarol::read_source(path)->text; }
}  // namespace

TEST_SUITE("tools/graph_schema") {
  using namespace jarol;

#ifdef JAROL_VEHICLES
  // it knows the parameters of the vehicles, which a build without Simbody has none of
  TEST_CASE("the schema in specs is what the command prints") {
    CHECK(text_of("specs/graph.schema.json") == tools::graph_schema(built_in()));
  }
#endif

  TEST_CASE("the schema has every key of the loader's tables and no other") {
    const auto schema = nlohmann::json::parse(tools::graph_schema(built_in()));
    const auto& task = schema["properties"]["tasks"]["patternProperties"].begin().value();
    CHECK(task["properties"].size() == task_keys().size());
    for (const auto& key : task_keys()) CHECK(task["properties"].contains(key.name));
    CHECK(task["additionalProperties"] == false);
    CHECK(task["required"] == nlohmann::json{"type"});
    CHECK(schema["properties"].size() == graph_keys().size());
    CHECK(schema["required"] == nlohmann::json{"graph"});
  }

  TEST_CASE("the first line of each spec points an editor at the schema") {
    std::size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator("specs")) {
      if (entry.path().extension() != ".yaml") continue;
      ++seen;
      CHECK_MESSAGE(text_of(entry.path()).starts_with("# yaml-language-server: $schema=graph.schema.json\n"),
                    entry.path().string());
    }
    CHECK(seen >= 3);
  }
}
