// Tasks from shared libraries.
#include "graph/plugins.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "graph/plugin.h"
#include "tests/tools/run_command.h"
#include "tools/load_graph.h"
#include "tools/log_format.h"

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

  TEST_CASE("a plugin is named before it is loaded, once, and --no-plugins refuses it on every command") {
    const command::TemporaryFolder folder;
    const std::string so = std::filesystem::absolute(library("twice")).string();
    const std::string graph = folder.write("g.yaml", "graph: g\nplugins: [" + so + R"(]
tasks: {a: {type: Counter, period: 10ms, wcet: 1us}, b: {type: Twice, period: 10ms, wcet: 1us}}
connections: [a.out -> b.in]
)");
    const std::string note = "note: loads plugin '" + so + "'\n", log = folder / "log";
    for (const std::string command :
         {"run --for 100ms ", "check ", "check --measure --for 1s ", "graph ", "graph --json "}) {
      CAPTURE(command);
      const auto loaded = command::jarol(command + graph, "2>&1 >/dev/null");
      CHECK(loaded.exit_code == 0);
      CHECK(loaded.output.starts_with(note));
      CHECK(loaded.output.find(note, 1) == std::string::npos);
      const auto refused = command::jarol(command + graph + " --no-plugins", "2>&1 >/dev/null");
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.starts_with(graph + ":2:11: error: plugin '" + so +
                                       "' is not loaded: --no-plugins refuses it; leave that out, or the plugin\n"));
      CHECK(refused.output.find(note) == std::string::npos);
    }
    REQUIRE(command::jarol("run --for 100ms " + graph + " --log " + log).exit_code == 0);
    const auto replay = command::jarol("replay " + log + " " + graph, "2>&1 >/dev/null");
    CHECK(replay.exit_code == 0);
    CHECK(replay.output == note);
    CHECK(command::jarol("replay --no-plugins " + log + " " + graph).exit_code == 2);
    CHECK(command::jarol("run --no-plugins specs/counting.yaml --for 100ms").exit_code == 0);
  }

  TEST_CASE("a log never brings code: neither by its overrides nor by the graph that it names") {
    const command::TemporaryFolder folder;
    const std::string so = std::filesystem::absolute(library("twice")).string();
    const std::string graph = folder.write("g.yaml", R"(graph: g
tasks: {a: {type: Counter, period: 10ms}, b: {type: Twice, period: 10ms}}
connections: [a.out -> b.in]
)");
    const std::string log = folder / "log", set = " --set plugins=[" + so + "]",
                      note = "note: loads plugin '" + so + "'\n";
    const auto run = command::jarol("run --for 100ms " + graph + set + " --log " + log, "2>&1 >/dev/null");
    CHECK(run.exit_code == 0);
    CHECK(run.output == note + "note: the log does not name the plugins of --set; give them again to jarol replay\n");
    CHECK(command::jarol("replay " + log + set, "2>&1 >/dev/null").output == note);
    CHECK(command::jarol("replay " + log + " " + graph + set).exit_code == 0);
    CHECK(command::jarol("replay " + log).exit_code == 2);

    // the file that the log names has come to name a plugin
    std::ofstream(graph, std::ios::app) << "plugins: [" << so << "]\n";
    const auto named = command::jarol("replay " + log, "2>&1 >/dev/null");
    CHECK(named.exit_code == 2);
    CHECK(named.output.find(graph + ":4:11: error: plugin '" + so +
                            "' is not loaded: the log names this graph, and a log names no code; name it yourself: "
                            "jarol replay LOG FILE\n") != std::string::npos);
    CHECK(named.output.find(note) == std::string::npos);
    CHECK(command::jarol("replay " + log + " " + graph).exit_code == 0);

    // whoever writes a log with plugins of its own, and mends its sums
    for (const std::string path : {"plugins", "plugins.x"}) {
      const tools::LogHeader header{.graph = "g",
                                    .file = graph,
                                    .file_sum = "",
                                    .overrides = {"", {"tasks.a.init.out=1", path + "=[" + so + "]"}},
                                    .clock = "virtual"};
      const std::string line = tools::to_line(header);
      tools::LogRecord record{0, tools::LogRecord::header, 0, 0};
      record.sum = tools::LogRecord::sum_of(record, line);
      const std::string made =
          folder.write("made", line + std::string(reinterpret_cast<const char*>(&record), sizeof record));
      for (const std::string& words : {made, made + " " + graph}) {
        const auto refused = command::jarol("replay " + words, "2>&1 >/dev/null");
        CHECK(refused.exit_code == 2);
        CHECK(refused.output == "error: '" + made + "' sets '" + path + "=[" + so +
                                    "]', and a log names no code to load; it is no log that jarol run --log has "
                                    "written\n");
      }
    }
  }
}
