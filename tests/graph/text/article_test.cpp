#include "graph/text/article.h"

#include <doctest/doctest.h>

TEST_SUITE("graph/text/article") {
  TEST_CASE("the names of types have the article that they are spoken with") {
    using jarol::with_article;
    CHECK(with_article("double") == "a double");
    CHECK(with_article("int32") == "an int32");
    CHECK(with_article("uint32") == "a uint32");
    CHECK(with_article("Attitude") == "an Attitude");
    CHECK(with_article("Motion") == "a Motion");
  }
}
