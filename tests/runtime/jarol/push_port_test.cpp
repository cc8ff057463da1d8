#include "runtime/jarol/push_port.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/how_many.h"
#include "tests/runtime/jarol/bytes_of.h"
#include "tests/runtime/model/port_program.h"
#include "tests/runtime/port_stress.h"

namespace {
using namespace jarol;

}  // namespace

TEST_SUITE("runtime/push_port") {
  TEST_CASE("the newest values are there, oldest first, however many were written") {
    for (const std::size_t capacity : {1, 2, 3, 7})
      for (int count = 0; count < 40; ++count) {
        CAPTURE(capacity);
        CAPTURE(count);
        PushPort<int> port(capacity);
        for (int i = 0; i < count; ++i) port.write(i);
        int value = -1;
        const int kept = std::min(count, static_cast<int>(capacity));
        for (int i = count - kept; i < count; ++i) {
          REQUIRE(port.read(value));
          REQUIRE(value == i);
        }
        REQUIRE(!port.read(value));
        REQUIRE(port.lost() == static_cast<std::uint64_t>(count - kept));
      }
  }

  TEST_CASE("a reader that fell behind goes on with the oldest that is left") {
    PushPort<int> port(2);
    int value = -1;
    port.write(1);
    CHECK(port.read(value));
    CHECK(value == 1);
    for (int i = 2; i < 10; ++i) port.write(i);
    CHECK(port.read(value));
    CHECK(value == 8);
    port.write(10);
    port.write(11);
    CHECK(port.read(value));
    CHECK(value == 10);
    CHECK(port.lost() == 7);
  }

  TEST_CASE("values of any size") {
    for (std::size_t size = 0; size < 40; ++size) {
      CAPTURE(size);
      PushBytesPort port(2, size);
      std::string in(size, '\0'), out(size + 1, '?');
      for (std::size_t i = 0; i < size; ++i) in[i] = static_cast<char>('a' + i % 26);
      port.write(in.data());
      CHECK(port.read(out.data()));
      CHECK(out == in + "?");
    }
  }

  TEST_CASE("packets have any length up to the longest") {
    PushPacketPort port(2, 65536);
    std::vector<std::byte> room(65536);
    port.write(tests::bytes_of("gone"));
    CHECK(port.write(tests::bytes_of(std::string(65536, 'x'))));
    CHECK(port.write(tests::bytes_of("abc")));
    CHECK(port.read(room) == 65536);
    CHECK(room.back() == std::byte{'x'});
    CHECK(port.read(room) == 3);
    CHECK(std::memcmp(room.data(), "abc", 3) == 0);
    CHECK(port.read(room) == std::nullopt);
    CHECK(port.lost() == 1);
  }

  TEST_CASE("a push port holds at least one value") {
    CHECK_THROWS_WITH_AS(PushPort<int>(0), "a push port holds at least one value", std::invalid_argument);
    CHECK_THROWS_WITH_AS(PushPort<int>(~std::size_t{0}), "the slots of a port take more than a tebibyte",
                         std::length_error);
  }

  TEST_CASE("a writer and a reader in every interleaving" * doctest::skip(!model::available)) {
    using Explored = BasicPushPort<model::ModelMemory<>>;
    const bool full = tests::is_full();
    for (const int capacity : {1, 2, 3})
      for (const int before : {0, capacity, capacity + 1}) {
        CAPTURE(capacity);
        CAPTURE(before);
        const model::Result result =
            model::explore_port<Explored>(static_cast<std::size_t>(capacity), before, full ? 5 : 3, full ? 4 : 3);
        CHECK(result.failure == "");
        CHECK(result.states > 300);
      }
  }

  TEST_CASE("the interleavings find what is wrong without order in memory" * doctest::skip(!model::available)) {
    using Relaxed = BasicPushPort<model::ModelMemory<std::memory_order_relaxed>>;
    CHECK(model::explore_port<Relaxed>(1, 0, 2, 2).failure.starts_with("torn\n  thread 1 "));
  }

  TEST_CASE("two threads, many values") {
    for (const std::size_t capacity : {1, 2, 64}) {
      CAPTURE(capacity);
      CHECK(tests::stress<PushPort<tests::Checked>>(capacity) == "");
    }
  }

  TEST_CASE("two threads, packets of all lengths") { CHECK(tests::stress_packets<PushPacketPort>(8) == ""); }
}
