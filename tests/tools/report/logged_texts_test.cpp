// What tasks log: outputs of type String, shown as events.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/graph/graph_of.h"
#include "tests/tools/run_command.h"
#include "tools/report/noted_report.h"

namespace {
std::string graph_in(const command::TemporaryFolder& folder) {
  return folder.write("g.yaml", "graph: g\nplugins: [" +
                                    std::filesystem::absolute(std::string(JAROL_PLUGIN_FOLDER) + "/names.so").string() +
                                    "]\ntiming: {period: 10ms}\ntasks: {t: {type: Talks, wcet: 1us}}\n");
}
std::string lines_with(const std::string& word, const std::string& text) {
  std::istringstream in(text);
  std::string found;
  for (std::string line; std::getline(in, line);)
    if (line.find(word) != std::string::npos) found += line + "\n";
  return found;
}

struct Speaks {
  static constexpr std::string_view summary = "says something";
  struct Out {
    jarol::String said{};
    static constexpr auto fields() { return jarol::describe(jarol::field<&Out::said>()); }
  };
  static void run(const jarol::Tick&, Out&) {}
};
}  // namespace

TEST_SUITE("tools/report/logged_texts") {
  TEST_CASE("a text that a task publishes is an event: when it is another one than before, and not empty") {
    const command::TemporaryFolder folder;
    const std::string graph = graph_in(folder);
    const auto done = command::run_jarol("run " + graph + " --for 90ms", "2>&1");
    CHECK(lines_with("logged", done.output) ==
          "  logged      t.log at 0.02 s: two\\x1b[31m\n"
          "  logged      t.log at 0.06 s: two\\x1b[31m\n"
          "  logged      t.log at 0.08 s: even\n");
    const std::string printed = command::run_jarol("run " + graph + " --for 90ms --json", "2>/dev/null").output;
    const auto json = nlohmann::json::parse(printed);
    REQUIRE(json["logged"].size() == 3);
    // escaped once, as JSON does it
    CHECK(printed.find("\"text\":\"two\\u001b[31m\"") != std::string::npos);
    CHECK(json["logged"][0]["text"] == "two\x1b[31m");
    CHECK(json["logged"][2] == nlohmann::json{{"output", "t.log"}, {"instant_ns", 80'000'000}, {"text", "even"}});
  }

  TEST_CASE("of an output that never stops talking the first hundred texts are shown, and how many there were more") {
    const command::TemporaryFolder folder;
    const auto done = command::run_jarol("run " + graph_in(folder) + " --for 2s", "2>&1");
    const std::string logged = lines_with("logged", done.output);
    CHECK(std::count(logged.begin(), logged.end(), '\n') == 101);
    CHECK(logged.ends_with("\n  logged      t.log: and 94 texts more\n"));
  }

  TEST_CASE("texts of one instant are shown in the order of their outputs, whatever task came first") {
    jarol::Registry registry;
    registry.add(jarol::task_class<Speaks>());
    const jarol::Graph graph = jarol::tests::graph_of(
        registry, "graph: t\ntasks: {a: {type: Speaks, period: 1ms}, b: {type: Speaks, period: 1ms}}\n");
    jarol::LoggedTexts texts(graph);
    const auto say = [&](int instant, std::uint32_t output, const char* text) {
      const jarol::String said{std::string_view(text)};
      texts.take(std::chrono::milliseconds(instant), output, &said);
    };
    say(1, 1, "one");
    say(1, 0, "two");
    say(2, 0, "three");
    say(2, 1, "four");
    CHECK(jarol::tools::to_text(texts.kept()) ==
          "  logged      a.said at 0.001 s: two\n"
          "  logged      b.said at 0.001 s: one\n"
          "  logged      a.said at 0.002 s: three\n"
          "  logged      b.said at 0.002 s: four\n");
  }

  TEST_CASE("a replay and a run on threads show what tasks log, too") {
    const command::TemporaryFolder folder;
    const std::string graph = graph_in(folder), log = folder / "run.log";
    const auto run = command::run_jarol("run " + graph + " --for 90ms --log " + log, "2>&1");
    const auto replay = command::run_jarol("replay " + log + " " + graph, "2>&1");
    CHECK(lines_with("logged", replay.output) == lines_with("logged", run.output));
    CHECK(lines_with("logged", run.output) != "");
    const auto threads =
        command::run_jarol("run " + graph + " --for 200ms --clock real --concurrency threads --json", "2>/dev/null");
    CHECK(nlohmann::json::parse(threads.output)["logged"].size() >= 1);
  }
}
