// Tasks from shared libraries.
#include "graph/plugins.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "graph/plugin.h"
#include "tools/load_graph.h"

namespace {
using namespace jarol;

std::string library(const std::string& name) { return std::string(JAROL_PLUGIN_FOLDER) + "/" + name + ".so"; }

std::string report_on(const std::string& name) {
  Registry registry = tools::registry();
  const std::size_t before = registry.tasks().size();
  const std::string report = load_plugin(library(name), registry);
  if (!report.empty()) CHECK(registry.tasks().size() == before);
  return report;
}
}  // namespace

TEST_SUITE("tools/plugins") {
  TEST_CASE("a plugin brings its tasks, and they behave as all others") {
    Registry registry = tools::registry();
    CHECK(load_plugin(library("twice"), registry) == "");
    REQUIRE(registry.find_task("Twice") != nullptr);
    CHECK(registry.find_task("Twice")->summary == "doubles its input");
    CHECK(registry.find_task("Reverse")->is_deep());
  }

  TEST_CASE("a library that can't be used is told with the reason, and nothing of it is added") {
    CHECK(report_on("nowhere") == "there is no file '" + library("nowhere") + "'");
    CHECK(report_on("none") == "'" + library("none") +
                                   "' is a shared library without tasks; name them with JAROL_PLUGIN, see "
                                   "graph/plugin.h");
    CHECK(report_on("old") == "'" + library("old") + "' was built for form 0 of 4.2, this is " +
                                  std::string(plugin_form) + "; build it again");
    CHECK(report_on("clash") == "'" + library("clash") + "' brings a task type 'Counter', which there is already");
  }
}
