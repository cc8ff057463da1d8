#include "graph/registry.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "graph/text/errors.h"
#include "graph/values/type_of.h"

TEST_SUITE("graph/registry") {
  using namespace jarol;

  // As a struct of so many bytes would be described; no value of it is made.
  Type field_of(std::size_t bytes) {
    Type type;
    type.name = "Large";
    type.size = bytes;
    return type;
  }

  TaskClass copies(const Type* in, const Type* out) {
    TaskClass task;
    task.name = "Copies";
    task.in = in;
    task.out = out;
    return task;
  }

  TEST_CASE("what has values that are too large to copy is refused, and nothing of it is kept") {
    constexpr std::size_t largest = std::size_t{1} << 30;
    const Type good = field_of(largest), large = field_of(largest + 1), nothing;
    const auto struct_of = [](const Type& type) {
      Type fields;
      fields.fields.emplace_back();
      fields.fields.back().name = "value";
      fields.fields.back().type = &type;
      return fields;
    };
    const Type fits = struct_of(good), too_large = struct_of(large);
    Registry registry;
    CHECK_THROWS_WITH_AS(registry.add(copies(&too_large, &nothing)),
                         "task 'Copies' input 'value' (Large) has 1073741825 bytes; values have at most 1GiB",
                         InputError);
    CHECK_THROWS_WITH_AS(registry.add(copies(&nothing, &too_large)),
                         "task 'Copies' output 'value' (Large) has 1073741825 bytes; values have at most 1GiB",
                         InputError);
    CHECK_THROWS_WITH_AS(registry.add(DistributerClass{"Hands", "over", {{"all", Direction::in, &large, ""}}}),
                         "distributer 'Hands' channel 'all' (Large) has 1073741825 bytes; values have at most 1GiB",
                         InputError);
    CHECK(registry.find_task("Copies") == nullptr);
    CHECK(registry.find_distributer("Hands") == nullptr);
    CHECK(registry.type_names().empty());
    registry.add(copies(&fits, &fits));
    CHECK(registry.find_type("Large") == &good);
  }
}
