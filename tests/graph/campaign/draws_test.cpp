// What the runs of a campaign start with.
#include "graph/campaign/draws.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "graph/campaign/variation.h"

using namespace jarol;
using namespace jarol::campaign;

namespace {
Campaign varying(const std::vector<std::string>& arguments, std::optional<std::int64_t> runs = {},
                 Sampling sampling = Sampling::random) {
  Campaign campaign;
  Problems problems;
  for (const std::string& argument : arguments) campaign.vary.push_back(*read_variation(argument, problems));
  campaign.runs = runs;
  campaign.sampling = sampling;
  return campaign;
}

std::vector<double> numbers(const Campaign& campaign, std::uint64_t seed, std::size_t variation) {
  const Draws draws(campaign, seed);
  std::vector<double> all;
  for (std::uint64_t i = 0; i < draws.runs(); ++i) all.push_back(std::stod(draws.at(i).values[variation]));
  return all;
}
}  // namespace

TEST_SUITE("graph/campaign/draws") {
  TEST_CASE("lists, grids and seeds are crossed, the last one goes fastest") {
    const Campaign campaign = varying({"a=[x, y]", "seed=7..9"});
    const Draws draws(campaign, 1);
    REQUIRE(draws.runs() == 6);
    std::string all;
    for (std::uint64_t i = 0; i < 6; ++i) all += draws.at(i).set[0] + " " + std::to_string(draws.at(i).seed) + ", ";
    CHECK(all == "a=x 7, a=x 8, a=x 9, a=y 7, a=y 8, a=y 9, ");
    CHECK(draws.at(0).values == std::vector<std::string>{"x", "7"});
    // more runs begin again, with other draws
    const Campaign more = varying({"a=[x, y]", "b=0..1"}, 5);
    const Draws again(more, 1);
    CHECK(again.at(4).set[0] == "a=x");
    CHECK(again.at(4).set[1] != again.at(0).set[1]);
    CHECK(again.at(4).seed == 1);
    CHECK(Draws(varying({"seed=[4, 2]"}), 1).runs() == 2);
    const Campaign listed = varying({"seed=[4, 2]"});
    CHECK(Draws(listed, 1).at(1).seed == 2);
    CHECK(Draws(listed, 1).at(1).set.empty());
  }

  TEST_CASE("a draw is a function of the seed, the path and the index alone") {
    const Campaign one = varying({"a=0..1"}, 10), two = varying({"b=0..1", "a=0..1"}, 1000);
    for (std::uint64_t i = 0; i < 10; ++i) CHECK(Draws(one, 3).at(i).values[0] == Draws(two, 3).at(i).values[1]);
    CHECK(Draws(one, 3).at(0).values[0] != Draws(one, 4).at(0).values[0]);
    CHECK(Draws(two, 3).at(0).values[0] != Draws(two, 3).at(0).values[1]);
    // for ever, on every machine
    CHECK(Draws(one, 3).at(0).values[0] == "0.6689207341647153");
    CHECK(Draws(one, 3).at(9).values[0] == "0.7067674559317417");
    const Campaign normal = varying({"a=normal(10, 2)"}, 10);
    CHECK(Draws(normal, 3).at(0).values[0] == "10.873869880160075");
  }

  TEST_CASE("ranges are drawn from evenly, normal distributions have their moments") {
    const std::vector<double> even = numbers(varying({"a=2..4"}, 20000), 1, 0);
    std::array<int, 10> bins{};
    for (const double number : even) {
      REQUIRE(number > 2);
      REQUIRE(number < 4);
      ++bins[static_cast<std::size_t>((number - 2) * 5)];
    }
    double chi_squared = 0;
    for (const int count : bins) chi_squared += (count - 2000.0) * (count - 2000.0) / 2000.0;
    CHECK(chi_squared < 27.9);  // nine degrees of freedom: one of a thousand sequences has more
    const std::vector<double> normal = numbers(varying({"a=normal(5, 2)"}, 20000), 1, 0);
    double mean = 0, variance = 0;
    for (const double number : normal) mean += number / 20000;
    for (const double number : normal) variance += (number - mean) * (number - mean) / 19999;
    CHECK(std::abs(mean - 5) < 0.05);                  // 3.5 standard errors
    CHECK(std::abs(std::sqrt(variance) - 2) < 0.035);  // 3.5 standard errors
  }

  TEST_CASE("a Latin hypercube has one run in each of as many equal parts, of each range by itself") {
    const Campaign campaign = varying({"a=0..1", "b=0..100", "c=normal(0, 1)"}, 50, Sampling::latin);
    for (const std::size_t variation : {0, 1}) {
      std::set<int> strata;
      const double scale = variation == 0 ? 50 : 0.5;
      for (const double number : numbers(campaign, 9, variation)) strata.insert(static_cast<int>(number * scale));
      CHECK(strata.size() == 50);
      CHECK(*strata.rbegin() == 49);
    }
    std::vector<double> normal = numbers(campaign, 9, 2);
    std::sort(normal.begin(), normal.end());
    CHECK(normal[24] < 0);
    CHECK(normal[25] > 0);
    CHECK(std::abs(normal[0]) > 2.05);  // below the quantile of 2 %
    // not in step
    CHECK(numbers(campaign, 9, 0)[0] * 100 != doctest::Approx(numbers(campaign, 9, 1)[0]).scale(0).epsilon(0.02));
  }

  TEST_CASE("what goes round more slowly than there can be runs keeps its first value") {
    // the product of what follows [x, y] is beyond 64 bits
    const Campaign campaign = varying({"a=[x, y]", "seed=0..9223372036854775807", "b=[c, d]", "e=[f, g]"}, 1000);
    const Draws draws(campaign, 1);
    for (const std::uint64_t i : {0UL, 1UL, 2UL, 3UL, 4UL, 998UL, 999UL}) {
      const Start start = draws.at(i);
      CHECK(start.values ==
            std::vector<std::string>{"x", std::to_string(i / 4), i / 2 % 2 == 0 ? "c" : "d", i % 2 == 0 ? "f" : "g"});
      CHECK(start.seed == i / 4);
    }
    const Campaign widest = varying({"a=[x, y]", "seed=1..18446744073709551615"}, 2);
    CHECK(Draws(widest, 1).at(1).values == std::vector<std::string>{"x", "2"});
  }

  TEST_CASE("a campaign has a number of runs, or it is said why not") {
    CHECK(wrong_runs(varying({"a=0..1"}, 3)) == "");
    CHECK(wrong_runs(varying({"a=[1]", "b=0..1"})) == "");
    CHECK(wrong_runs(varying({"a=0..1"})) ==
          "it is not said how many runs there are; only lists and seeds come to an end of themselves");
    CHECK(wrong_runs(varying({"seed=1..100000", "a=grid(0..1, 100000)"})) ==
          "the lists and seeds that it varies have more than 1000000000 combinations; say how many runs there are");
    const Campaign large = varying({"seed=1..100000", "a=grid(0..1, 100000)"}, 5);
    CHECK(Draws(large, 1).at(4).set[0] == "a=4.000040000400004e-05");
  }
}
