#include "distributers/links/udp.h"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <thread>

namespace {
using namespace jarol::distributers;

// Takes nothing before it is let go.
struct Held : ByteSink {
  std::atomic<bool> go{false};
  std::atomic<std::uint64_t> taken{0};
  bool take(std::span<const std::byte>, std::uint32_t) override {
    while (!go) std::this_thread::yield();
    ++taken;
    return true;
  }
  void begin_stream() override {}
};
}  // namespace

TEST_SUITE("distributers/links/udp") {
  TEST_CASE("datagrams that the system had no room for are counted, so that none is lost unseen") {
    UdpTransport transport(Address::parse("0"), {});
    transport.open();
    Interrupter interrupter;
    Held sink;
    std::thread receiving([&] { transport.receive(interrupter, sink); });

    const Descriptor sender(socket(AF_INET, SOCK_DGRAM, 0));
    const Address to = Address::parse(std::to_string(transport.port()));
    const auto send = [&](std::size_t bytes) {
      static const std::array<std::byte, 1000> zeros{};
      return sendto(sender.get(), zeros.data(), bytes, 0, to.get(), to.size());
    };
    // more than a system lets wait, however much that is
    std::uint64_t sent = 0;
    for (int i = 0; i < 100'000; ++i) sent += send(1000) == 1000 ? 1 : 0;
    sink.go = true;
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(100);
    while (transport.counts.overflown + sink.taken != sent && std::chrono::steady_clock::now() < patience) {
      sent += send(1) == 1 ? 1 : 0;  // brings the count along, once there is room for it
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    interrupter.interrupt();
    receiving.join();
    CHECK(transport.counts.overflown > 0);
    CHECK(transport.counts.overflown + sink.taken == sent);
  }
}
