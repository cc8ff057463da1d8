// The file of results: whose it is, and what is refused as results of this campaign.
#include "tests/distributers/campaign/waves.h"

#include <doctest/doctest.h>

#include <sqlite3.h>

#include <fstream>

namespace {
using namespace jarol;
using namespace jarol::campaign;
using namespace jarol::campaign::trial;
using namespace std::chrono_literals;
}  // namespace

TEST_SUITE("distributers/campaign/results") {
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
}
