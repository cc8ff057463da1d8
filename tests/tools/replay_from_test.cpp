// Replays that begin on the way: at a checkpoint that the recording holds, or where the recording of a resumed run
// does.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::has;
using command::json_report;
using command::TemporaryFolder;

// Deep values, LETs under way, and a state that grows.
std::string graph_in(const TemporaryFolder& folder) {
  return folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 100ms, let: 70ms}
  sum: {type: Accumulate, period: 50ms}
  window: {type: Window, period: 100ms, parameters: {length: 7}}
  mean: {type: Mean, period: 100ms}
connections: [count.out -> sum.in, sum.out -> window.in, window.out -> mean.in]
)");
}
}  // namespace

TEST_SUITE("tools/replay_from") {
  TEST_CASE("a replay begins at the newest checkpoint before, and is the same from there on") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = graph_in(folder);
    const auto run = json_report("run " + graph + " --for 20s --record " + file + " --record-checkpoints 5s");
    CHECK(json_report("log info " + file)["topics"].dump().find(R"({"messages":3,"name":"jarol/checkpoints")") !=
          std::string::npos);
    const auto whole = json_report("replay " + file);
    CHECK(whole["verdict"] == "same");
    CHECK(whole["compared_values"] == 1000);
    CHECK(whole["digest"] == run["digest"]);
    for (const auto& [asked, begin, values] :
         {std::tuple("0s", 0, 1000), {"4.9s", 0, 1000}, {"5s", 5, 750}, {"14s", 10, 500}, {"19.9s", 15, 250}}) {
      const std::string from = asked;
      CAPTURE(from);
      const auto replay = json_report("replay " + file + " --from " + from);
      CHECK(replay["verdict"] == "same");
      CHECK(replay["digest"] == run["digest"]);
      CHECK(replay["activations"] == run["activations"]);
      CHECK(replay["compared_values"] == values);
      CHECK(replay.value("begun_ns", std::int64_t{0}) == std::int64_t{begin} * 1'000'000'000);
    }
    CHECK(command::run_jarol("replay " + file + " --from 12s")
              .output.starts_with("g: replay of 20 s, from 10 s on, in "));
    // what is otherwise from there on is shown from there on
    const auto other = command::run_jarol("replay " + file + " --from 12s --set tasks.window.parameters.length=9");
    CAPTURE(other.output);
    CHECK(other.exit_code == 1);
    CHECK(has(other.output, "  first       mean.out at 10 s: was "));
    CHECK(command::run_jarol("log verify " + file).exit_code == 0);
    CHECK(!has(command::run_jarol("log cat " + file).output, "jarol/checkpoints"));
  }

  TEST_CASE("a run that goes on from what was saved is recorded and replayed from there") {
    const TemporaryFolder folder;
    const std::string saved = folder / "saved", file = folder / "r.mcap", graph = graph_in(folder);
    const auto run = json_report("run " + graph + " --for 20s --save 8.03s=" + saved);
    for (const std::string option : {"--record ", "--log "}) {
      CAPTURE(option);
      const auto resumed = json_report("run " + graph + " --for 20s --resume " + saved + " " + option + file);
      CHECK(resumed["digest"] == run["digest"]);
      const auto replay = command::run_jarol("replay " + file);
      CAPTURE(replay.output);
      CHECK(replay.exit_code == 0);
      CHECK(replay.output.starts_with("g: replay of 20 s, from 8.03 s on, in "));
      CHECK(json_report("replay " + file)["digest"] == run["digest"]);
    }
    const std::string trace = command::run_jarol("log trace " + file).output;
    CHECK(has(trace, "\"count 81\""));
    CHECK(!has(trace, "\"count 80\""));
    CHECK(command::run_jarol("replay " + file + " --from 8s").output ==
          "error: --from: the recording begins at 8.03 s\n");
    CHECK(command::run_jarol("log report " + file + " --out " + (folder / "page.html")).output ==
          "error: '" + file + "' is of a run that went on from 8.03 s; jarol log report shows whole runs\n");
    CHECK(command::run_jarol("replay " + file + " --only sum").output ==
          "error: --only begins at the start of a run; leave out --from, or replay a recording of that\n");
  }

  TEST_CASE("between two instants a run is saved once, however often that is asked for") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap";
    REQUIRE(command::run_jarol("run " + graph_in(folder) + " --for 2s --record " + file + " --record-checkpoints 1ms")
                .exit_code == 0);
    const auto info = json_report("log info " + file);
    std::size_t saved = 0;
    for (const auto& topic : info["topics"])
      if (topic["name"] == "jarol/checkpoints") saved = topic["messages"];
    CHECK(saved == json_report("replay " + file)["instants"]);
    CHECK(json_report("replay " + file + " --from 1s")["verdict"] == "same");
  }

  TEST_CASE("what can't begin there says why") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = graph_in(folder), run = "run " + graph + " --for 5s ";
    REQUIRE(command::run_jarol(run + "--record " + file).exit_code == 0);
    const auto error = [](const std::string& words) { return command::run_jarol(words).output; };
    CHECK(error("replay " + file + " --from 3s") ==
          "error: --from: the recording holds no checkpoints; record it with --record-checkpoints 10s, or replay it as "
          "a whole\n");
    CHECK(error("replay " + file + " --from 5s") == "error: --from: the recording ends at 5 s\n");
    CHECK(error("replay " + file + " --from 3") ==
          "error: --from: '3' has no unit; write one of h, min, s, ms, us or ns, as in 10ms\n");
    CHECK(error(run + "--record-checkpoints 1s") ==
          "error: --record-checkpoints is about --record and --log; add one of them, or leave it out\n");
    CHECK(error(run + "--record " + file + " --record-checkpoints 0s") ==
          "error: --record-checkpoints: '0s' is not above zero\n");
    CHECK(error(run + "--record " + file + " --record-checkpoints 999us") ==
          "error: --record-checkpoints: '999us' is below 1ms\n");
    CHECK(error(run + "--clock real --record " + file + " --record-checkpoints 1s") ==
          "error: --record-checkpoints belongs to the virtual clock\n");
    REQUIRE(command::run_jarol(run + "--record-checkpoints 1s --record " + file).exit_code == 0);
    CHECK(
        error("replay " + file + " --from 3s --set tasks.sum.period=100ms") ==
        "error: the checkpoint at 3 s of '" + file +
            "' is of a run without 'tasks.sum.period=100ms'; parameters of tasks may change here, and nothing else\n");
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("a dive with noise in every sensor is replayed from its middle, and its vehicle is not needed") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap";
    const auto run =
        json_report("run specs/exolauv.yaml --profile at_sea --for 20s --set expect=nothing --seed 3 --record " + file +
                    " --record-checkpoints 6s");
    const auto replay = json_report("replay " + file + " --from 13s");
    CHECK(replay["verdict"] == "same");
    CHECK(replay["digest"] == run["digest"]);
    CHECK(replay["begun_ns"] == 12'000'000'000);
    const auto judged = command::run_jarol("replay " + file + " --from 13s --set 'expect=[depth.moment.angle < 1]'");
    CHECK(has(judged.output, "is of a run without 'expect=[depth.moment.angle < 1]'"));
  }

  TEST_CASE("a replay from a checkpoint shows what was reported before it as what it was, at its instants") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", link = " --set distributers.robostix.link.parameters.";
    const auto run = json_report("run specs/javiator.yaml --set expect=nothing" + link + "dynamics=rigid --set '" +
                                 link.substr(7) + "failures.laser_north={kind: lost, at: 8 s}' --for 20s --record " +
                                 file + " --record-checkpoints 4s");
    REQUIRE(run["events"].size() >= 2);
    CHECK(run["events"][0]["instant_ns"] < 16'000'000'000);
    CHECK(json_report("replay " + file + " --from 17s")["events"] == run["events"]);
  }
#endif
}
