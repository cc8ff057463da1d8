// Campaigns of graphs without vehicles: each run is that of a graph of its own, whatever shares threads and plan with
// it.
// In one file: all cases run the campaigns of one graph.
#include <doctest/doctest.h>
#include <sqlite3.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "distributers/campaign/run_all.h"
#include "distributers/campaign/shrink.h"
#include "distributers/campaign/summary.h"
#include "distributers/session/session.h"
#include "graph/campaign/draws.h"
#include "tasks/values/lauv.h"
#include "tests/distributers/all_parts.h"
#include "tests/refused_threads.h"

namespace {
using namespace jarol;
using namespace jarol::campaign;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

struct Unsteady {
  static constexpr std::string_view summary = "a sum of sines, which fails when it is asked to";
  struct Param {
    double gain = 1;
    std::int64_t fails_at = -1;
    std::int64_t stops_being_finite_at = -1;
    static constexpr auto fields() {
      return describe(field<&Param::gain>(), field<&Param::fails_at>(), field<&Param::stops_being_finite_at>());
    }
  };
  struct State {
    double phase = 0;
    static constexpr auto fields() { return describe(field<&State::phase>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    if (tick.activation == p.fails_at) throw std::runtime_error("it was to fail");
    state.phase += p.gain * 0.1;
    out.out = tick.activation == p.stops_being_finite_at ? HUGE_VAL : p.gain * std::sin(state.phase);
  }
};

struct DepthOf {
  static constexpr std::string_view summary = "the depth of a setpoint";
  struct In {
    tasks::Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::setpoint>()); }
  };
  struct Out {
    double depth = 0;
    static constexpr auto fields() { return describe(field<&Out::depth>()); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.depth = in.setpoint.depth; }
};

const std::string waves = R"(
graph: waves
timing: {period: 10ms}
tasks:
  a: {type: Unsteady, wcet: 1us}
  b: {type: Unsteady, wcet: 1us, period: 5ms, let: 3ms, parameters: {gain: 0.5}}
  sum: {type: Sum, wcet: 1us}
connections: [a.out -> sum.a, b.out -> sum.b]
expect: [max(sum.out) < 2.3]
campaign:
  for: 2s
  metrics: {most: max(sum.out), mean: mean(abs(sum.out)), early: time of a.out > 0.5}
)";

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("campaign_test_" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const std::string& name) const { return path / name; }
  fs::path path;
};

GraphSource source_of(const std::string& text, std::vector<std::string> metrics = {}) {
  return {std::make_shared<const Source>(Source{"t.yaml", text}),
          tests::all_parts_with<Unsteady, DepthOf>(),
          {},
          std::move(metrics)};
}

// The mission beside it, dive.csv, says how deep.
GraphSource diving(const std::string& file, const std::string& expected = "") {
  const std::string text =
      "graph: g\n"
      "distributers: {neptus: {type: LauvOperator, link: {type: script, file: dive.csv}}}\n"
      "communicators: {setpoint: {channel: neptus.setpoint, period: 100ms}}\n"
      "tasks: {depth: {type: DepthOf, wcet: 1us, period: 100ms}}\n"
      "connections: [setpoint -> depth.setpoint]\n"
      "campaign: {metrics: {deepest: max(depth.depth)}}\n";
  return {std::make_shared<const Source>(Source{file, text + expected}),
          tests::all_parts_with<Unsteady, DepthOf>(),
          {},
          {}};
}

std::string dive_to(double depth) {
  const std::string row = "," + number_text(depth) + ",0deg,0\n";
  return "time,setpoint.depth,setpoint.heading,setpoint.speed\n0" + row + "5" + row;
}

// A campaign under way.
struct Under {
  Under(const GraphSource& of, const Wishes& wishes, std::uint64_t seed, const std::string& file)
      : source(of), graphs(source), campaign(state_campaign(graphs, wishes)), draws(campaign, seed) {
    results.emplace(file, identity_of(source, graphs, campaign, seed, {{"program", "test"}}), campaign);
  }

  void run(std::size_t workers, const Shard& shard = {}) {
    run_all(graphs, campaign, draws, missing(results->done(draws.runs()), shard.of(draws.runs())), workers, *results,
            [this](const Result&) {
              if (++seen == stop_after) stop = true;
            },
            {stop, stuck});
  }

  std::string csv() const {
    std::string text;
    write_csv(*results, campaign, draws, [&](std::string_view more) { text += more; });
    return text;
  }

  std::vector<Result> all() const {
    std::vector<Result> found;
    results->for_each([&](const Result& result) { found.push_back(result); });
    return found;
  }

  GraphSource source;
  Graphs graphs;
  Campaign campaign;
  Draws draws;
  std::optional<Results> results;
  std::size_t seen = 0, stop_after = 0;
  std::atomic<bool> stop{false};
  StuckRuns* stuck = nullptr;
};

const Wishes gains{
    .vary = {"tasks.a.parameters.gain=0.5..1.5", "tasks.b.parameters.gain=normal(1, 0.3)", "seed=1..30"}};
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

  TEST_CASE("the mildest run that still fails is found: what need not be away from the middle is there") {
    const Folder folder;
    // a breaks the limit alone; b stands beside it, and seeds change nothing
    Under under(
        source_of(waves, {"high=max(a.out) < 2.5"}),
        {.vary = {"tasks.b.parameters.gain=-0.5..0.5", "seed=3..4", "tasks.a.parameters.gain=-1..4"}, .runs = 9}, 5,
        folder / "r");
    under.run(2);
    const std::vector<Result> all = under.all();
    const auto first =
        std::find_if(all.begin(), all.end(), [](const Result& r) { return r.outcome == campaign::Outcome::bad; });
    REQUIRE(first != all.end());
    const auto shrunk =
        shrink(under.graphs, under.campaign, under.draws, first->index, campaign::Outcome::bad, under.stop);
    REQUIRE(shrunk.has_value());
    CHECK(shrunk->start.set[0] == "tasks.b.parameters.gain=0");
    CHECK(shrunk->start.index == first->index);
    CHECK(shrunk->result.outcome == campaign::Outcome::bad);
    CHECK(!shrunk->at_the_middle);
    CHECK(shrunk->tried == 14);
    const auto ends = [&](double gain) {
      Start start = shrunk->start;
      start.set[1] = "tasks.a.parameters.gain=" + std::to_string(gain);
      return run_one(under.graphs, start, under.campaign.length, under.stop)->outcome;
    };
    const double gain = std::stod(shrunk->start.values[2]);
    CHECK(ends(gain) == campaign::Outcome::bad);
    CHECK(ends(gain - (std::stod(under.draws.at(first->index).values[2]) - 1.5) / 1000) == campaign::Outcome::good);
    // where the middle of all fails too, that is the mildest
    Under worse(source_of(waves, {"high=max(a.out) < 0.1"}), {.vary = {"tasks.a.parameters.gain=1..4"}, .runs = 2}, 5,
                folder / "worse");
    worse.run(1);
    const auto middle = shrink(worse.graphs, worse.campaign, worse.draws, 1, campaign::Outcome::bad, worse.stop);
    REQUIRE(middle.has_value());
    CHECK(middle->at_the_middle);
    CHECK(middle->start.set[0] == "tasks.a.parameters.gain=2.5");
    worse.stop = true;
    CHECK(!shrink(worse.graphs, worse.campaign, worse.draws, 1, campaign::Outcome::bad, worse.stop));
  }

  TEST_CASE("the mildest run fails as the one that is made milder: by its metric, condition, or task and cause") {
    const Folder folder;
    const auto mildest = [&](const std::string& name, const std::vector<std::string>& vary,
                             const std::vector<std::string>& metrics, std::uint64_t index) {
      Under under(source_of(waves, metrics), {.vary = vary}, 0, folder / name);
      const std::optional<Result> first =
          run_one(under.graphs, under.draws.at(index), under.campaign.length, under.stop);
      REQUIRE(first.has_value());
      const auto shrunk = shrink(under.graphs, under.campaign, under.draws, index, first->outcome, under.stop);
      REQUIRE(shrunk.has_value());
      return shrunk->start.set[0].substr(std::string("tasks.a.parameters.").size()) + ": " + shrunk->result.why;
    };
    // of the list the second breaks the other limit
    CHECK(mildest("metric", {"tasks.a.parameters.gain=[1, 0.1, 1.7]"},
                  {"high=max(a.out) < 1.5", "low=max(a.out) > 0.5"},
                  2) == "gain=1.7: metric 'high' is beyond its limit: it reached 1.7");
    // what comes first in a milder run is not all that is against it
    CHECK(mildest("both", {"tasks.a.parameters.gain=[1, 1.6, 1.7]"}, {"low=max(a.out) < 1.65", "high=min(b.out) < -1"},
                  1) == "gain=1: metric 'high' is beyond its limit: it reached -0.5");
    CHECK(mildest("fault",
                  {"tasks.a.parameters.fails_at=[-1, 20]", "tasks.a.parameters.stops_being_finite_at=[-1, 50]"}, {},
                  3) == "fails_at=20: task 'a' activation 20 at 0.2 s: threw: it was to fail");
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

  TEST_CASE("results that were removed meanwhile are missed") {
    const Folder folder;
    Under under(source_of(waves), {.vary = {"seed=1..3"}}, 0, folder / "r");
    under.run(1);
    under.results->require_in_place();
    fs::remove(folder / "r");
    const std::string lost = "the results are lost: '" + folder / "r" +
                             "' was removed or replaced while the campaign was running; the same command runs it anew";
    CHECK_THROWS_WITH_AS(under.results->require_in_place(), lost.c_str(), ResultsError);
    std::ofstream(folder / "r") << "another";
    CHECK_THROWS_WITH_AS(under.results->require_in_place(), lost.c_str(), ResultsError);
  }

  TEST_CASE("another build of the program or of a library is another campaign") {
    const Identity here = identity_of_program("jarol 1");
    REQUIRE(here.size() > 2);
    CHECK(here[0] == std::pair<std::string, std::string>("program", "jarol 1"));
    CHECK(here[1].first == "build");
    CHECK(here[2].first.starts_with("library "));
    const Folder folder;
    const GraphSource source = source_of(waves);
    Graphs graphs(source);
    const Campaign campaign = state_campaign(graphs, gains);
    const auto open = [&](const Identity& program) {
      Results(folder / "r", identity_of(source, graphs, campaign, 1, program), campaign);
    };
    open(here);
    open(here);
    Identity other = here;
    other[1].second = "b1";
    CHECK_THROWS_WITH_AS(open(other),
                         ("'" + folder / "r" + "' has the results of another campaign: its 'build' was '" +
                          here[1].second + "', not 'b1'; repeat that, or name another file")
                             .c_str(),
                         OtherCampaign);
  }

  TEST_CASE("results of another campaign are refused with the reason") {
    const Folder folder;
    const std::string file = folder / "r";
    const auto wrong = [&](const GraphSource& source, const Wishes& wishes, std::uint64_t seed = 1) -> std::string {
      try {
        Under under(source, wishes, seed, file);
      } catch (const OtherCampaign& error) { return std::string(error.what()).substr(file.size() + 2); }
      return "";
    };
    CHECK(wrong(source_of(waves), gains) == "");
    CHECK(wrong(source_of(waves), gains) == "");
    const std::string has = " has the results of another campaign: ", remedy = "; repeat that, or name another file";
    CHECK(wrong(source_of(waves), gains, 2) == has + "its 'seed' was '1', not '2'" + remedy);
    CHECK(wrong(source_of(waves + "\n"), gains) == has + "the graph has changed since" + remedy);
    CHECK(wrong(source_of(waves), {.vary = gains.vary, .runs = 5}) == has + "its 'runs' was nothing, not '5'" + remedy);
    CHECK(wrong(source_of(waves), {.vary = {"seed=1..30"}}) ==
          has +
              "its 'vary' was 'tasks.a.parameters.gain=0.5..1.5', 'tasks.b.parameters.gain=normal(1, 0.3)', "
              "'seed=1..30', not 'seed=1..30'" +
              remedy);
    CHECK(wrong(source_of(waves, {"low=min(sum.out)"}), gains) ==
          has +
              "its 'metrics' was 'most=max(sum.out)', 'mean=mean(abs(sum.out))', 'early=time of a.out > 0.5', not "
              "'most=max(sum.out)', 'mean=mean(abs(sum.out))', 'early=time of a.out > 0.5', 'low=min(sum.out)'" +
              remedy);
    sqlite3* other = nullptr;
    REQUIRE(sqlite3_open((folder / "other").c_str(), &other) == SQLITE_OK);
    CHECK(sqlite3_exec(other, "CREATE TABLE t (a)", nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(other);
    CHECK_THROWS_WITH_AS(
        Under(source_of(waves), gains, 1, folder / "other"),
        ("'" + folder / "other' is a database, but holds no results of a campaign; name another file").c_str(),
        OtherCampaign);
  }

  TEST_CASE("a file that is refused stays byte for byte as it was, and nothing is left beside it") {
    const Folder folder;
    const auto content = [](const std::string& path) {
      std::ifstream file(path, std::ios::binary);
      return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    const auto refused = [&](const std::string& name, const Wishes& wishes) {
      const std::string before = content(folder / name);
      CHECK(!before.empty());
      CHECK_THROWS_AS(Under(source_of(waves), wishes, 1, folder / name), std::exception);
      CHECK(content(folder / name) == before);
      CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);
      fs::remove(folder / name);
    };
    {
      Under under(source_of(waves), gains, 1, folder / "another");
      under.stop_after = 3;
      under.run(1);
    }
    refused("another", {.vary = {"seed=1..3"}});
    sqlite3* other = nullptr;
    REQUIRE(sqlite3_open((folder / "database").c_str(), &other) == SQLITE_OK);
    CHECK(sqlite3_exec(other, "CREATE TABLE t (a); INSERT INTO t VALUES (1)", nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(other);
    refused("database", gains);
    std::ofstream(folder / "text") << "what somebody has written, and no database";
    refused("text", gains);
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
