#include <doctest/doctest.h>

#include <Eigen/Core>
#include <limits>

#include "graph/values/bind.h"
#include "graph/values/type_of.h"
#include "graph/values/value.h"

namespace {
using namespace jarol;

enum class Mode : std::int8_t { off, on };
constexpr auto enumerators(Mode) {
  return std::array{Enumerator<Mode>{"off", Mode::off}, Enumerator<Mode>{"on", Mode::on}};
}

struct Inner {
  float depth = 0.5F;
  Mode mode = Mode::on;
  static constexpr auto fields() {
    return describe(field<&Inner::depth>("m", "below the surface"), field<&Inner::mode>());
  }
};

struct Outer {
  double angle = 0;
  Eigen::Vector3d position{1, 2, 3};
  std::array<Inner, 2> inner{};
  Duration time{};
  static constexpr auto fields() {
    return describe(field<&Outer::angle>("rad"), field<&Outer::position>("m"), field<&Outer::inner>(),
                    field<&Outer::time>());
  }
};

struct Reals {
  double angle = 0;
  Eigen::Vector3d position{};
  std::array<std::array<double, 2>, 2> more{};
  static constexpr auto fields() {
    return describe(field<&Reals::angle>(), field<&Reals::position>(), field<&Reals::more>());
  }
};

struct Padded {
  float first = 0;
  double second = 0;
  static constexpr auto fields() { return describe(field<&Padded::first>(), field<&Padded::second>()); }
};

struct Floats {
  float first = 0, second = 0;
  static constexpr auto fields() { return describe(field<&Floats::first>(), field<&Floats::second>()); }
};

struct Counted {
  double number = 0;
  std::int64_t count = 0;
  static constexpr auto fields() { return describe(field<&Counted::number>(), field<&Counted::count>()); }
};

// What a destructor has to free stands before what is read by its offset.
struct Named {
  String name{};
  Sequence<float> weights{};
  std::int16_t level = 0;
  static constexpr auto fields() {
    return describe(field<&Named::name>(), field<&Named::weights>(), field<&Named::level>("", "of it").in(-3, 3));
  }
};

struct Nothing {
  static constexpr auto fields() { return describe(); }
};

// Binds a text into the value and returns the report.
std::string bind_text(const std::string& text, Outer& value) {
  Problems problems;
  const Yaml yaml = read_yaml(std::make_shared<Source>(Source{"v.yaml", text}), problems);
  bind_fields(yaml, type_of<Outer>(), &value, "value", "field", problems);
  try {
    problems.throw_if_any();
  } catch (const SpecError& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("graph/values/type") {
  TEST_CASE("a type knows its fields by the names of the members") {
    const Type& type = type_of<Outer>();
    CHECK(type.name == "Outer");
    REQUIRE(type.fields.size() == 4);
    CHECK(type.fields[0].name == "angle");
    CHECK(type.fields[0].unit == "rad");
    CHECK(type.fields[1].type->name == "double[3]");
    CHECK(type.fields[2].type->name == "Inner[2]");
    CHECK(type.fields[2].type->element->fields[0].text == "below the surface");
    CHECK(type.fields[3].type->name == "duration");
    CHECK(type.fields[1].offset == offsetof(Outer, position));
  }

  TEST_CASE("a field is found behind texts and sequences, with its range") {
    const Type& type = type_of<Named>();
    REQUIRE(type.fields.size() == 3);
    CHECK(type.fields[0].offset == 0);
    CHECK(type.fields[1].offset == offsetof(Named, weights));
    CHECK(type.fields[2].offset == offsetof(Named, level));
    CHECK(type.fields[2].text == "of it");
    CHECK(type.fields[2].type == &type_of<std::int16_t>());
    CHECK(type.fields[2].range.has(-3));
    CHECK_FALSE(type.fields[2].range.has(3.5));
    CHECK_FALSE(type.fields[1].range.is_stated());
  }

  TEST_CASE("the scalars of a type have paths") {
    std::string paths;
    for (const Leaf& leaf : leaves_of(type_of<Outer>())) paths += leaf.path + " ";
    CHECK(paths ==
          "angle position.0 position.1 position.2 inner.0.depth inner.0.mode inner.1.depth inner.1.mode time ");
  }

  TEST_CASE("a value begins as its struct's default") {
    const Value value(type_of<Outer>());
    const auto& outer = *static_cast<const Outer*>(value.data());
    CHECK(outer.position == Eigen::Vector3d(1, 2, 3));
    CHECK(outer.inner[1].depth == 0.5F);
  }

  TEST_CASE("YAML overwrites what it mentions and leaves the rest") {
    Outer value;
    CHECK(bind_text("{angle: 90deg, position: [4, 5cm, 6 m], inner: [{depth: 3}, {mode: off}], time: 2ms}", value) ==
          "");
    CHECK(value.angle == doctest::Approx(1.5707963267948966).scale(0).epsilon(1e-15));
    CHECK(value.position == Eigen::Vector3d(4, 0.05, 6));
    CHECK(value.inner[0].depth == 3.0F);
    CHECK(value.inner[0].mode == Mode::on);
    CHECK(value.inner[1].mode == Mode::off);
    CHECK(value.time == std::chrono::milliseconds(2));
  }

  TEST_CASE("all that does not fit is reported with its place and what would be right") {
    Outer value;
    CHECK(bind_text("angel: 1\nposition: [1, 2]\ninner: [{depth: deep}, {mode: auto}]\ntime: 5\n", value) ==
          "v.yaml:1:1: error: value has no field 'angel'; did you mean 'angle'?; it has: angle, position, inner, time\n"
          "  angel: 1\n"
          "  ^\n"
          "v.yaml:2:11: error: value field 'position' has 2 elements; it needs 3\n"
          "  position: [1, 2]\n"
          "            ^\n"
          "v.yaml:3:17: error: value field 'inner' element 0 field 'depth' needs a float [m], not 'deep'; that is not "
          "a number\n"
          "  inner: [{depth: deep}, {mode: auto}]\n"
          "                  ^\n"
          "v.yaml:3:31: error: value field 'inner' element 1 field 'mode' needs one of off, on, not 'auto'; that is "
          "none of them\n"
          "  inner: [{depth: deep}, {mode: auto}]\n"
          "                                ^\n"
          "v.yaml:4:7: error: value field 'time' needs a duration, not '5'; that has no unit; write one of h, min, s, "
          "ms, us or ns, as in 10ms\n"
          "  time: 5\n"
          "        ^");
  }

  TEST_CASE("what no double, float or struct can be is reported with the reason") {
    Outer value;
    CHECK(bind_text("angle: 1e308 mrad\ninner: [{depth: -1e39}, {}]\n", value) ==
          "v.yaml:2:17: error: value field 'inner' element 0 field 'depth' needs a float [m], not '-1e39'; that is "
          "beyond what a float holds\n"
          "  inner: [{depth: -1e39}, {}]\n"
          "                  ^");
    CHECK(bind_text("3", value) ==
          "v.yaml:1:1: error: value needs a mapping of its fields, not a scalar\n"
          "  3\n"
          "  ^");
    CHECK(parse_scalar(type_of<Outer>(), "3", "", &value) == "is a single word");
  }

  TEST_CASE("what is made of doubles and nothing else is known: a float, a count or a gap among them and it is not") {
    for (const Type* type : {&type_of<double>(), &type_of<Eigen::Vector3d>(), &type_of<std::array<double, 1>>(),
                             &type_of<Reals>(), &type_of<std::array<Reals, 2>>()}) {
      CAPTURE(type->name);
      CHECK(is_made_of_doubles(*type));
    }
    for (const Type* type : {&type_of<float>(), &type_of<Floats>(), &type_of<Padded>(), &type_of<Counted>(),
                             &type_of<std::int64_t>(), &type_of<Duration>(), &type_of<Outer>(),
                             &type_of<std::array<float, 2>>(), &type_of<Sequence<double>>(), &type_of<Nothing>()}) {
      CAPTURE(type->name);
      CHECK_FALSE(is_made_of_doubles(*type));
    }
  }

  TEST_CASE("what may be an infinity or a NaN is known") {
    for (const Type* type : {&type_of<float>(), &type_of<Reals>(), &type_of<Counted>(), &type_of<Outer>(),
                             &type_of<Sequence<double>>(), &type_of<std::array<Inner, 2>>()}) {
      CAPTURE(type->name);
      CHECK(has_floating(*type));
    }
    for (const Type* type : {&type_of<bool>(), &type_of<std::int64_t>(), &type_of<Mode>(), &type_of<Duration>(),
                             &type_of<String>(), &type_of<Nothing>(), &type_of<std::array<std::int32_t, 2>>()}) {
      CAPTURE(type->name);
      CHECK_FALSE(has_floating(*type));
    }
  }

  TEST_CASE("infinities and NaN anywhere in a value are found") {
    Outer value;
    const Type& type = type_of<Outer>();
    CHECK(type.finite(&value));
    value.inner[1].depth = std::numeric_limits<float>::infinity();
    CHECK_FALSE(type.finite(&value));
    value.inner[1].depth = 0;
    value.position[2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(type.finite(&value));
    value.position[2] = std::numeric_limits<double>::max();
    CHECK(type.finite(&value));
  }

  TEST_CASE("each of few and of many doubles is looked at, and only what is none is found") {
    const auto look = [&]<std::size_t... Count>(std::index_sequence<Count...>) {
      const auto at_each_place = [&]<std::size_t N>(std::array<double, N> value) {
        const Type& type = type_of<std::array<double, N>>();
        for (double& number : value)
          for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()}) {
            CAPTURE(N);
            CAPTURE(&number - value.data());
            number = bad;
            CHECK_FALSE(type.finite(&value));
            number = -std::numeric_limits<double>::max();
            CHECK(type.finite(&value));
          }
      };
      (at_each_place(std::array<double, Count + 1>{}), ...);
    };
    look(std::make_index_sequence<9>());
  }
}
