// Ranges that fields are declared with; what does not compile is in not_a_value.cpp.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "graph/values/bind.h"
#include "graph/values/type_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Fin {
  double angle = 0;
  bool locked = false;
  static constexpr auto fields() { return describe(field<&Fin::angle>("rad").in(-0.6, 0.6), field<&Fin::locked>()); }
};

struct Ranged {
  double angle = 0.1;
  float coarse = 0;
  std::int8_t steps = 2;
  std::uint64_t count = 1;
  Duration wait = 5ms;
  std::array<double, 2> limits{};
  Eigen::Vector3d axis{0, 0, 1};
  std::array<std::array<Duration, 2>, 2> waits{};
  std::array<Fin, 2> fins{};
  double free = 0;
  static constexpr auto fields() {
    using R = Ranged;
    return describe(field<&R::angle>("rad").in(-0.5, 0.5), field<&R::coarse>().in(0, 0.1), field<&R::steps>().in(-3, 8),
                    field<&R::count>().in(1, 9007199254740992), field<&R::wait>().in(1ms, 2s),
                    field<&R::limits>().in(-1, 1), field<&R::axis>().in(-1, 1), field<&R::waits>().in(0s, 1s),
                    field<&R::fins>(), field<&R::free>());
  }
};

struct DeepInRange {
  Sequence<double> weights{};
  Sequence<Fin> fins{};
  static constexpr auto fields() {
    return describe(field<&DeepInRange::weights>().in(0, 1), field<&DeepInRange::fins>());
  }
};

struct Free {
  double number = 0;
  Eigen::Vector3d axis{0, 0, 1};
  static constexpr auto fields() { return describe(field<&Free::number>(), field<&Free::axis>()); }
};

bool is_looked_at(const Type& type) { return type.in_range != nullptr; }

bool is_good(const Ranged& value) { return type_of<Ranged>().in_range(&value); }

template <class Change>
bool is_good_with(Change&& change) {
  Ranged value;
  change(value);
  return is_good(value);
}

std::string problems_of(const std::string& text) {
  Ranged value;
  Problems problems;
  const Yaml yaml = read_yaml(std::make_shared<Source>(Source{"v.yaml", text}), problems);
  bind_fields(yaml, type_of<Ranged>(), &value, "value", "field", problems);
  std::string all;
  try {
    problems.throw_if_any();
  } catch (const SpecError& error) {
    for (const Problem& problem : error.problems()) {
      const std::string whole = to_text(problem);
      all += whole.substr(0, whole.find('\n') + 1);
    }
  }
  return all;
}
}  // namespace

TEST_SUITE("graph/values/ranges") {
  TEST_CASE("both ends of a range belong to it, and nothing beyond") {
    CHECK(is_good({}));
    CHECK(is_good_with([](Ranged& v) { v.angle = 0.5; }));
    CHECK(is_good_with([](Ranged& v) { v.angle = -0.5; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.angle = std::nextafter(0.5, 1); }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.angle = std::nextafter(-0.5, -1); }));
    // the float that is nearest to 0.1 is a little above it
    CHECK(is_good_with([](Ranged& v) { v.coarse = 0.1F; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.coarse = std::nextafter(0.1F, 1.0F); }));
    CHECK(is_good_with([](Ranged& v) { v.steps = -3; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.steps = -4; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.steps = 9; }));
    CHECK(is_good_with([](Ranged& v) { v.count = std::uint64_t{1} << 53; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.count = 0; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.count = std::numeric_limits<std::uint64_t>::max(); }));
    CHECK(is_good_with([](Ranged& v) { v.wait = 2s; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.wait = 2s + 1ns; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.wait = 1ms - 1ns; }));
    CHECK(is_good_with([](Ranged& v) { v.free = 1e300; }));
  }

  TEST_CASE("the range of an array, a vector or a sequence is that of each element, and a struct's hold within it") {
    CHECK_FALSE(is_good_with([](Ranged& v) { v.limits[1] = 1.5; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.axis.y() = -1.5; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.waits[1][0] = 2s; }));
    CHECK_FALSE(is_good_with([](Ranged& v) { v.fins[1].angle = 0.7; }));
    CHECK(is_good_with([](Ranged& v) { v.fins[1].angle = 0.6; }));

    const Type& deep = type_of<DeepInRange>();
    REQUIRE(is_looked_at(deep));
    DeepInRange value;
    value.weights.resize(3);
    value.fins.resize(2);
    CHECK(deep.in_range(&value));
    value.weights[2] = 1.25;
    CHECK_FALSE(deep.in_range(&value));
    value.weights[2] = 1;
    value.fins[1].angle = -0.7;
    CHECK_FALSE(deep.in_range(&value));
  }

  TEST_CASE("a type without ranges is never looked at") {
    CHECK_FALSE(is_looked_at(type_of<Free>()));
    CHECK(is_looked_at(type_of<Fin>()));
    CHECK_FALSE(type_of<Free>().fields[0].range.is_stated());
    CHECK(is_looked_at(*type_of<Ranged>().fields[8].type->element));
  }

  TEST_CASE("what a file states outside of a range is reported with its place and the range") {
    CHECK(problems_of("angle: 0.5\nfins: [{angle: -0.6}, {angle: 0.6}]\n") == "");
    CHECK(
        problems_of("angle: 40deg\n") ==
        "v.yaml:1:8: error: value field 'angle' needs a double [rad] from -0.5 to 0.5, not '40deg'; that is outside\n");
    CHECK(problems_of("coarse: 0.1\n") == "");
    CHECK(
        problems_of("coarse: 0.2\nsteps: 9\ncount: 0\nwait: 3s\nlimits: [0, -1.5]\nwaits: [[1s, 1s], [0s, 2s]]\n"
                    "fins: [{}, {angle: 1}]\n") ==
        "v.yaml:1:9: error: value field 'coarse' needs a float from 0 to 0.1, not '0.2'; that is outside\n"
        "v.yaml:2:8: error: value field 'steps' needs an int8 from -3 to 8, not '9'; that is outside\n"
        "v.yaml:3:8: error: value field 'count' needs a uint64 from 1 to 9007199254740992, not '0'; that is outside\n"
        "v.yaml:4:7: error: value field 'wait' needs a duration from 1ms to 2s, not '3s'; that is outside\n"
        "v.yaml:5:13: error: value field 'limits' element 1 needs a double from -1 to 1, not '-1.5'; that is outside\n"
        "v.yaml:6:24: error: value field 'waits' element 1 element 1 needs a duration from 0ns to 1s, not '2s'; that "
        "is outside\n"
        "v.yaml:7:20: error: value field 'fins' element 1 field 'angle' needs a double [rad] from -0.6 to 0.6, not "
        "'1'; that is outside\n");
    // what is no number at all is reported with the range, too
    CHECK(problems_of("angle: fast\n")
              .starts_with("v.yaml:1:8: error: value field 'angle' needs a double [rad] from "
                           "-0.5 to 0.5, not 'fast'"));
  }

  TEST_CASE("people read durations as durations, also in arrays of arrays") {
    const Type& type = type_of<Ranged>();
    CHECK(range_text(*type.fields[7].type, type.fields[7].range) == "from 0ns to 1s");
    CHECK(range_text(*type.fields[5].type, type.fields[5].range) == "from -1 to 1");
  }
}
