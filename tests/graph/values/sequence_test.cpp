#include "graph/values/sequence.h"

#include <doctest/doctest.h>

#include "graph/values/bind.h"
#include "graph/values/pack.h"
#include "graph/values/type_of.h"
#include "graph/values/value.h"

namespace {
using namespace jarol;

struct Leg {
  double length = 0;
  String name{};
  static constexpr auto fields() { return describe(field<&Leg::length>("m"), field<&Leg::name>()); }
};

struct Route {
  std::uint32_t id = 0;
  Sequence<Leg> legs{};
  std::array<Sequence<std::uint8_t>, 2> marks{};
  static constexpr auto fields() {
    return describe(field<&Route::id>(), field<&Route::legs>(), field<&Route::marks>());
  }
};

struct Flat {
  double number = 1;
  static constexpr auto fields() { return describe(field<&Flat::number>()); }
};

Route example() {
  Route route;
  route.id = 3;
  route.legs = {Leg{1.5, "out"}, Leg{2.5, "a name longer than any small buffer would hold"}};
  route.marks[1] = {7, 8, 9};
  return route;
}

std::string text_of(const Value& value) {
  std::string text;
  for (const Leaf& leaf : leaves_of(*value.type()))
    text += (text.empty() ? "" : " ") + leaf.path + "=" +
            scalar_text(*leaf.type, static_cast<const std::byte*>(value.data()) + leaf.offset);
  return text;
}
}  // namespace

TEST_SUITE("graph/values/sequence") {
  TEST_CASE("a type knows whether it is deep") {
    CHECK(type_of<Route>().is_deep());
    CHECK(type_of<Leg>().is_deep());
    CHECK_FALSE(type_of<Flat>().is_deep());
    CHECK(type_of<Route>().fields[1].type->name == "Leg[]");
    CHECK(type_of<Route>().fields[2].type->name == "uint8[][2]");
    CHECK(type_of<Leg>().fields[1].type->name == "string");
  }

  TEST_CASE("an assignment is a deep copy that keeps the room of its owner") {
    Sequence<double> a{1, 2, 3};
    Sequence<double> b;
    b = a;
    a[0] = 7;
    CHECK(b == Sequence<double>{1, 2, 3});
    b = Sequence<double>{4, 5};
    CHECK(b == Sequence<double>{4, 5});
    b = a;
    std::vector<char> region(1024);
    PrivateHeap heap(reinterpret_cast<std::byte*>(region.data()), region.size());
    Sequence<double> owned;
    owned.adopt(heap.values());
    owned = a;
    const double* const before = owned.data();
    owned = Sequence<double>{8, 9};  // from other memory: copied
    CHECK(owned.data() == before);
    CHECK(owned == Sequence<double>{8, 9});
  }

  TEST_CASE("all that a vector does") {
    Sequence<String> s;
    for (int i = 0; i < 100; ++i) s.push_back(std::to_string(i).c_str());
    s.push_back(s[3]);
    CHECK(s.size() == 101);
    CHECK(s.back() == "3");
    CHECK(s.front() == "0");
    s.resize(50);
    CHECK(s.back() == "49");
    s.resize(52);
    CHECK(s.back().empty());
    s.pop_back();
    s.clear();
    CHECK(s.empty());
    CHECK_THROWS_WITH_AS(s.at(0), "element 0 of a sequence of 0", std::out_of_range);
    String t = "abc";
    t += t;
    t += "!";
    CHECK(t == "abcabc!");
  }

  TEST_CASE("elements of a private heap's sequence live in that heap too") {
    std::vector<char> region(4096);
    PrivateHeap heap(reinterpret_cast<std::byte*>(region.data()), region.size());
    {
      Route route;
      type_of<Route>().adopt(&route, heap.values());
      route = example();
      const auto inside = [&](const void* p) { return p >= region.data() && p < region.data() + region.size(); };
      CHECK(inside(route.legs.data()));
      CHECK(inside(route.legs[1].name.view().data()));
      CHECK(inside(route.marks[1].data()));
      route.legs.push_back({3, "a third leg with a name of some length"});
      CHECK(inside(route.legs[2].name.view().data()));
    }
  }

  TEST_CASE("changing sizes settle within a heap") {
    std::vector<char> region(16 << 10);
    PrivateHeap heap(reinterpret_cast<std::byte*>(region.data()), region.size());
    Route route;
    type_of<Route>().adopt(&route, heap.values());
    std::uint64_t random = 1;
    for (int i = 0; i < 100'000; ++i) {
      random = random * 6364136223846793005U + 1442695040888963407U;
      const std::size_t legs = (random >> 33) % 9;
      route.legs.resize(legs);
      for (Leg& leg : route.legs) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        leg.name = std::string_view("a name of up to sixty-four letters, of which the first are taken")
                       .substr(0, (random >> 33) % 65);
      }
    }
    CHECK(heap.max_used() < region.size());
    type_of<Route>().destroy(&route);
    new (&route) Route();
  }

  TEST_CASE("a deep value is copied, packed, unpacked and shown whole") {
    const Route route = example();
    Value value(type_of<Route>());
    copy_value(*value.type(), value.data(), &route);
    const std::string shown =
        R"(id=3 legs=[{length:1.5,name:"out"},{length:2.5,name:"a name longer than any small buffer would hold"}])"
        " marks.0=[] marks.1=[7,8,9]";
    CHECK(text_of(value) == shown);
    const Value copy(value);
    CHECK(text_of(copy) == shown);
    std::vector<std::byte> packed(packed_size(*value.type(), value.data()));
    CHECK(packed.size() == 4 + 8 + (8 + 8 + 3) + (8 + 8 + 46) + 8 + 8 + 3);
    CHECK(pack(*value.type(), value.data(), packed.data()) == packed.data() + packed.size());
    Value read(type_of<Route>());
    CHECK(unpack(*read.type(), packed.data(), read.data()) == packed.data() + packed.size());
    CHECK(text_of(read) == shown);
  }

  TEST_CASE("a deep value is bound from lists and texts, and each bad part is reported") {
    const auto bind_text = [](const std::string& text, Value& value) -> std::string {
      Problems problems;
      const Yaml yaml = read_yaml(std::make_shared<Source>(Source{"v.yaml", text}), problems);
      bind_fields(yaml, *value.type(), value.data(), "value", "field", problems);
      try {
        problems.throw_if_any();
      } catch (const SpecError& error) { return error.what(); }
      return "";
    };
    Value value(type_of<Route>());
    CHECK(bind_text("{id: 4, legs: [{length: 2cm, name: a \"b\"}, {name: \"7\"}], marks: [[1], []]}", value) == "");
    CHECK(text_of(value) == R"(id=4 legs=[{length:0.02,name:"a \"b\""},{length:0,name:"7"}] marks.0=[1] marks.1=[])");
    CHECK(bind_text("{legs: 3, marks: [[256], [1]]}", value) ==
          "v.yaml:1:8: error: value field 'legs' needs a list of elements of type Leg, not a scalar\n"
          "  {legs: 3, marks: [[256], [1]]}\n"
          "         ^\n"
          "v.yaml:1:20: error: value field 'marks' element 0 element 0 needs a uint8, not '256'; that is not from 0 to "
          "255\n"
          "  {legs: 3, marks: [[256], [1]]}\n"
          "                     ^");
  }

  TEST_CASE("the digest takes a sequence after its length, and a string's bytes packed eight to a word") {
    digest::Words words;
    for (const std::uint64_t w : {3ULL, 2ULL, 0x3ff8000000000000ULL, 3ULL, 0x74756fULL, 0x4004000000000000ULL, 46ULL})
      words.add(w);
    const std::string_view name = "a name longer than any small buffer would hold";
    for (std::size_t i = 0; i < name.size(); i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, name.data() + i, std::min<std::size_t>(8, name.size() - i));
      words.add(word);
    }
    for (const std::uint64_t w : {0ULL, 3ULL, 7ULL, 8ULL, 9ULL}) words.add(w);
    const Route route = example();
    CHECK(type_of<Route>().hash_words(&route) == words.sum());
  }

  TEST_CASE("a number that is not finite is found at any depth") {
    Route route = example();
    CHECK(type_of<Route>().finite(&route));
    route.legs[1].length = std::numeric_limits<double>::infinity();
    CHECK_FALSE(type_of<Route>().finite(&route));
  }
}
