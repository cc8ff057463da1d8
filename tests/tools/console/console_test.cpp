// A run that is watched: described by its types, shown with all its values, and the same as without anybody.
#include "tools/console/console.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "distributers/messages/javiator.h"
#include "tests/tools/console/client.h"
#include "tests/tools/console/digest_in.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using command::TemporaryFolder;
using nlohmann::json;
using tests::digest_in;
using tests::PageSocket;
using tools::console::Console;
using tools::console::Watched;

constexpr const char* counting = R"(
graph: counting
timing: {period: 10ms}
communicators: {seen: {type: double, direction: out, offset: 5ms}}
tasks: {count: {type: Counter, wcet: 10us}}
connections: [count.out -> seen]
)";

Loaded load(const std::string& text) {
  return tools::load_graph(std::make_shared<Source>(Source{"counting.yaml", text}), {});
}

std::vector<const Type*> no_truth(const Graph& graph) {
  return std::vector<const Type*>(graph.distributers.size(), nullptr);
}
}  // namespace

TEST_SUITE("console/console") {
  TEST_CASE("the first message describes the run from its types") {
    const Loaded loaded = load(counting);
    const auto truth = no_truth(*loaded.graph);
    Console console(Watched{.run = {.graph = *loaded.graph,
                                    .file = "counting.yaml",
                                    .clock = "virtual",
                                    .until = 2s,
                                    .true_types = truth,
                                    .given = tools::console::Given{"g.yaml", {.profile = "p", .set = {"a=1"}}, 7}},
                            .server = {},
                            .pace = nullptr});
    console.open();
    const json hello = PageSocket(console.url()).read()->at("hello");
    CHECK(hello["schema"] == "jarol.console/1");
    CHECK(hello["graph"] == "counting");
    CHECK(hello["clock"] == "virtual");
    CHECK(hello["until"] == 2.0);
    CHECK(hello["paced"] == false);
    CHECK(hello["given"] == json::parse(R"({"file": "g.yaml", "profile": "p", "set": ["a=1"], "seed": 7})"));
    REQUIRE(hello["outputs"].size() == 2);
    CHECK(hello["outputs"][0]["name"] == "count.out");
    CHECK(hello["outputs"][0]["kind"] == "task");
    CHECK(hello["outputs"][0]["of"] == "count");
    CHECK(hello["outputs"][0]["leaves"] == json::parse(R"([{"path": "", "unit": "", "kind": "number"}])"));
    CHECK(hello["outputs"][1]["name"] == "seen");
    CHECK(hello["outputs"][1]["kind"] == "communicator");
    CHECK(hello["tasks"] == json::parse(R"([{"name": "count", "type": "Counter", "period": 0.01, "offset": 0.0,
        "deadline": 0.005, "wcet": 1e-05, "slack": 0.00499, "core": 0, "parameters": []}])"));
    CHECK(hello["communicators"][0]["offset"] == 0.005);
    CHECK(hello["connections"] == json::parse(R"([{"from": "count.out", "to": "seen", "type": "double"}])"));
    CHECK(hello["drawing"]["nodes"].size() == 2);
    CHECK(hello["drawing"]["arrows"].size() == 1);
  }

  TEST_CASE("leaves have units, texts, words and what these mean") {
    const Loaded loaded = tools::load_without_systems("specs/exolauv.yaml", {});
    const auto truth = no_truth(*loaded.graph);
    const json described =
        tools::console::describe_run({*loaded.graph, "specs/exolauv.yaml", "virtual", Duration::max(), truth});
    CHECK_FALSE(described.contains("until"));
    const auto output = [&](const std::string& name) {
      for (const json& each : described["outputs"])
        if (each.is_object() && each["name"] == name) return each;
      return json();
    };
    CHECK(output("navigation.motion")["leaves"][2] ==
          json::parse(R"({"path": "z", "unit": "m", "kind": "number", "text": "below the surface"})"));
    const json alarm = output("supervisor.condition")["leaves"][0];
    CHECK(alarm["kind"] == "enum");
    CHECK(alarm["words"][0] == json::parse(R"({"number": 0, "name": "none"})"));
    CHECK(alarm["words"][1]["meaning"] == "it comes up, as the operator is silent");
    CHECK(output("fins.actuation")["leaves"][1]["path"] == "fins.0");
    const json& neptus = described["distributers"][1];
    CHECK(neptus["type"] == "LauvOperator");
    CHECK(neptus["parameters"][1] == json::parse(R"({"path": "latitude", "kind": "number", "unit": "rad",
        "value": "0.7188138524338646", "default": "0.7188138524338646",
        "text": "of the origin, WGS-84, until the vehicle reports where it has its own"})"));
    const json& depth = *std::find_if(described["tasks"].begin(), described["tasks"].end(),
                                      [](const json& task) { return task["name"] == "depth"; });
    CHECK(depth["parameters"][0] == json::parse(R"({"path": "kp", "kind": "number", "unit": "rad/m", "value": "0.45",
        "default": "0.45", "text": "pitch per depth error", "min": 0.0, "max": 10.0})"));
    CHECK(described["pairs"][0] ==
          json::parse(R"({"title": "depth", "commanded": "from_neptus.depth", "reached": "to_neptus.depth"})"));
  }

  TEST_CASE("pages are shown every value, its instant, and how the run has ended") {
    Loaded loaded = load(counting);
    const auto truth = no_truth(*loaded.graph);
    Console console(
        Watched{.run = {*loaded.graph, "counting.yaml", "virtual", 50ms, truth}, .server = {}, .pace = nullptr});
    console.open();
    GraphRun run(std::move(loaded), {.sinks = {&console.feed()}, .truth = true, .watched = true});
    run.executor().run_until(50ms);
    run.sinks().close();
    console.end("good");
    PageSocket page(console.url());
    std::map<int, std::vector<std::pair<double, double>>> shown;
    for (auto message = page.read(); !message->contains("ended"); message = page.read())
      for (const json& sample : message->value("samples", json::array()))
        shown[sample[0]].push_back({sample[1], sample[2]});
    CHECK(shown[0] == std::vector<std::pair<double, double>>{{0, 0}, {0.01, 1}, {0.02, 2}, {0.03, 3}, {0.04, 4}});
    CHECK(shown[1] ==
          std::vector<std::pair<double, double>>{{0.005, 0}, {0.015, 1}, {0.025, 2}, {0.035, 3}, {0.045, 4}});
    CHECK(PageSocket(console.url()).read_with("ended")["ended"] == "good");
  }

  TEST_CASE("a run that has no pace says so to who would pause it") {
    const Loaded loaded = load(counting);
    const auto truth = no_truth(*loaded.graph);
    Console console(Watched{.run = {*loaded.graph, "counting.yaml", "real", 1s, truth}, .server = {}, .pace = nullptr});
    console.open();
    PageSocket page(console.url());
    page.send(R"({"do": "pause"})");
    CHECK(page.read_with("error")["error"] ==
          "this run goes on by itself; only one on the virtual clock can be paced and paused");
  }

  TEST_CASE("pace and state are shown, and change for all") {
    const Loaded loaded = load(counting);
    const auto truth = no_truth(*loaded.graph);
    jarol::Pace pace(2.0);
    Console console(
        Watched{.run = {*loaded.graph, "counting.yaml", "virtual", 1s, truth}, .server = {}, .pace = &pace});
    console.open();
    PageSocket one(console.url()), two(console.url());
    CHECK(one.read()->at("hello")["paced"] == true);
    CHECK(one.read_with("speed") == json::parse(R"({"now": 0.0, "paused": false, "speed": 2.0, "samples": []})"));
    two.send(R"({"do": "pause"})");
    CHECK(one.read_with("paused")["paused"] == true);
    CHECK(pace.state().paused);
  }

  TEST_CASE("where a page commands, it alone changes the pace, pauses and steps") {
    const Loaded loaded = load(counting);
    const auto truth = no_truth(*loaded.graph);
    jarol::Pace pace(2.0);
    const auto port = std::make_shared<distributers::ConsolePort>(messages::javiator::message_set());
    Console console(Watched{.run = {*loaded.graph, "counting.yaml", "virtual", 1s, truth},
                            .server = {},
                            .pace = &pace,
                            .operators = {{"terminal", "JaviatorOperator", port}}});
    console.open();
    PageSocket pilot(console.url()), other(console.url());
    // nobody commands yet
    other.send(R"({"do": "speed", "speed": 1})");
    CHECK(other.read_with("speed")["speed"] == 2.0);
    CHECK(other.read_with("speed")["speed"] == 1.0);
    pilot.send(R"({"do": "take", "desk": "terminal", "as": "me", "sticks": {"roll": 0}})");
    while (pilot.read_with("desk")["desk"]["terminal"]["commander"] != "me") {}
    for (const std::string what : {R"("speed", "speed": "max")", R"("pause")", R"("go_on")", R"("step")"}) {
      pilot.send(R"({"do": "alive", "desk": "terminal"})");
      other.send(R"({"do": )" + what + "}");
      CHECK(other.read_with("error")["error"] ==
            "another page commands 'terminal'; only a page that commands alone changes the pace, pauses and steps");
    }
    CHECK(pace.state() == jarol::Pace::State{1.0, false});
    pilot.send(R"({"do": "pause"})");
    while (!pilot.read_with("paused")["paused"]) {}
    pilot.send(R"({"do": "release", "desk": "terminal"})");
    while (!other.read_with("desk")["desk"]["terminal"]["commander"].is_null()) {}
    other.send(R"({"do": "go_on"})");
    while (other.read_with("paused")["paused"]) {}
    CHECK(pace.state() == jarol::Pace::State{1.0, false});
  }

  TEST_CASE("run: watched or not, at any pace, a run is the same") {
    const std::string run = "run specs/counting.yaml --for 2s";
    const std::string digest = digest_in(command::run_jarol(run).output);
    CHECK(digest.starts_with("0x"));
    for (const std::string options : {" --console --pace max", " --pace 100", " --console --pace 50"}) {
      const auto watched = command::run_jarol(run + options);
      CHECK(watched.exit_code == 0);
      CHECK(digest_in(watched.output) == digest);
      CHECK((watched.output.find("console: http://127.0.0.1:") != std::string::npos) ==
            (options.find("--console") != std::string::npos));
    }
  }

  TEST_CASE("run: where the page is served on all addresses, it is said what others open") {
    const std::string said = command::run_jarol(
                                 "run specs/counting.yaml --for 10ms --console --pace max "
                                 "--console-listen 0.0.0.0")
                                 .output;
    CHECK(said.find("http://0.0.0.0") == std::string::npos);
    CHECK(said.find("\n  where that name is not known, put an address of this machine in its place\n") !=
          std::string::npos);
  }

  TEST_CASE("run: what is recorded of a watched run is what is recorded of any") {
    const TemporaryFolder folder;
    const std::string run = "run specs/counting.yaml --for 1s --trace ";
    CHECK(command::run_jarol(run + (folder / "plain")).exit_code == 0);
    CHECK(command::run_jarol(run + (folder / "watched") + " --console --pace max").exit_code == 0);
    std::ifstream plain(folder / "plain"), watched(folder / "watched");
    CHECK(std::string(std::istreambuf_iterator<char>(plain), {}) ==
          std::string(std::istreambuf_iterator<char>(watched), {}));
  }

  TEST_CASE("run: options of the console that make no sense are refused") {
    const auto refused = [](const std::string& options) {
      const auto result = command::run_jarol("run specs/counting.yaml --for 1s " + options, "2>&1 >/dev/null");
      CHECK(result.exit_code == 2);
      return result.output;
    };
    CHECK(refused("--console=0") == "error: the console's port '0' is no number from 1 to 65535\n");
    CHECK(refused("--console=70000") == "error: the console's port '70000' is no number from 1 to 65535\n");
    CHECK(refused("--console=x") == "error: the console's port 'x' is no number from 1 to 65535\n");
    CHECK(refused("--console-listen 0.0.0.0") ==
          "error: --console-listen belongs to --console; add that, or leave it out\n");
    CHECK(refused("--console --console-listen here") ==
          "error: the console can't listen on 'here', which is no address; write it as in 127.0.0.1 or 0.0.0.0\n");
    CHECK(refused("--pace 0") ==
          "error: --pace: '0' is no number from 0.001 to 1000, nor max; write it as in 1, 0.1 or 10\n");
    CHECK(refused("--clock real --pace 1") == "error: --pace belongs to the virtual clock; the real one has its own\n");
    CHECK(refused("--console --json=1") ==
          "error: --json takes no value, and has '1'; write --json alone, or leave it out\n");
  }
}
