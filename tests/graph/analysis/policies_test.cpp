#include "graph/analysis/policies.h"

#include <doctest/doctest.h>

#include "graph/language/key.h"

namespace {
using namespace jarol;

TEST_SUITE("graph/analysis/policies") {
  TEST_CASE("each name that 'policy' may have has its entry, in the same place") {
    const std::vector<std::string> names = Words<Policy>::list();
    REQUIRE(analysis::policies().size() == names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const analysis::PolicyEntry& entry = analysis::policies()[i];
      CHECK(entry.policy == static_cast<Policy>(i));
      CHECK(entry.name() == names[i]);
      CHECK(&analysis::entry_of(entry.policy) == &entry);
      CHECK(static_cast<bool>(entry.check));
    }
  }

  TEST_CASE("under global EDF alone a task has no core of its own, and 'run' executes the first two") {
    for (const analysis::PolicyEntry& entry : analysis::policies()) {
      CHECK(entry.keeps_core == (entry.policy != Policy::global_edf));
      CHECK(entry.executed == (entry.policy == Policy::table || entry.policy == Policy::fixed_priority));
    }
  }
}
}  // namespace
