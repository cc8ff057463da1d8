// Each run of a campaign is that of a graph of its own, whatever shares threads and plan with it.
#include "tests/distributers/campaign/waves.h"

#include <doctest/doctest.h>

#include <fstream>

#include "distributers/session/session.h"
#include "tests/refused_threads.h"

namespace {
using namespace jarol;
using namespace jarol::campaign;
using namespace jarol::campaign::trial;
using namespace std::chrono_literals;
}  // namespace

TEST_SUITE("distributers/campaign") {
  TEST_CASE("each run is to the bit that of a session with its values and seed") {
    const Folder folder;
    Under under(source_of(waves), {.vary = {gains.vary[0], gains.vary[1], "tasks.b.let=[3ms, 2ms]", "seed=1..5"}}, 3,
                folder / "r.sqlite");
    under.run(2);
    const std::vector<Result> all = under.all();
    REQUIRE(all.size() == 10);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Start start = under.draws.at(i);
      Session session(tests::all_parts_with<Unsteady, DepthOf>(), under.source.source,
                      {.set = start.set, .seed = start.seed});
      session.run_until(2s);
      CHECK(all[i].digest == session.report().digest);
      CHECK(all[i].index == i);
    }
    CHECK(all[0].digest != all[1].digest);
  }

  TEST_CASE("table and results are equal for any number of workers, and after runs in pieces and shards") {
    const Folder folder;
    Under one(source_of(waves), gains, 7, folder / "1");
    one.run(1);
    const std::string table = one.csv();
    CHECK(std::count(table.begin(), table.end(), '\n') == 31);
    for (const std::size_t workers : {2, 4, 13}) {
      Under more(source_of(waves), gains, 7, folder / std::to_string(workers));
      more.run(workers);
      CHECK(more.csv() == table);
      CHECK(more.all() == one.all());
    }
    for (int piece = 0; piece < 10; ++piece) {
      Under part(source_of(waves), gains, 7, folder / "pieces");
      part.stop_after = 4;
      part.run(1);
      CHECK(part.all().size() == std::min<std::size_t>(4 * (static_cast<std::size_t>(piece) + 1), 30));
      if (part.all().size() == 30) CHECK(part.csv() == table);
    }
    for (const std::uint64_t shard : {2, 0, 1}) {
      Under part(source_of(waves), gains, 7, folder / "shards");
      part.run(2, {shard, 3});
      CHECK(part.seen == 10);
      if (shard == 1) CHECK(part.csv() == table);
    }
    Under other(source_of(waves), gains, 8, folder / "other");
    other.run(1);
    CHECK(other.csv() != table);
  }

  TEST_CASE("a shard is of consecutive runs, and all together are all of them") {
    for (const std::uint64_t runs : {1, 7, 100})
      for (const std::uint64_t count : {1, 3, 8}) {
        std::uint64_t next = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
          CHECK(Shard{i, count}.of(runs).begin == next);
          next = Shard{i, count}.of(runs).end;
        }
        CHECK(next == runs);
      }
    CHECK(missing({0, 2, 3, 9}, {0, 5}) == std::vector<std::uint64_t>{1, 4});
    CHECK(missing({0, 2, 3, 5}, {4, 8}) == std::vector<std::uint64_t>{4, 6, 7});
  }

  TEST_CASE("a run that faults, is refused or breaks a limit is a result, and the others go on") {
    const Folder folder;
    Under under(source_of(waves, {"low=min(sum.out) > -1.2"}),
                {.vary = {"tasks.a.parameters.fails_at=[-1, 100]", "tasks.a.parameters.stops_being_finite_at=[-1, 50]",
                          "tasks.b.parameters.gain=[0.1, 0.5, 3]"}},
                0, folder / "r");
    under.run(2);
    std::string outcomes;
    for (const Result& result : under.all())
      outcomes += std::to_string(result.index) + " " + word_of(result.outcome) + ": " + result.why + "\n";
    CHECK(outcomes ==
          "0 good: \n"
          "1 bad: metric 'low' is beyond its limit: it reached -1.4982\n"
          "2 bad: expected 'max(sum.out) < 2.3', but it reached 3.9849\n"
          "3 fault: task 'a' activation 50 at 0.5 s: output 'out' is inf\n"
          "4 fault: task 'a' activation 50 at 0.5 s: output 'out' is inf\n"
          "5 fault: task 'a' activation 50 at 0.5 s: output 'out' is inf\n"
          "6 fault: task 'a' activation 100 at 1 s: threw: it was to fail\n"
          "7 fault: task 'a' activation 100 at 1 s: threw: it was to fail\n"
          "8 fault: task 'a' activation 100 at 1 s: threw: it was to fail\n"
          "9 fault: task 'a' activation 50 at 0.5 s: output 'out' is inf\n"
          "10 fault: task 'a' activation 50 at 0.5 s: output 'out' is inf\n"
          "11 fault: task 'a' activation 50 at 0.5 s: output 'out' is inf\n");
    const Result fault = under.all()[6];
    CHECK(!fault.metrics[0].number);
    CHECK(fault.metrics[2].number);   // an instant before the fault
    CHECK(!fault.metrics[3].number);  // of a whole run
    CHECK(fault.simulated == 1s);
    CHECK(fault.faults == 1);
  }

  TEST_CASE("conditions that were not judged are counted, and a good run says why") {
    const Folder folder;
    std::ofstream(folder / "dive.csv") << "expect: final(depth.depth) < 2\n" << dive_to(3);
    const GraphSource source = diving(folder / "g.yaml", "expect: [final(depth.depth) > 2, never depth.depth > 4]\n");
    Under whole(source, {.vary = {"seed=1..2"}}, 0, folder / "whole");
    whole.run(1);
    CHECK(whole.all()[0].outcome == campaign::Outcome::bad);
    CHECK(whole.all()[0].not_judged == 0);
    Under some(source, {.vary = {"seed=1..2"}, .length = 2s}, 0, folder / "some");
    some.run(1);
    const Result first = some.all()[0];
    CHECK(first.outcome == campaign::Outcome::good);
    CHECK(first.not_judged == 3);
    CHECK(first.why == "3 conditions were not judged: the run ended at 2 s, its mission ends at 5 s");
    const Summary summary = summarise(*some.results, some.campaign.measures);
    CHECK(summary.not_judged == 2);
    CHECK(summary.first_not_judged->index == 0);
    CHECK(some.csv().ends_with(",good,0,2," + some.csv().substr(some.csv().rfind("0x"), 18) +
                               ",\"3 conditions were not judged: the run ended at 2 s, its mission ends at 5 s\",3\n"));
  }

  TEST_CASE("runs that are all the same are known by their digests and metrics") {
    const Folder folder;
    const auto same = [&](const std::string& name, const std::string& vary) {
      Under under(source_of(waves), {.vary = {vary}}, 0, folder / name);
      under.run(2);
      return summarise(*under.results, under.campaign.measures).all_same;
    };
    CHECK(same("seeds", "seed=1..5"));
    CHECK(!same("one", "tasks.a.parameters.gain=[1]"));
    CHECK(!same("gains", "tasks.a.parameters.gain=[1, 1, 1.1]"));
  }

  TEST_CASE("all runs get the files that were read first, however they change on the disk") {
    const Folder folder;
    const std::string mission = folder / "dive.csv", graph = folder / "g.yaml";
    const auto write = [&](double depth) { std::ofstream(mission) << dive_to(depth); };
    const GraphSource source = diving(graph);
    write(3);
    const SourceSet read;
    Graphs graphs(source);
    const Campaign campaign = state_campaign(graphs, {.vary = {"tasks.depth.let=[100ms, 50ms]"}});
    graphs.close(read.read());
    const Draws draws(campaign, 0);
    const std::atomic<bool> stop{false};
    const auto deepest = [&](std::uint64_t run) {
      return run_one(graphs, draws.at(run), campaign.length, stop)->metrics[0].number;
    };
    CHECK(deepest(0) == 3);
    write(6);
    CHECK(deepest(0) == 3);
    fs::remove(mission);
    CHECK(deepest(1) == 3);
    const Identity identity = identity_of(source, graphs, campaign, 0, {}, read.read());
    CHECK(identity.back().first == "file dive.csv");
    // what was not read first is no reason to say that there is no such run
    Start other = draws.at(1);
    other.index = 7;
    other.set = {"distributers.neptus.link.file=rise.csv"};
    CHECK_THROWS_WITH_AS(run_one(graphs, other, campaign.length, stop),
                         ("run 7 needs '" + folder / "rise.csv" +
                          "', which was not read before the first run; the results hold nothing of that run")
                             .c_str(),
                         UnreadFile);
  }

  TEST_CASE("of a run for which there was no thread there is no result; the campaign ends, and goes on later") {
    if (!tests::RefusedThreads::possible) return;
    const Folder folder;
    Under under(source_of(waves), {.vary = {"seed=1..3"}}, 0, folder / "r");
    {
      const tests::RefusedThreads refused(0);
      CHECK_THROWS_WITH_AS(under.run(1), "Resource temporarily unavailable", std::system_error);
    }
    CHECK(under.all().empty());
    under.run(1);
    CHECK(under.all().size() == 3);
    for (const Result& result : under.all()) CHECK(result.outcome == campaign::Outcome::good);
  }

  TEST_CASE("what can't vary so is an error at its place, before anything runs") {
    const Folder folder;
    const auto wrong = [&](const std::string& vary) -> std::string {
      try {
        Under under(source_of(waves), {.vary = {vary}}, 1, folder / "r");
      } catch (const SpecError& error) { return to_text(error.problems()[0]); }
      return "";
    };
    CHECK(wrong("tasks.a.parameters.fails_at=1..9") ==
          "--vary:1:1: error: 'tasks.a.parameters.fails_at' can't be 4.055728090000841: task 'a' (Unsteady) parameter "
          "'fails_at' needs an int64, not '4.055728090000841'; that is not an integer\n"
          "  tasks.a.parameters.fails_at=1..9\n  ^");
    CHECK(
        wrong("tasks.a.parameters.gian=1..9") ==
        "--vary:1:1: error: 'tasks.a.parameters.gian' can't be 1: task 'a' (Unsteady) has no parameter 'gian'; did you "
        "mean 'gain'?; it has: gain, fails_at, stops_being_finite_at\n"
        "  tasks.a.parameters.gian=1..9\n  ^");
    CHECK(wrong("tasks.c.parameters.gain=1..9") ==
          "--vary:1:1: error: 'tasks.c.parameters.gain' can't be 1: path 'tasks.c.parameters.gain': 'tasks' has no "
          "'c'; it "
          "has: a, b, sum\n  tasks.c.parameters.gain=1..9\n  ^");
    CHECK(wrong("tasks.b.let=1ms..6ms") ==
          "--vary:1:1: error: 'tasks.b.let' can't be 0.006s: task 'b' has LET 6ms longer than its period 5ms\n"
          "  tasks.b.let=1ms..6ms\n  ^");
  }
}
