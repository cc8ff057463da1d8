// What is saved is restored bit by bit, by the same function; what is no such state is refused.
#include "graph/values/archive.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "graph/values/heap_archive.h"
#include "graph/values/type_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Deep {
  Sequence<String> names{};
  std::array<Sequence<double>, 2> numbers{};
  double number = 0;
  bool flag = false;

  static constexpr auto fields() {
    return describe(field<&Deep::names>(), field<&Deep::numbers>(), field<&Deep::number>(), field<&Deep::flag>());
  }
};

enum class Colour : std::uint8_t { red, green };

// One of each that an archive takes.
struct Everything {
  bool flag = false;
  std::int8_t small = 0;
  double number = 0;
  Colour colour = Colour::red;
  Duration duration{};
  std::string text;
  std::array<float, 2> both{};
  std::vector<std::string> texts;
  std::vector<bool> flags;
  std::optional<std::pair<Duration, double>> maybe;
  Deep deep{};

  void serialize(Archive& archive) {
    archive(flag, small, number, colour, duration, text, both, texts, flags, maybe, deep);
  }
};

template <class T>
Archive::Bytes saved(T& state) {
  Archive::Bytes bytes;
  Archive archive = Archive::to(bytes);
  archive(state);
  return bytes;
}

template <class T>
void restore(T& state, const Archive::Bytes& bytes) {
  Archive archive = Archive::from(bytes);
  archive(state);
  archive.require_end();
}

Everything some() {
  Everything one;
  one.flag = true;
  one.small = -7;
  one.number = std::bit_cast<double>(0x7ff8000000abcdefULL);  // a NaN with a payload
  one.colour = Colour::green;
  one.duration = 5s;
  one.text = "text";
  one.both = {-0.0F, std::numeric_limits<float>::denorm_min()};
  one.texts = {"", "a", std::string("\0b", 2)};
  one.flags = {true, false, true};
  one.maybe = {7ns, 1.5};
  one.deep.names = {"x", ""};
  one.deep.numbers[1] = {1, -0.0};
  return one;
}

// A heap with values in it, as a task has: they are not destroyed, they go with the heap.
template <class T>
struct OwnedBy {
  explicit OwnedBy(std::size_t bytes) : region(bytes / 16), heap(reinterpret_cast<std::byte*>(region.data()), bytes) {
    detail::adopt(value, heap.values());
  }
  struct alignas(16) Line {
    std::byte bytes[16];
  };
  std::vector<Line> region;
  PrivateHeap heap;
  alignas(T) std::byte memory[sizeof(T)];
  T& value = *new (memory) T{};

  void serialize(Archive& archive) {
    HeapArchive values(archive, heap);
    values.value(type_of<T>(), &value);
    values.finish();
  }
};
using Owned = OwnedBy<Deep>;
using Switches = OwnedBy<Sequence<bool>>;

// What it does next: where its blocks come from, and when there is none left.
std::string grow(Owned& owned) {
  std::string places;
  try {
    for (int i = 0;; ++i) {
      owned.value.names.push_back(String(std::string(static_cast<std::size_t>(i) * 7 % 60, 'n')));
      if (i % 3 == 0) owned.value.names.resize(owned.value.names.size() / 2);
      owned.value.numbers[0].push_back(i);
      places += std::to_string(owned.heap.place_of(owned.value.names.data())) + " ";
    }
  } catch (const HeapExhausted& error) { return places + error.what(); }
}

}  // namespace

TEST_SUITE("graph/archive") {
  TEST_CASE("what is saved is restored bit by bit") {
    Everything one = some(), two;
    const Archive::Bytes bytes = saved(one);
    two.deep.names = {"forgotten"};
    two.texts.resize(9);
    restore(two, bytes);
    CHECK(saved(two) == bytes);
    CHECK(std::bit_cast<std::uint64_t>(two.number) == 0x7ff8000000abcdefULL);
    CHECK(two.texts == one.texts);
    CHECK(two.deep.names == one.deep.names);
    CHECK(two.maybe == one.maybe);
    CHECK(saved(one) == bytes);
  }

  TEST_CASE("bytes that end early, go on, or have impossible lengths and flags are refused") {
    Everything one = some();
    const Archive::Bytes good = saved(one);
    for (std::size_t size = 0; size < good.size(); ++size) {
      Everything two;
      CHECK_THROWS_AS(restore(two, Archive::Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))),
                      ArchiveError);
    }
    Everything two;
    Archive::Bytes bytes = good;
    bytes.emplace_back();
    CHECK_THROWS_WITH_AS(restore(two, bytes), "goes on after its state", ArchiveError);
    bytes = good;
    bytes[0] = std::byte{2};
    CHECK_THROWS_WITH_AS(restore(two, bytes), "has another byte where true or false stand", ArchiveError);
    std::vector<std::uint64_t> numbers{1, 2};
    bytes = saved(numbers);
    bytes[7] = std::byte{0x7f};
    CHECK_THROWS_WITH_AS(restore(numbers, bytes), "has more elements than bytes", ArchiveError);
    Deep deep;
    bytes = saved(deep);
    bytes.back() = std::byte{3};
    CHECK_THROWS_WITH_AS(restore(deep, bytes), "has a Deep that has 3 where true or false stand", ArchiveError);
  }

  TEST_CASE("what could not be restored is not saved") {
    const auto make_wrong = [](bool& flag) { std::memset(&flag, 7, 1); };
    Deep deep;
    make_wrong(deep.flag);
    CHECK_THROWS_WITH_AS(saved(deep), "a Deep has 7 where true or false stand", NotSaveable);
    Switches switches(256);
    switches.value.resize(3);
    saved(switches);
    make_wrong(switches.value[2]);
    CHECK_THROWS_WITH_AS(saved(switches), "a bool has 7 where true or false stand", NotSaveable);
  }

  TEST_CASE("a heap goes on as it would have, with the blocks that were free, in another place") {
    for (int rounds = 0; rounds < 12; ++rounds) {
      CAPTURE(rounds);
      Owned one(2048), two(2048);
      for (int i = 0; i < rounds * 3; ++i) {
        one.value.names.push_back(String(std::string(static_cast<std::size_t>(i) * 11 % 50, 'x')));
        if (i % 4 == 0) one.value.names.resize(static_cast<std::size_t>(i) / 4);
        one.value.numbers[static_cast<std::size_t>(i) % 2].push_back(i);
      }
      if (rounds % 2 == 0) grow(two);  // what was there before is forgotten
      const Archive::Bytes bytes = saved(one);
      restore(two, bytes);
      CHECK(saved(two) == bytes);
      CHECK(two.value.names == one.value.names);
      CHECK(two.heap.max_used() == one.heap.max_used());
      const std::string should = grow(one);
      CHECK(grow(two) == should);
    }
  }

  TEST_CASE("values of a heap that lie beyond it, or in one place, are refused") {
    Owned one(256);
    one.value.names = {"a name of some length"};
    one.value.numbers[0] = {1, 2, 3, 4};
    const Archive::Bytes good = saved(one);
    std::uint64_t beyond = 0, twice = 0, restored = 0;
    for (std::size_t at = 0; at < good.size(); ++at)
      for (const int byte : {0, 1, 2, 8, 16, 32, 48, 64, 255}) {
        Archive::Bytes bytes = good;
        bytes[at] = std::byte(byte);
        Owned two(256);
        try {
          restore(two, bytes);
          grow(two);
          ++restored;
        } catch (const ArchiveError& error) {
          beyond += std::string(error.what()) == "has a sequence beyond its heap" ? 1 : 0;
          twice += std::string(error.what()) == "has two values in one place" ? 1 : 0;
        }
      }
    CHECK(beyond > 10);
    CHECK(twice > 3);
    CHECK(restored > 100);
    Owned small(64);
    CHECK_THROWS_WITH_AS(restore(small, good), "has a heap too large", ArchiveError);
  }
}
