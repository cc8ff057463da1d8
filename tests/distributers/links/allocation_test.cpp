// What a link does for each packet asks for no memory.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <thread>

#include "distributers/links/udp.h"
#include "tests/counted_allocations.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;

struct Counting : ByteSink {
  std::atomic<std::uint64_t> taken{0};
  bool take(std::span<const std::byte>, std::uint32_t) override { return ++taken, true; }
  void begin_stream() override {}
};
}  // namespace

TEST_SUITE("distributers/links/allocation") {
  TEST_CASE("what several peers and strangers send is looked at, and what they are sent goes out, without memory") {
    UdpTransport transport(Address::parse("0"), {}, {}, Ownership::default_silence, 3);
    transport.open();
    Interrupter interrupter;
    Counting sink;
    std::thread receiving([&] { transport.receive(interrupter, sink); });
    const Address to = Address::parse(std::to_string(transport.port()));
    std::array<Descriptor, 4> senders;  // the last is a stranger
    for (Descriptor& sender : senders) sender = Descriptor(socket(AF_INET, SOCK_DGRAM, 0));
    const std::array<std::byte, 100> zeros{};
    const auto converse = [&] {
      for (int round = 0; round < 100; ++round)
        for (const Descriptor& sender : senders) {
          const std::uint64_t before = sink.taken + transport.counts.strangers;
          REQUIRE(sendto(sender.get(), zeros.data(), zeros.size(), 0, to.get(), to.size()) == 100);
          while (sink.taken + transport.counts.strangers == before) std::this_thread::yield();
          transport.send(zeros);
        }
    };
    converse();
    const std::uint64_t before = tests::allocations();
    converse();
    CHECK(tests::allocations() == before);
    CHECK(transport.counts.connected == 3);
    CHECK(transport.counts.strangers == 200);
    CHECK(sink.taken == 600);
    interrupter.interrupt();
    receiving.join();
  }
}
