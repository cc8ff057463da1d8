// Several plugins, or builds of one, in one process; and what a plugin takes from the C library.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "graph/plugins/isolated.h"
#include "graph/plugins/plugin_build.h"
#include "graph/plugins/plugins.h"
#include "tests/tools/plugin_library.h"
#include "tests/tools/run_command.h"
#include "tools/library/built_in.h"

namespace {
namespace fs = std::filesystem;
using namespace jarol;
using command::run_jarol;

std::string absolute(const std::string& name) { return fs::absolute(tests::library(name)).string(); }

std::string graph_of(const std::string& plugins, const std::string& tasks) {
  return "graph: g\nplugins: [" + plugins + "]\ntiming: {period: 10ms}\ntasks: {" + tasks + "}\n";
}

// As compilers do it: a new file by the old name.
void build_again(const std::string& from, const std::string& to) {
  fs::copy_file(from, to + ".new", fs::copy_options::overwrite_existing);
  fs::rename(to + ".new", to);
}

// What sanitizers add offends, and is not looked at.
bool is_sanitized() {
  constexpr PluginBuild ours = build_of_this_file();
  return ours.options.address_sanitizer != 0 || ours.options.thread_sanitizer != 0;
}

// What is said of a plugin, which is loaded beside all that are.
std::string load(const std::string& path, Registry& registry) {
  registry = built_in().graph;
  return load_plugin(path, registry);
}
}  // namespace

TEST_SUITE("tools/plugins_together") {
  TEST_CASE("each of two plugins has its own constants and structs, whatever their names") {
    const command::TemporaryFolder folder;
    const std::string tasks = "old: {type: OldLaw}, new: {type: NewLaw}";
    const std::string rows = "time,new.pose.quality,new.pose.x,old.pose.x\n0,0.5,10,1\n0.01,0.5,20,2\n0.02,0.5,30,3\n";
    for (const std::string& plugins :
         {absolute("gains_old") + ", " + absolute("gains_new"), absolute("gains_new") + ", " + absolute("gains_old")}) {
      const auto done =
          run_jarol("run --for 30ms --trace - " + folder.write("g.yaml", graph_of(plugins, tasks)), "2>/dev/null");
      CHECK(done.exit_code == 0);
      CHECK(done.output.substr(0, rows.size()) == rows);
    }
  }

  TEST_CASE("a plugin that is built again while a process runs is that new build in its next graph") {
    const command::TemporaryFolder folder;
    const std::string now = folder / "now.so";
    Registry registry;
    build_again(absolute("gains_old"), now);
    REQUIRE(load(now, registry) == "");
    REQUIRE(registry.find_task("OldLaw") != nullptr);
    CHECK(registry.find_task("OldLaw")->out->size == sizeof(double));
    for (const std::string& name : {absolute("gains_new"), absolute("gains_old"), absolute("gains_new")}) {
      const std::string law = name == absolute("gains_new") ? "NewLaw" : "OldLaw";
      build_again(name, now);
      for (int again = 0; again < 2; ++again) {
        REQUIRE(load(now, registry) == "");
        REQUIRE(registry.find_task(law) != nullptr);
        CHECK(registry.find_task(law)->out->size == (law == "NewLaw" ? 2 : 1) * sizeof(double));
        // by the code that was loaded, in the file that stands there
        if (!is_sanitized()) CHECK(verify_tasks(registry, {law}, now, false).front().violations.empty());
      }
    }
    fs::resize_file(now, fs::file_size(now) + 1);
    CHECK(load(now, registry) ==
          "'" + now +
              "' was changed in its place after this process had loaded it; build it as a new file, or start the "
              "process again");
  }

#if defined(__GNUC__) && !defined(__clang__)
  TEST_CASE("plugins that g++ lets share symbols in a process are refused together, with the name of one") {
    const command::TemporaryFolder folder;
    const std::string old = absolute("shared_old"), newer = absolute("shared_new");
    for (const auto& [plugin, task] : {std::pair(old, "a: {type: OldLaw}"), std::pair(newer, "a: {type: NewLaw}")})
      CHECK(run_jarol("run --for 30ms " + folder.write("g.yaml", graph_of(plugin, task))).exit_code == 0);
    const std::string graph =
        folder.write("g.yaml", graph_of(old + ", " + newer, "old: {type: OldLaw}, new: {type: NewLaw}"));
    const auto refused = run_jarol("run --for 30ms " + graph, "2>&1 >/dev/null");
    CHECK(refused.exit_code == 2);
    const std::string why =
        " both define 'Gains::table' for the whole process (g++'s unique symbols), so that one "
        "would use the other's; build both with -fno-gnu-unique";
    CHECK(refused.output.find(graph + ":2:" + std::to_string(std::string("plugins: [, ").size() + old.size() + 1) +
                              ": error: '" + newer + "' and '" + old + "'" + why + "\n") != std::string::npos);

    // one that has none of these symbols goes with any, and what the program has is the program's for all
    for (const std::string& other : {absolute("gains_new"), absolute("shared_twice")})
      CHECK(run_jarol("run --for 30ms " + folder.write("g.yaml", graph_of(old + ", " + other, "old: {type: OldLaw}")))
                .exit_code == 0);

    const std::string now = folder / "now.so";
    Registry registry;
    build_again(old, now);
    REQUIRE(load(now, registry) == "");
    build_again(newer, now);
    CHECK(load(now, registry) == "'" + now + "' and an earlier build of it, which this process has loaded," + why);
    CHECK(registry.find_task("NewLaw") == nullptr);
  }
#endif

  TEST_CASE("what a plugin takes from the C library whose last bits are not defined is said, by name") {
    const command::TemporaryFolder folder;
    const std::string plugin = absolute("c_library");
    const std::string graph = folder.write("g.yaml", graph_of(plugin, "a: {type: CLibrary}"));
    const std::string other = ", which may give another digest on another processor";
    const auto json = nlohmann::json::parse(run_jarol("run --json --for 30ms " + graph, "2>/dev/null").output);
    CHECK(json["digest_notes"] == nlohmann::json{"c_library.so calls sinl of libm.so.6" + other,
                                                 "c_library.so calls tgamma of libm.so.6" + other});
    if (is_sanitized()) return;
    const auto done = run_jarol("isolation " + plugin);
    CHECK(done.exit_code == 0);
    CHECK(done.output.starts_with(plugin +
                                  ": ISOLATED, 1 of 1 task is\n  task CLibrary\n    note: calls 'sinl' of the "
                                  "C library" +
                                  other + "\n    note: calls 'tgamma' of the C library" + other + "\nnot seen:\n"));
    const auto notes = nlohmann::json::parse(run_jarol("isolation --json " + plugin).output)["files"][0]["tasks"][0];
    CHECK(notes["notes"].size() == 2);
    CHECK(notes["isolated"] == true);
  }
}
