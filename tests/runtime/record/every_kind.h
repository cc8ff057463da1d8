// A value with members of every kind, for tests of what is written and read.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "graph/values/seed.h"
#include "graph/values/type_of.h"

namespace jarol::tests {

enum class Colour : std::int16_t { red = -1, green = 0, blue = 300 };

constexpr std::array<Enumerator<Colour>, 3> enumerators(Colour) {
  return {{{"red", Colour::red}, {"green", Colour::green}, {"blue", Colour::blue}}};
}

struct Point {
  float x = 0;
  std::int64_t n = 0;
  static constexpr auto fields() { return describe(field<&Point::x>("m"), field<&Point::n>()); }
};

struct Named {
  String name{};
  Sequence<Point> points{};
  static constexpr auto fields() { return describe(field<&Named::name>(), field<&Named::points>()); }
};

struct EveryKind {
  bool on = false;
  std::int8_t a = 0;
  std::uint64_t b = 0;
  std::uint16_t c = 0;
  double d = 0;
  Colour colour = Colour::red;
  Duration time{};
  std::array<Point, 2> corners{};
  std::array<std::array<float, 3>, 2> grid{};
  String text{};
  Sequence<double> numbers{};
  Sequence<bool> bits{};
  Sequence<Named> names{};
  Sequence<Sequence<std::uint16_t>> lists{};
  std::array<String, 2> words{};
  std::uint8_t last = 0;

  static constexpr auto fields() {
    return describe(field<&EveryKind::on>(), field<&EveryKind::a>(), field<&EveryKind::b>(), field<&EveryKind::c>(),
                    field<&EveryKind::d>("m/s"), field<&EveryKind::colour>(), field<&EveryKind::time>(),
                    field<&EveryKind::corners>(), field<&EveryKind::grid>(), field<&EveryKind::text>(),
                    field<&EveryKind::numbers>(), field<&EveryKind::bits>(), field<&EveryKind::names>(),
                    field<&EveryKind::lists>(), field<&EveryKind::words>(), field<&EveryKind::last>());
  }
};

inline EveryKind random_every_kind(std::uint64_t seed) {
  std::uint64_t next = 0;
  const auto random = [&] { return spread_seed(seed, std::to_string(next++)); };
  const auto length = [&] { return random() % 5; };
  const auto number = [&] { return std::bit_cast<double>((random() & 0xbfffffffffffffff) | 1); };  // finite
  const auto text = [&] {
    std::string made;
    for (std::uint64_t n = length(); n > 0; --n) made += static_cast<char>(random());
    return String(made);
  };
  EveryKind v;
  v.on = random() % 2 == 0;
  v.a = static_cast<std::int8_t>(random());
  v.b = random();
  v.c = static_cast<std::uint16_t>(random());
  v.d = number();
  v.colour = std::array{Colour::red, Colour::green, Colour::blue}[random() % 3];
  v.time = Duration(static_cast<std::int64_t>(random()));
  const auto point = [&] {
    return Point{static_cast<float>(random() % 1000) / 7, static_cast<std::int64_t>(random())};
  };
  for (Point& p : v.corners) p = point();
  for (auto& row : v.grid)
    for (float& x : row) x = static_cast<float>(random() % 1000) / 3;
  v.text = text();
  for (std::uint64_t n = length(); n > 0; --n) v.numbers.push_back(number());
  for (std::uint64_t n = length(); n > 0; --n) v.bits.push_back(random() % 2 == 0);
  for (std::uint64_t n = length(); n > 0; --n) {
    Named named;
    named.name = text();
    for (std::uint64_t m = length(); m > 0; --m) named.points.push_back(point());
    v.names.push_back(named);
  }
  for (std::uint64_t n = length(); n > 0; --n) {
    Sequence<std::uint16_t> list;
    for (std::uint64_t m = length(); m > 0; --m) list.push_back(static_cast<std::uint16_t>(random()));
    v.lists.push_back(list);
  }
  for (String& word : v.words) word = text();
  v.last = static_cast<std::uint8_t>(random());
  return v;
}

}  // namespace jarol::tests
