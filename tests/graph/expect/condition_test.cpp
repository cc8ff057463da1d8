#include "graph/model/condition.h"

#include <doctest/doctest.h>

#include <limits>

namespace {
using namespace jarol::expect;

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
    CHECK(held({Comparison::Kind::less, 2}) == "ynnn");
    CHECK(held({Comparison::Kind::at_most, 2}) == "yynn");
    CHECK(held({Comparison::Kind::greater, 2}) == "nnyn");
    CHECK(held({Comparison::Kind::at_least, 2}) == "nyyn");
    CHECK(held({Comparison::Kind::is, 2}) == "nynn");
    CHECK(held({Comparison::Kind::is_not, 2}) == "ynyn");
    CHECK(held({Comparison::Kind::within, 0.5, 2}) == "yyyn");
    CHECK(held({Comparison::Kind::within, 0.4, 2}) == "nynn");
    CHECK(held({Comparison::Kind::within, 0.5, 2.25}) == "nyyn");
  }
}
