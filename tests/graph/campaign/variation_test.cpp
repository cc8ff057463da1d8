// How variations are written, and what they mean.
#include "graph/campaign/variation.h"

#include <doctest/doctest.h>

using namespace jarol;
using namespace jarol::campaign;

namespace {
Variation read(const std::string& argument) {
  Problems problems;
  const auto variation = read_variation(argument, problems);
  problems.throw_if_any();
  REQUIRE(variation.has_value());
  return *variation;
}

std::string wrong(const std::string& argument) {
  Problems problems;
  CHECK(!read_variation(argument, problems));
  REQUIRE(problems.size() == 1);
  return to_text(problems.list()[0]).substr(0, to_text(problems.list()[0]).find('\n'));
}
}  // namespace

TEST_SUITE("graph/campaign/variation") {
  TEST_CASE("a range, with a unit behind one number or both") {
    for (const char* text : {"a.b=1m..2.5 m", "a.b=1..2.5m", "a.b=1m..2.5m", "a.b= 1 .. 2.5 m"}) {
      const Variation v = read(text);
      CHECK(v.path == "a.b");
      CHECK(v.kind == Variation::Kind::uniform);
      CHECK(v.from == 1);
      CHECK(v.to == 2.5);
      CHECK(v.unit == "m");
    }
    CHECK(read("a.b=-1e-3..-.5e-3").from == -1e-3);
    CHECK(read("a.b=-1e-3..-.5e-3").to == -0.5e-3);
    CHECK(wrong("a.b=1m..2s") ==
          "--vary:1:5: error: 'a.b' can't vary as '1m..2s'; write a range as in 0.3..0.6, normal(0.5, 0.1), a list as "
          "in [1, 2, 4], or grid(0..1, 5)");
    CHECK(wrong("a.b=2..1") == "--vary:1:5: error: 'a.b' has a range that does not go up, '2..1'");
    for (const char* text : {"a.b=1..inf", "a.b=..2", "a.b=1..", "a.b=1", "a.b=x..y", "a.b=1..2..3", "a.b=1..2 !"})
      CHECK(wrong(text).find("can't vary as") != std::string::npos);
  }

  TEST_CASE("a normal distribution, a grid, a list") {
    const Variation normal = read("a.b=normal(10, 0.5ms)");
    CHECK(normal.kind == Variation::Kind::normal);
    CHECK(normal.from == 10);
    CHECK(normal.to == 0.5);
    CHECK(normal.unit == "ms");
    CHECK(wrong("a.b=normal(10, 0)") ==
          "--vary:1:5: error: 'a.b' needs a standard deviation above zero, not as in 'normal(10, 0)'");
    CHECK(read("a.b=grid(0.1..0.9, 3)").values == std::vector<std::string>{"0.1", "0.5", "0.9"});
    CHECK(read("a.b=grid(0..1deg, 2)").values == std::vector<std::string>{"0deg", "1deg"});
    for (const char* text : {"a.b=grid(0..1, 1)", "a.b=grid(0..1, 2.5)", "a.b=grid(0..1, 1000001)"})
      CHECK(wrong(text).find("needs a grid of 2 to 1000000 values, not as in") != std::string::npos);
    CHECK(read("a.b=[1, two, \"3\"]").values == std::vector<std::string>{"1", "two", "\"3\""});
    CHECK(read("a.b=[1, two]").text == "[1, two]");
    CHECK(read("a.b=[20ms, null, ~, \"null\"]").values == std::vector<std::string>{"20ms", "null", "null", "\"null\""});
    CHECK(wrong("a.b=[]") == "--vary:1:5: error: 'a.b' has an empty list of values");
    CHECK(wrong("a.b=[1, [2]]") ==
          "--vary:1:9: error: 'a.b' has a list among its values; they are numbers, words and "
          "null");
  }

  TEST_CASE("seeds are whole numbers") {
    const Variation seeds = read("seed=5..1000");
    CHECK(seeds.kind == Variation::Kind::seeds);
    CHECK(seeds.first == 5);
    CHECK(seeds.count == 996);
    CHECK(read("seed=[3, 7]").values == std::vector<std::string>{"3", "7"});
    CHECK(wrong("seed=1.5..3") ==
          "--vary:1:6: error: 'seed' can't vary as '1.5..3'; write 1..1000, or a list as in [3, 7]");
    CHECK(wrong("seed=[3, x]") == "--vary:1:10: error: 'seed' has 'x' among its values; they are whole numbers from 0");
    CHECK(wrong("seed=[3, null]") ==
          "--vary:1:10: error: 'seed' has 'null' among its values; they are whole numbers from 0");
    CHECK(wrong("seed=normal(1, 2)").find("can't vary as") != std::string::npos);
  }

  TEST_CASE("what no variation is gets a message that says how one is written") {
    CHECK(wrong("kp") ==
          "--vary:1:1: error: 'kp' is no override; write path=value, as in tasks.depth.parameters.kp=0.3..0.6");
    CHECK(wrong("kp={a: 1}").find("'kp' can't vary as a mapping; write a range") != std::string::npos);
  }

  TEST_CASE("times are whole nanoseconds, other numbers the shortest that read back as they are") {
    CHECK(value_text(1.23456789012, "ms") == "0.001234568s");
    CHECK(value_text(2, "h") == "7200s");
    CHECK(value_text(-0.5, "us") == "-0.0000005s");
    CHECK(value_text(0.1, "") == "0.1");
    CHECK(value_text(1.0 / 3, "rad/s") == "0.3333333333333333rad/s");
    CHECK(value_text(1e-7, "m") == "1e-07m");
  }
}
