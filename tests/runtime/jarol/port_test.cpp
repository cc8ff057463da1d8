#include "runtime/jarol/port.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "tests/runtime/jarol/bytes_of.h"
#include "tests/runtime/model/port_program.h"
#include "tests/runtime/port_stress.h"

namespace {
using namespace jarol;

}  // namespace

TEST_SUITE("runtime/port") {
  TEST_CASE("values come out in the order in which they went in, and a full port refuses") {
    Port<int> port(2);
    CHECK(port.capacity() == 2);
    int value = -1;
    CHECK(!port.read(value));
    CHECK(value == -1);
    for (int round = 0; round < 5; ++round) {
      CHECK(port.write(10));
      CHECK(port.write(11));
      CHECK(!port.write(12));
      CHECK(port.read(value));
      CHECK(value == 10);
      CHECK(port.write(13));
      CHECK(port.read(value));
      CHECK(value == 11);
      CHECK(port.read(value));
      CHECK(value == 13);
      CHECK(!port.read(value));
    }
  }

  TEST_CASE("what is written is cloned") {
    std::array<char, 100> value{};
    value[99] = 'a';
    BytesPort port(1, value.size());
    CHECK(port.size() == 100);
    CHECK(port.write(value.data()));
    value[99] = 'b';
    CHECK(port.read(value.data()));
    CHECK(value[99] == 'a');
  }

  TEST_CASE("values without bytes are counted all the same") {
    BytesPort port(1, 0);
    char nothing = 0;
    CHECK(port.write(&nothing));
    CHECK(!port.write(&nothing));
    CHECK(port.read(&nothing));
    CHECK(!port.read(&nothing));
  }

  TEST_CASE("packets have any length up to the longest") {
    PacketPort port(3, 65536);
    std::vector<std::byte> room(65536);
    CHECK(port.longest() == 65536);
    CHECK(port.write(tests::bytes_of("")));
    CHECK(port.write(tests::bytes_of("abc")));
    CHECK(port.write(tests::bytes_of(std::string(65536, 'x'))));
    CHECK(!port.write(tests::bytes_of("full")));
    CHECK(port.read(room) == 0);
    CHECK(port.read(room) == 3);
    CHECK(std::memcmp(room.data(), "abc", 3) == 0);
    CHECK(port.read(room) == 65536);
    CHECK(room.back() == std::byte{'x'});
    CHECK(port.read(room) == std::nullopt);
    CHECK_THROWS_WITH_AS(port.write(tests::bytes_of(std::string(65537, 'x'))),
                         "a packet of 65537 bytes does not fit into a port for at most 65536", std::length_error);
    CHECK_THROWS_WITH_AS(port.read(std::span(room).first(100)),
                         "a room of 100 bytes is too small for packets of up to 65536", std::length_error);
  }

  TEST_CASE("a port holds at least one value, and no more than fits into memory") {
    CHECK_THROWS_WITH_AS(Port<int>(0), "a port holds at least one value", std::invalid_argument);
    CHECK_THROWS_WITH_AS(BytesPort(1, ~std::size_t{0}), "the slots of a port take more than a tebibyte",
                         std::length_error);
    CHECK_THROWS_WITH_AS(BytesPort(std::size_t{1} << 39, 1 << 20), "the slots of a port take more than a tebibyte",
                         std::length_error);
  }

  TEST_CASE("a writer and a reader in every interleaving" * doctest::skip(!model::available)) {
    using Explored = BasicPort<model::ModelMemory<>>;
    for (const std::size_t capacity : {1, 2, 3})
      for (const int before : {0, 2}) {
        CAPTURE(capacity);
        CAPTURE(before);
        const model::Result result = model::explore_port<Explored>(capacity, before, 5, 5);
        CHECK(result.failure == "");
        CHECK(result.states > 300);
      }
  }

  TEST_CASE("the interleavings find what is wrong without order in memory" * doctest::skip(!model::available)) {
    using Relaxed = BasicPort<model::ModelMemory<std::memory_order_relaxed>>;
    CHECK(model::explore_port<Relaxed>(1, 0, 2, 2).failure.starts_with("data race\n  thread 1 "));
  }

  TEST_CASE("two threads, many values") {
    for (const std::size_t capacity : {1, 2, 64}) {
      CAPTURE(capacity);
      CHECK(tests::stress<Port<tests::Checked>>(capacity) == "");
    }
  }

  TEST_CASE("two threads, packets of all lengths") { CHECK(tests::stress_packets<PacketPort>(8) == ""); }
}
