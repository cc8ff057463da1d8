// Damaged specs never crash the loader, and are either valid graphs or get a report.
#include <doctest/doctest.h>

#include <ctime>

#include "tests/graph/graph_of.h"
#include "tests/graph/mutations.h"
#include "tests/how_many.h"

namespace {
std::string text_of(const std::string& path) { return jarol::read_source(path)->text; }
}  // namespace

TEST_SUITE("graph/mutations") {
  TEST_CASE("twenty thousand damaged specs: no crash, no hang") {
    const std::string counting = text_of("specs/counting.yaml"), exolauv = text_of("specs/exolauv.yaml");
    REQUIRE(counting.size() > 100);
    REQUIRE(exolauv.size() > 100);
    const std::uint64_t count = jarol::tests::how_many(20'000, 200'000);
    std::uint64_t valid = 0, reported = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      const std::string text = jarol::tests::mutate(seed % 2 == 0 ? counting : exolauv, seed);
      CAPTURE(seed);
      const std::clock_t start = std::clock();  // of the processor: others may take their time from it
      const std::string report = jarol::tests::report_on(text);
      CHECK(std::clock() - start < 10 * CLOCKS_PER_SEC);
      ++(report.empty() ? valid : reported);
    }
    MESSAGE(valid << " still valid, " << reported << " reported");
    CHECK(valid > 10);
    CHECK(reported > count / 2);
  }
}
