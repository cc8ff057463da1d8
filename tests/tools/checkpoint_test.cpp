// A mission that is saved at any instant and goes on elsewhere ends as the one in one piece, to the bit.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "graph/values/seed.h"
#include "tests/how_many.h"
#include "tests/runtime/random_model.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"
#include "tools/library/session.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using command::error_of;
using command::report_of;

struct Mission {
  std::string spec;
  SessionOptions options;
  Duration length;
};

using command::content;
using command::TemporaryFolder;
using nlohmann::json;
namespace fs = std::filesystem;

// At any nanosecond of the mission.
Duration random_instant(Duration length, std::uint64_t seed) {
  return Duration(static_cast<std::int64_t>(spread_seed(seed, "instant") % static_cast<std::uint64_t>(length.count())));
}

std::vector<Mission> missions() {
  std::vector<Mission> all{{"specs/counting.yaml", {}, 5s}, {"specs/window.yaml", {}, 5s}};
#ifdef JAROL_VEHICLES
  const auto whole = [](const std::string& spec, Duration shortened) {
    return tests::is_full() ? open(spec).end_of_mission() : shortened;
  };
  const Duration dive = whole("specs/exolauv.yaml", 12s), hover = whole("specs/javiator.yaml", 14s);
  const std::vector<Mission> flown{
      {"specs/exolauv.yaml", {}, dive},
      {"specs/exolauv.yaml", {.profile = "at_sea", .seed = 3}, dive},
      {"specs/exolauv.yaml", {.profile = "submarine_dune"}, dive},
      {"specs/exolauv.yaml", {.profile = "submarine_vsim"}, dive},
      {"specs/exolauv.yaml",
       {.profile = "at_sea",
        .set = {"distributers.dune.link.parameters={dynamics: rigid, sensors: {compass: {drift: 0.1}}}"}},
       dive},
      {"specs/exolauv_bare.yaml", {}, dive},
      {"specs/passthrough.yaml", {}, 5s},
      {"specs/javiator.yaml", {}, hover},
      {"specs/javiator.yaml", {.profile = "original", .seed = 5}, hover},
      {"specs/javiator.yaml", {.profile = "wind", .seed = 6}, hover},
      {"specs/javiator.yaml",
       {.profile = "wind", .set = {"distributers.robostix.link.parameters.dynamics=rigid"}, .seed = 6},
       hover}};
  all.insert(all.end(), flown.begin(), flown.end());
#endif
  return all;
}

// What a run reports but for what it takes in real time.
json lasting(json report) {
  for (const char* key : {"wall_ns", "real_time_factor", "resumed_ns", "saved"}) report.erase(key);
  return report;
}

const std::string counting = "specs/counting.yaml --for 3s ";

}  // namespace

TEST_SUITE("tools/checkpoint") {
  TEST_CASE("a mission that goes on from a checkpoint in another session ends as in one piece") {
    for (const Mission& mission : missions()) {
      CAPTURE(mission.spec);
      CAPTURE(mission.options.profile);
      Session whole = open(mission.spec, mission.options);
      whole.run_until(mission.length);
      for (std::uint64_t i = 0; i < (tests::is_full() ? 5U : 2U); ++i) {
        const Duration at = random_instant(mission.length, i + mission.options.seed);
        CAPTURE(at.count());
        Session first = open(mission.spec, mission.options);
        first.run_until(at);
        const Checkpoint saved = first.checkpoint();
        // in a session that has run another way before
        SessionOptions options = mission.options;
        options.workers = std::size_t{1} << i % 3;
        Session second = open(mission.spec, options);
        second.run_until(random_instant(mission.length, i + 100));
        second.restore(saved);
        CHECK(second.now() == at);
        CHECK(second.checkpoint().to_bytes() == saved.to_bytes());
        second.run_until(mission.length);
        CHECK(second.report().digest == whole.report().digest);
        CHECK(second.report().activations == whole.report().activations);
        CHECK(second.report().instants == whole.report().instants);
        CHECK(second.checkpoint().to_bytes() == whole.checkpoint().to_bytes());
      }
    }
  }

  TEST_CASE("a run that is saved and resumed in another process reports what the run in one piece does") {
    const TemporaryFolder folder;
    // what these conditions have reached lies before the instant that is saved
    std::vector<std::string> runs{
        "specs/counting.yaml --for 3s", "specs/window.yaml --for 3s",
        "specs/counting.yaml --set 'expect=[min(count.out) < 1, once count.out < 1 before 1s, "
        "rms(count.out) > 10, rise_time(count.out to 200) < 3s]' --for 3s"};
#ifdef JAROL_VEHICLES
    const std::string end = tests::is_full() ? "" : " --for 12s";
    runs.insert(runs.end(), {"specs/exolauv.yaml" + end, "specs/exolauv.yaml --profile at_sea --seed 3" + end,
                             "specs/javiator.yaml" + end, "specs/javiator.yaml --profile original" + end});
#endif
    for (const std::string& run : runs) {
      CAPTURE(run);
      const json whole = report_of(run);
      const std::string file = run.substr(0, run.find(' ')), early = folder / "early", late = folder / "late";
      const std::string length = run.find("--for") == std::string::npos ? "" : run.substr(run.find("--for"));
      const json saved = report_of(run + " --workers 2 --save 2500ms=" + late + " --save 1234567ns=" + early);
      CHECK(lasting(saved) == lasting(whole));
      CHECK(saved["saved"] == json::parse(R"([{"instant_ns": 1234567, "file": ")" + early +
                                          R"("}, {"instant_ns": 2500000000, "file": ")" + late + R"("}])"));
      const json resumed = report_of(file + " --resume " + early + " " + length + " --workers 4");
      CHECK(resumed["resumed_ns"] == 1234567);
      CHECK(lasting(resumed) == lasting(whole));
      CHECK(lasting(report_of(file + " --resume " + late + " " + length)) == lasting(whole));
      // once more on the way
      const std::string third = folder / "third";
      const json again = report_of(file + " --resume " + early + " " + length + " --save 2500ms=" + third);
      CHECK(lasting(again) == lasting(whole));
      const bool same_bytes = content(third) == content(late);
      CHECK(same_bytes);
    }
  }

  TEST_CASE("parameters may change where a run goes on, and nothing else") {
    const TemporaryFolder folder;
    const std::string file = folder / "c";
    const json whole = report_of(counting + "--set tasks.loop.let=40ms --save 1s=" + file);
    CHECK(report_of(counting + "--resume " + file)["digest"] == whole["digest"]);
    // what was set may be given again
    CHECK(report_of(counting + "--resume " + file + " --set tasks.loop.let=40ms")["digest"] == whole["digest"]);
    CHECK(error_of(counting + "--resume " + file + " --set tasks.loop.let=30ms") ==
          "error: '" + file +
              "' is of a run without 'tasks.loop.let=30ms'; parameters of tasks may change here, and nothing else\n");
    CHECK(error_of(counting + "--resume " + file + " --set tasks.slow.let=10ms") ==
          "error: '" + file +
              "' is of a run without 'tasks.slow.let=10ms'; parameters of tasks may change here, and nothing else\n");
    CHECK(error_of(counting + "--resume " + file + " --seed 1") ==
          "error: --seed is that of the run that was saved; leave it out\n");
    CHECK(error_of(counting + "--resume " + file + " --profile x") ==
          "error: --profile is that of the run that was saved; leave it out\n");
    CHECK(error_of("specs/counting.yaml --for 500ms --resume " + file) ==
          "error: the run ends at 0.5 s, and goes on from 1 s; say until when, as in --for 100s\n");
    // a window that grows on from there
    const std::string window = "specs/window.yaml --for 3s ", at = folder / "w";
    const json before = report_of(window + "--save 1s=" + at);
    CHECK(report_of(window + "--resume " + at + " --set tasks.window.parameters.length=30")["digest"] !=
          before["digest"]);
  }

  TEST_CASE("random graphs and missions that are saved at random instants go on in a new process to their end") {
    const TemporaryFolder folder;
    std::vector<std::pair<std::string, Duration>> runs{{"specs/counting.yaml", 3s}, {"specs/window.yaml", 3s}};
    for (std::uint64_t seed = 0; seed < (tests::is_full() ? 2000U : 8U); ++seed) {
      const std::string name = "graph" + std::to_string(seed) + ".yaml";
      folder.write(name, oracle::to_yaml(oracle::random_model(seed), seed));
      runs.emplace_back(folder / name, 60ms);
    }
    for (const Mission& mission : missions()) {
      if (!tests::is_full()) continue;
      std::string words = mission.spec;
      if (!mission.options.profile.empty()) words += " --profile " + mission.options.profile;
      for (const std::string& set : mission.options.set)
        words += " --set expect=nothing --set '" + set + "'";  // they fly otherwise
      runs.emplace_back(words, mission.length);
    }
    std::uint64_t number = 0;
    for (const auto& each : runs) {
      const std::string& run = each.first;
      const Duration length = each.second;
      CAPTURE(run);
      const std::string end = " --for " + std::to_string(length.count()) + "ns", saved = folder / "saved";
      const Duration at = random_instant(length, ++number);
      CAPTURE(at.count());
      const json whole = report_of(run + end);
      const json first = report_of(run + end + " --workers " + std::to_string(1 + number % 4) + " --save " +
                                   std::to_string(at.count()) + "ns=" + saved);
      CHECK(lasting(first) == lasting(whole));
      const std::string file = run.substr(0, run.find(' '));
      const json resumed =
          report_of(file + end + " --resume " + saved + " --workers " + std::to_string(1 + (number + 1) % 4));
      CHECK(lasting(resumed) == lasting(whole));
    }
  }

  TEST_CASE("what is no checkpoint of this graph and program is refused with the reason") {
    const TemporaryFolder folder;
    const std::string file = folder / "c";
    report_of(counting + "--save 1s=" + file);
    const std::string good = content(file);
    const auto error = [&](const std::string& bytes, const std::string& spec = counting) {
      folder.write("damaged", bytes);
      const std::string text = error_of(spec + "--resume " + (folder / "damaged"));
      const std::string begin = "error: '" + (folder / "damaged") + "' ";
      CHECK(text.substr(0, begin.size()) == begin);
      return text.substr(std::min(text.size(), begin.size()));
    };
    CHECK(error("") == "is no checkpoint of this version, jarol.checkpoint/1\n");
    CHECK(error("jarol.checkpoint/2\n" + good.substr(19)) == "is no checkpoint of this version, jarol.checkpoint/1\n");
    CHECK(error(good.substr(0, 25)) == "is damaged: it is cut off\n");
    CHECK(error(good.substr(0, good.size() - 1)) == "is damaged: it should have " + std::to_string(good.size() - 35) +
                                                        " bytes after its first 35, and has " +
                                                        std::to_string(good.size() - 36) + "\n");
    for (std::uint64_t i = 0; i < 50; ++i) {
      std::string bytes = good;
      bytes[35 + spread_seed(i, "flip") % (good.size() - 35)] ^= static_cast<char>(1U << i % 8);
      CHECK(error(bytes) == "is damaged: its bytes do not have the sum that it says\n");
    }
    CHECK(error(good, "specs/window.yaml --for 3s ") ==
          "is of another graph: the text of 'specs/window.yaml' is not the one that was run\n");
    Session mine = open("specs/counting.yaml");
    mine.run_until(1s);
    mine.checkpoint().write(file);
    CHECK(error(content(file)) == "was saved by another build of this program\n");
    CHECK(error_of(counting + "--resume " + (folder / "none")) ==
          "error: can't read '" + (folder / "none") + "': it is no file\n");
  }

  TEST_CASE("where and when a run can be saved is said before it begins") {
    const TemporaryFolder folder;
    const std::string file = folder / "c";
    CHECK(error_of(counting + "--save 1s") == "error: --save: '1s' names no file; write it as in 30s=FILE\n");
    CHECK(error_of(counting + "--save 1=" + file).find("error: --save: '1' ") == 0);
    CHECK(error_of(counting + "--save 1s=-") == "error: --save: '-' is no file; --resume reads one by its name\n");
    CHECK(error_of(counting + "--save 4s=" + file) == "error: --save: the run ends at 3 s, before 4 s\n");
    CHECK(error_of(counting + "--clock real --save 1s=" + file) == "error: --save belongs to the virtual clock\n");
    CHECK(error_of(counting + "--clock real --resume " + file) == "error: --resume belongs to the virtual clock\n");
    CHECK_FALSE(fs::exists(file));
#ifdef JAROL_VEHICLES
    CHECK(error_of("specs/exolauv.yaml --set 'distributers.dune.link={type: lockstep, peer: 127.0.0.1:9}' --save 1s=" +
                   file) ==
          "error: --save: distributer 'dune': its vehicle is in another process, which can't be saved\n");
#endif
    report_of(counting + "--save 1s=" + file);
    CHECK(error_of(counting + "--resume " + file + " --save 500ms=" + (folder / "d")) ==
          "error: --save: the run goes on from 1 s, after 0.5 s\n");
    // the run goes on where one can't be written
    const command::Result result = command::run_jarol("run " + counting + "--save 1s=/dev/full");
    CHECK(result.exit_code == 3);
    CHECK(result.output.find("  digest      0x") != std::string::npos);
    CHECK(result.output.find("error: can't write '/dev/full': No space left on device\n") != std::string::npos);
  }

  TEST_CASE("a session refuses what it can't go on from, and goes on itself") {
    Session one = open("specs/counting.yaml");
    one.run_until(1s);
    Session other = open("specs/counting.yaml", {.seed = 2});
    CHECK_THROWS_WITH_AS(other.restore(one.checkpoint()), "the checkpoint is of seed 0", CheckpointRefused);
    other.run_until(1s);
    CHECK(other.report().digest == one.report().digest);
    Session changed = open("specs/counting.yaml", {.set = {"tasks.slow.let=10ms"}});
    CHECK_THROWS_WITH_AS(changed.restore(one.checkpoint()),
                         "the checkpoint is of a run without 'tasks.slow.let=10ms'; parameters of tasks may change "
                         "here, and nothing else",
                         CheckpointRefused);
    Checkpoint first = one.checkpoint();
    const Checkpoint second = std::move(first);
    CHECK_THROWS_WITH_AS(other.restore(first), "the checkpoint has nothing in it: it was moved elsewhere",
                         CheckpointRefused);
    CHECK_THROWS_WITH_AS(first.to_bytes(), "has nothing in it: it was moved elsewhere", CheckpointError);
    // what was published last is known after that
    Session next = open("specs/counting.yaml");
    next.restore(Checkpoint::from_bytes(one.checkpoint().to_bytes()));
    CHECK(next.value<double>("count.out") == one.value<double>("count.out"));
    one.finish();
    CHECK_THROWS_WITH_AS(one.checkpoint(), "there is nothing to save, as the run is over: it was finished", RunOver);
  }
}
