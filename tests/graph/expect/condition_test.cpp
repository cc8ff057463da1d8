#include "graph/model/condition.h"

#include <doctest/doctest.h>

#include <limits>

namespace {
using namespace jarol::expect;
using Kind = Comparison::Kind;

// Whether it holds below, at and above 2, and of what is no number.
std::string held(const Comparison& comparison) {
  std::string text;
  for (const double number : {1.5, 2.0, 2.5, std::numeric_limits<double>::quiet_NaN()})
    text += holds(comparison, number) ? "y" : "n";
  return text;
}
}  // namespace

TEST_SUITE("graph/expect/condition") {
  TEST_CASE("each comparison at its edge; what is no number meets none") {
    CHECK(held({Kind::less, 2}) == "ynnn");
    CHECK(held({Kind::at_most, 2}) == "yynn");
    CHECK(held({Kind::greater, 2}) == "nnyn");
    CHECK(held({Kind::at_least, 2}) == "nyyn");
    CHECK(held({Kind::is, 2}) == "nynn");
    CHECK(held({Kind::is_not, 2}) == "ynyn");
    CHECK(held({Kind::within, 0.5, 2}) == "yyyn");
    CHECK(held({Kind::within, 0.4, 2}) == "nynn");
    CHECK(held({Kind::within, 0.5, 2.25}) == "nyyn");
  }
}
