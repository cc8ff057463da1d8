// Tasks from shared libraries.
#include "graph/plugins/plugins.h"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "graph/floating_point.h"
#include "graph/plugins/plugin.h"
#include "runtime/record/recording_writer.h"
#include "tests/tools/plugin_library.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"
#include "tools/library/built_in.h"

namespace {
using command::content;
using namespace jarol;
using jarol::tests::library;

// What is said of a library after its name; then nothing of it was added, and nothing changed here.
std::string report_on(const std::string& name) {
  Registry registry = built_in().graph;
  const std::size_t before = registry.tasks().size();
  std::string report = load_plugin(library(name), registry);
  if (!report.empty()) CHECK(registry.tasks().size() == before);
  CHECK(describe_difference(floating_point_control()) == "");
  const std::string start = "'" + library(name) + "' ";
  return report.rfind(start, 0) == 0 ? report.substr(start.size()) : report;
}

const std::string again = "; build it again as graph/plugins/plugin.h says";
}  // namespace

TEST_SUITE("tools/plugins") {
  TEST_CASE("a plugin brings its tasks, and they behave as all others") {
    Registry registry = built_in().graph;
    CHECK(load_plugin(library("twice"), registry) == "");
    REQUIRE(registry.find_task("Twice") != nullptr);
    CHECK(registry.find_task("Twice")->summary == "doubles its input");
    CHECK(registry.find_task("Reverse")->is_deep());
  }

  TEST_CASE("a plugin's tasks may have names that the headers use, too") {
    Registry registry = built_in().graph;
    CHECK(load_plugin(library("names"), registry) == "");
    CHECK(registry.find_task("Source")->summary == "counts");
    CHECK(registry.find_task("Problem")->summary == "does nothing");
    CHECK(registry.find_task("Sequence")->is_deep());
  }

  TEST_CASE("a plugin built with -fvisibility=hidden brings its tasks, and they run") {
    CHECK(report_on("hidden") == "");
    const command::TemporaryFolder folder;
    const auto run = [&](const std::string& name) {
      const std::string graph =
          folder.write(name + ".yaml", "graph: g\nplugins: [" + std::filesystem::absolute(library(name)).string() +
                                           R"(]
tasks: {a: {type: Counter, period: 10ms}, b: {type: Twice, period: 10ms}}
connections: [a.out -> b.in]
)");
      const auto done = command::run_jarol("run " + graph + " --for 1s --trace -", "2>/dev/null");
      CHECK(done.exit_code == 0);
      return done.output;
    };
    CHECK(run("hidden") == run("twice"));
    CHECK(run("hidden").find("0.99,99,198\n") != std::string::npos);
  }

  TEST_CASE("a library that can't be used is refused with the reason") {
    CHECK(report_on("nowhere") == "there is no file '" + library("nowhere") + "'");
    CHECK(report_on("none") ==
          "is no shared library with tasks; name them with JAROL_PLUGIN, see graph/plugins/plugin.h");
    CHECK(report_on("old") == "was built for form 3 of the interface, this is form 12" + again);
    CHECK(report_on("clash") == "brings a task type 'Counter', which there is already");
  }

  TEST_CASE("a library of another layout or arithmetic is refused by the name of the difference") {
    CHECK(report_on("old_strings") == "was built with -D_GLIBCXX_USE_CXX11_ABI=0" + again);
    CHECK(report_on("debug_containers") == "was built with -D_GLIBCXX_DEBUG" + again);
    CHECK(report_on("short_enums") == "was built with -fshort-enums" + again);
    CHECK(report_on("fast_math") ==
          "was built with -ffast-math or a part of it, so that it computes otherwise" + again);
    CHECK(report_on("finite_math") ==
          "was built with -ffast-math or a part of it, so that it computes otherwise" + again);
  }

  TEST_CASE("what differs is found by every number of a build") {
    const PluginBuild ours = build_of_this_file();
    CHECK(find_difference(ours, ours) == "");
    const auto with = [&](std::int32_t PluginBuild::*number, std::int32_t value) {
      PluginBuild other = ours;
      other.*number = value;
      return find_difference(other, ours);
    };
    const auto with_option = [&](std::int32_t BuildOptions::*number, std::int32_t value) {
      PluginBuild other = ours;
      other.options.*number = value;
      return find_difference(other, ours);
    };
    CHECK(with_option(&BuildOptions::packed_structs, 1) == "with -fpack-struct");
    CHECK(with_option(&BuildOptions::x87_math, 1) == "with -mfpmath=387, so that it computes otherwise");
    CHECK(with_option(&BuildOptions::address_sanitizer, 1 - ours.options.address_sanitizer) ==
          (ours.options.address_sanitizer != 0 ? "without the address sanitizer" : "with the address sanitizer"));
    CHECK(with_option(&BuildOptions::thread_sanitizer, 1 - ours.options.thread_sanitizer) ==
          (ours.options.thread_sanitizer != 0 ? "without the thread sanitizer" : "with the thread sanitizer"));
    CHECK(with_option(&BuildOptions::long_double, 8) == "with options that give a long double 8 bytes instead of 16");
    CHECK(with_option(&BuildOptions::wide_char, 2) == "with options that give a wchar_t 2 bytes instead of 4");
    CHECK(with(&PluginBuild::eigen_alignment, 64) ==
          "with options that give the alignment of Eigen's vectors (-march, or EIGEN_MAX_ALIGN_BYTES) 64 bytes "
          "instead of " +
              std::to_string(ours.eigen_alignment));
    for (const auto number : {&PluginBuild::task_class, &PluginBuild::type, &PluginBuild::sequence,
                              &PluginBuild::string, &PluginBuild::registry})
      CHECK(with(number, 1).rfind("with options that give ", 0) == 0);
    PluginBuild other = ours;
    other.compiler[0] = 'x';
    CHECK(find_difference(other, ours) ==
          "by " + std::string(other.compiler) + ", this program by " + std::string(ours.compiler));
  }

#if defined(__x86_64__)
  TEST_CASE("a library for a processor with FMA is refused without -ffp-contract=off") {
    // a processor without FMA refuses it, too, by another word
    if (!__builtin_cpu_supports("fma")) return;
    CHECK(report_on("fused") ==
          "was built without -ffp-contract=off for a processor with FMA, so that it computes otherwise" + again);
    CHECK(report_on("not_fused") == "");
    // -march and the like make Eigen's vectors larger, too
    CHECK(report_on("wide_vectors").find("the alignment of Eigen's vectors (-march, or EIGEN_MAX_ALIGN_BYTES)") !=
          std::string::npos);
  }
#endif

  TEST_CASE("what a library does when it is loaded harms nobody, and is why it is refused") {
    CHECK(report_on("at_load_0") == "");
    CHECK(report_on("at_load_1") == "throws when it is loaded: no licence");
    CHECK(report_on("at_load_2") == "does not end to load within 5 s; look at its static objects");
    CHECK(report_on("at_load_3").rfind("ends the process when it is loaded", 0) == 0);
    CHECK(report_on("at_load_4") == "ends the process when it is loaded, with exit code 0");
    CHECK(report_on("at_load_6") == "starts a process when it is loaded");
#if defined(__x86_64__)
    CHECK(report_on("at_load_5") ==
          "leaves another floating-point environment behind when it is loaded (flush-to-zero, denormals-are-zero), as "
          "what is linked with -ffast-math does; link it without");
    CHECK(report_on("linked_fast_math") == report_on("at_load_5"));
#endif
  }

  TEST_CASE("destructors of a plugin's static objects don't run: they change no exit code, hang or crash nothing") {
    const command::TemporaryFolder folder;
    for (const int number : {7, 8, 9}) {
      const int exit_code = number == 7 ? 3 : 0;
      const std::string so = std::filesystem::absolute(library("at_load_" + std::to_string(number))).string();
      const std::string graph = folder.write(
          "g.yaml", "graph: g\nplugins: [" + so + "]\ntasks: {a: {type: Nothing, period: 10ms, wcet: 1ms}}\n");
      for (const std::string command : {"run --for 100ms ", "check "}) {
        CAPTURE(command);
        CAPTURE(number);
        const auto ended =
            command::run_jarol(command + graph, "2>/dev/null", std::string("timeout 20 ") + JAROL_COMMAND);
        CHECK(ended.exit_code == (command == "check " ? 0 : exit_code));
        CHECK(ended.output.find(command == "check " ? "SCHEDULABLE" : "activations") != std::string::npos);
      }
    }
  }

  TEST_CASE("a library that does not end to load does not outlive a program that is ended meanwhile") {
    const command::TemporaryFolder folder;
    const std::string so = std::filesystem::absolute(library("at_load_2")).string();
    const std::string graph = folder.write(
        "g.yaml", "graph: g\nplugins: [" + so + "]\ntasks: {a: {type: Nothing, period: 10ms, wcet: 1ms}}\n");
    const auto alive = [&] { return command::run_jarol("", "", "pgrep -c -f '[j]arol run " + graph + "'").output; };
    tests::Process run("run " + graph);
    REQUIRE(run.says("note: loads plugin"));
    for (int i = 0; i < 100 && alive() != "2\n"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(alive() == "2\n");  // it tries the library in a process of its own
    run.signal(SIGTERM);
    CHECK(run.end() == -SIGTERM);
    for (int i = 0; i < 100 && alive() != "0\n"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(alive() == "0\n");
  }

  TEST_CASE("a plugin is named before it is loaded, once, and --no-plugins refuses it on every command") {
    const command::TemporaryFolder folder;
    const std::string so = std::filesystem::absolute(library("twice")).string();
    const std::string graph = folder.write("g.yaml", "graph: g\nplugins: [" + so + R"(]
tasks: {a: {type: Counter, period: 10ms, wcet: 2ms}, b: {type: Twice, period: 10ms, wcet: 2ms}}
connections: [a.out -> b.in]
)");
    const std::string note = "note: loads plugin '" + so + "'\n", log = folder / "log";
    for (const std::string command :
         {"run --for 100ms ", "check ", "check --measure --for 1s ", "graph ", "graph --json "}) {
      CAPTURE(command);
      const auto loaded = command::run_jarol(command + graph, "2>&1 >/dev/null");
      CHECK(loaded.exit_code == 0);
      CHECK(loaded.output.starts_with(note));
      CHECK(loaded.output.find(note, 1) == std::string::npos);
      const auto refused = command::run_jarol(command + graph + " --no-plugins", "2>&1 >/dev/null");
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.starts_with(graph + ":2:11: error: plugin '" + so +
                                       "' is not loaded: --no-plugins refuses it; leave that out, or the plugin\n"));
      CHECK(refused.output.find(note) == std::string::npos);
    }
    REQUIRE(command::run_jarol("run --for 100ms " + graph + " --log " + log).exit_code == 0);
    const auto replay = command::run_jarol("replay " + log + " " + graph, "2>&1 >/dev/null");
    CHECK(replay.exit_code == 0);
    CHECK(replay.output == note);
    CHECK(command::run_jarol("replay --no-plugins " + log + " " + graph).exit_code == 2);
    CHECK(command::run_jarol("run --no-plugins specs/counting.yaml --for 100ms").exit_code == 0);
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
    const auto run = command::run_jarol("run --for 100ms " + graph + set + " --log " + log, "2>&1 >/dev/null");
    CHECK(run.exit_code == 0);
    CHECK(run.output ==
          note + "note: the recording does not name the plugins of --set; give them again to jarol replay\n");
    CHECK(command::run_jarol("replay " + log + set, "2>&1 >/dev/null").output == note);
    CHECK(command::run_jarol("replay " + log + " " + graph + set).exit_code == 0);
    CHECK(command::run_jarol("replay " + log).exit_code == 2);

    // a graph that was recorded with the plugin that it names
    const std::string naming = folder.write("naming.yaml", content(graph) + "plugins: [" + so + "]\n");
    REQUIRE(command::run_jarol("run --for 100ms " + naming + " --log " + log).exit_code == 0);
    const auto named = command::run_jarol("replay " + log, "2>&1 >/dev/null");
    CHECK(named.exit_code == 2);
    CHECK(named.output.find(naming + ":4:11: error: plugin '" + so +
                            "' is not loaded: the recording names this graph, and a recording names no code; name it "
                            "yourself: jarol replay LOG FILE\n") != std::string::npos);
    CHECK(named.output.find(note) == std::string::npos);
    CHECK(command::run_jarol("replay " + log + " " + naming).exit_code == 0);

    // whoever writes a log with plugins of its own, and mends its sums
    for (const std::string path : {"plugins", "plugins.x"}) {
      const std::string made = folder / "made";
      const Loaded loaded = tools::load_graph("specs/counting.yaml", {});
      RecordingWriter writer(made,
                             {.graph = "counting",
                              .file = graph,
                              .overrides = {"", {"tasks.a.init.out=1", path + "=[" + so + "]"}},
                              .clock = "virtual"},
                             {}, *loaded.graph);
      writer.open();
      writer.close({});
      for (const std::string& words : {made, made + " " + graph}) {
        const auto refused = command::run_jarol("replay " + words, "2>&1 >/dev/null");
        CHECK(refused.exit_code == 2);
        CHECK(refused.output == "error: '" + made + "' sets '" + path + "=[" + so +
                                    "]', and a recording names no code to load; it is none that jarol run has "
                                    "written\n");
      }
    }
  }
}
