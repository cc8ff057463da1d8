// Percentiles, means and worst cases against numbers that were found by hand.
#include "distributers/campaign/summary.h"

#include <doctest/doctest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace {
using namespace jarol;
using namespace jarol::campaign;
namespace fs = std::filesystem;

const double nan_number = std::nan("");

// A metric with that limit.
Campaign measuring(const std::optional<expect::Comparison>& limit) {
  Campaign campaign;
  campaign.measures.metrics.push_back({"m", limit.has_value(), false});
  expect::Condition condition;
  condition.metric.unit = "m";
  if (limit) condition.comparison = *limit;
  campaign.measures.conditions.push_back(condition);
  return campaign;
}

class File {
 public:
  File() : path_(fs::temp_directory_path() / ("summary_test_" + std::to_string(::getpid()))) { fs::remove(path_); }
  ~File() { fs::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

struct Summed {
  MetricSummary metric;
  std::string csv;
};

// What runs with those numbers come to, in that order.
Summed summed(const std::vector<double>& numbers, const std::optional<expect::Comparison>& limit = {}) {
  const File file;
  Campaign campaign = measuring(limit);
  campaign.runs = static_cast<std::int64_t>(numbers.size());
  Results results(file.path(), {{"key", "value"}}, campaign);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    results.add({}, {.index = i, .digest = i, .metrics = {Reached{numbers[i], ""}}});
  Summed made{summarise(results, campaign.measures).metrics.at(0), ""};
  write_csv(results, campaign, Draws(campaign, 0), [&](std::string_view text) { made.csv += text; });
  return made;
}

expect::Comparison limit(expect::Comparison::Kind kind, double of = 0) { return {.kind = kind, .limit = 1, .of = of}; }
using Is = expect::Comparison::Kind;
}  // namespace

TEST_SUITE("distributers/campaign/summary") {
  TEST_CASE("percentiles are numbers that runs have, by nearest rank; mean and deviation are those of the sample") {
    const MetricSummary ten = summed({7, 1, 10, 4, 2, 9, 3, 8, 6, 5}).metric;
    CHECK(ten.count == 10);
    CHECK(ten.missing == 0);
    CHECK(ten.mean == 5.5);
    CHECK(ten.deviation == doctest::Approx(3.0276503540974917).scale(0).epsilon(1e-15));  // sqrt(82.5 / 9)
    CHECK(ten.percentiles == std::array<double, 5>{1, 3, 5, 8, 10});  // ranks 0.5, 2.5, 5, 7.5, 9.5, up
    CHECK(ten.min->index == 1);
    CHECK(ten.min->value == 1);
    CHECK(ten.max->index == 2);
    CHECK(ten.max->value == 10);
    CHECK(!ten.worst);

    std::vector<double> hundred;
    for (int i = 0; i < 100; ++i) hundred.push_back((i * 37) % 100 + 1);  // 1 to 100, each once
    CHECK(summed(hundred).metric.percentiles == std::array<double, 5>{5, 25, 50, 75, 95});
    hundred.push_back(101);
    CHECK(summed(hundred).metric.percentiles == std::array<double, 5>{6, 26, 51, 76, 96});  // 5.05, 25.25, ..., up

    const MetricSummary one = summed({-2.5}).metric;
    CHECK(one.percentiles == std::array<double, 5>{-2.5, -2.5, -2.5, -2.5, -2.5});
    CHECK(one.mean == -2.5);
    CHECK(one.deviation == 0);
    CHECK(summed({}).metric.count == 0);
    CHECK(!summed({}).metric.min);
  }

  TEST_CASE("the worst is the one nearest to what the limit forbids, or farthest beyond it; the first of equals") {
    const std::vector<double> numbers{3, -8, 9, 2, 9, -8};
    CHECK(summed(numbers, limit(Is::less)).metric.worst->index == 2);
    CHECK(summed(numbers, limit(Is::at_most)).metric.worst->index == 2);
    CHECK(summed(numbers, limit(Is::greater)).metric.worst->index == 1);
    CHECK(summed(numbers, limit(Is::at_least)).metric.worst->index == 1);
    CHECK(summed(numbers, limit(Is::within, 2)).metric.worst->index == 1);   // 10 away
    CHECK(summed(numbers, limit(Is::within, -4)).metric.worst->index == 2);  // 13 away
    CHECK(!summed(numbers, limit(Is::is)).metric.worst);
  }

  TEST_CASE("what is no number, of either sign, is in the results, last of all, at no end, and the worst") {
    for (const double sign : {1.0, -1.0}) {
      CAPTURE(sign);
      const Summed all = summed({2, std::copysign(nan_number, sign), 1, 3}, limit(Is::less));
      CHECK(all.metric.count == 4);
      CHECK(all.metric.missing == 0);
      CHECK(all.metric.min->value == 1);
      CHECK(all.metric.max->value == 3);
      CHECK(all.metric.worst->index == 1);
      CHECK(std::isnan(all.metric.worst->value));
      CHECK(std::isnan(all.metric.percentiles[4]));
      CHECK(all.metric.percentiles[2] == 2);
      CHECK(std::isnan(all.metric.mean));
      CHECK(all.csv ==
            "run,seed,m,outcome,faults,simulated_s,digest,why,not_judged\n"
            "0,0,2,good,0,0,0x0000000000000000,,0\n"
            "1,0,nan,good,0,0,0x0000000000000001,,0\n"
            "2,0,1,good,0,0,0x0000000000000002,,0\n"
            "3,0,3,good,0,0,0x0000000000000003,,0\n");
    }
    const MetricSummary none = summed({nan_number, -nan_number}).metric;
    CHECK(none.count == 2);
    CHECK(std::isnan(none.min->value));
    const MetricSummary infinite = summed({HUGE_VAL, 1, -HUGE_VAL}, limit(Is::less)).metric;
    CHECK(infinite.max->value == HUGE_VAL);
    CHECK(infinite.min->value == -HUGE_VAL);
    CHECK(infinite.worst->index == 0);
  }

  TEST_CASE("runs without a value that their limit needs are counted, if they came to their end") {
    const auto summary_of = [](expect::Condition::Kind kind, bool is_limit) {
      const File file;
      Campaign campaign = measuring(limit(Is::less));
      campaign.runs = 6;
      campaign.measures.metrics[0].is_limit = is_limit;
      campaign.measures.conditions[0].kind = kind;
      Results results(file.path(), {{"key", "value"}}, campaign);
      const std::vector<campaign::Outcome> outcomes{campaign::Outcome::good, campaign::Outcome::refused,
                                                    campaign::Outcome::fault, campaign::Outcome::bad,
                                                    campaign::Outcome::bad};
      for (std::uint64_t i = 0; i < outcomes.size(); ++i)
        results.add({}, {.index = i, .outcome = outcomes[i], .digest = 7, .metrics = {Reached{}}});
      results.add({}, {.index = 5, .outcome = campaign::Outcome::bad, .digest = 7, .metrics = {Reached{2, ""}}});
      return summarise(results, campaign.measures);
    };
    using Kind = expect::Condition::Kind;
    for (const Kind kind : {Kind::metric, Kind::once}) {
      const Summary summary = summary_of(kind, true);
      CHECK(summary.metrics[0].count == 1);
      CHECK(summary.metrics[0].missing == 5);
      CHECK(summary.metrics[0].bad_without == 2);
      CHECK(summary.metrics[0].first_bad_without == 3);
      CHECK(summary.not_good[0].index == 1);
      CHECK(summary.first_failed->index == 2);
    }
    // of these the value is the instant at which they are broken, and none is what is wanted
    for (const Kind kind : {Kind::always, Kind::never}) CHECK(summary_of(kind, true).metrics[0].bad_without == 0);
    CHECK(!summary_of(Kind::metric, false).metrics[0].first_bad_without);
  }

  TEST_CASE("a summary and a table of a range have the runs of that range alone") {
    const File file;
    Campaign campaign = measuring({});
    campaign.runs = 5;
    Results results(file.path(), {{"key", "value"}}, campaign);
    for (const std::uint64_t i : {4, 1, 2, 0}) {
      const campaign::Outcome outcome = i == 0 ? campaign::Outcome::bad : campaign::Outcome::good;
      results.add({}, {.index = i, .outcome = outcome, .digest = 7, .metrics = {Reached{double(i), ""}}});
    }
    const Summary summary = summarise(results, campaign.measures, {1, 4});
    CHECK(summary.runs == 2);
    CHECK(summary.not_good.empty());
    CHECK(summary.metrics[0].min->index == 1);
    CHECK(summary.metrics[0].max->index == 2);
    std::string csv;
    write_csv(results, campaign, Draws(campaign, 0), [&](std::string_view text) { csv += text; }, {2, 5});
    CHECK(csv ==
          "run,seed,m,outcome,faults,simulated_s,digest,why,not_judged\n"
          "2,0,2,good,0,0,0x0000000000000007,,0\n"
          "4,0,4,good,0,0,0x0000000000000007,,0\n");
  }

  TEST_CASE("a run that is refused has no digest: an empty cell, NULL in the database") {
    const File file;
    Campaign campaign = measuring({});
    campaign.runs = 2;
    const Result refused{.outcome = campaign::Outcome::refused, .why = "so", .metrics = {Reached{}}};
    const auto digest_of = [&](const std::string& run) {
      std::string text;
      sqlite3* database = nullptr;
      REQUIRE(sqlite3_open(file.path().c_str(), &database) == SQLITE_OK);
      CHECK(sqlite3_exec(
                database, ("SELECT quote(digest) FROM runs WHERE run = " + run).c_str(),
                [](void* to, int, char** cells, char**) { return *static_cast<std::string*>(to) = cells[0], 0; }, &text,
                nullptr) == SQLITE_OK);
      sqlite3_close(database);
      return text;
    };
    const auto table = [&] {
      std::string csv;
      const Results results(file.path(), {{"key", "value"}}, campaign);
      write_csv(results, campaign, Draws(campaign, 0), [&](std::string_view text) { csv += text; });
      return csv;
    };
    const std::string title = "run,seed,m,outcome,faults,simulated_s,digest,why,not_judged\n",
                      row = ",0,,refused,0,0,,so,0\n";
    Results(file.path(), {{"key", "value"}}, campaign).add({}, refused);
    CHECK(digest_of("0") == "NULL");
    CHECK(table() == title + "0" + row);
  }
}
