// What was sent before a stream is closed arrives, though its peer goes on speaking and is slow to read.
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <thread>

#include "distributers/links/tcp.h"

namespace {
using namespace jarol::distributers;
using namespace std::chrono_literals;

struct NoSink : ByteSink {
  bool take(std::span<const std::byte>, std::uint32_t) override { return true; }
  void begin_stream() override {}
};

// What comes until the stream ends or breaks off, while it speaks on.
std::size_t read_to_end(const Descriptor& stream) {
  std::array<std::byte, 4096> room{};
  std::size_t sum = 0;
  for (ssize_t length = 1; length > 0; sum += static_cast<std::size_t>(std::max<ssize_t>(length, 0))) {
    send(stream.get(), room.data(), 16, MSG_NOSIGNAL | MSG_DONTWAIT);
    pollfd polled{stream.get(), POLLIN, 0};
    poll(&polled, 1, 20'000);
    length = recv(stream.get(), room.data(), room.size(), MSG_DONTWAIT);
  }
  return sum;
}

TEST_SUITE("distributers/links/stream_close") {
  TEST_CASE("what was sent before the close arrives whole at a peer that speaks on") {
    const Descriptor listening = listen_at(Address::parse("127.0.0.1:0"), 1);
    TcpClient transport(Address::parse("127.0.0.1:0").with_port(port_of(listening)));
    transport.open();
    NoSink sink;
    Interrupter interrupter;
    std::thread receiver([&] { transport.receive(interrupter, sink); });
    pollfd polled{listening.get(), POLLIN, 0};
    REQUIRE(poll(&polled, 1, 20'000) == 1);
    const Descriptor peer = accept_from(listening);
    while (transport.counts.connected == 0) std::this_thread::sleep_for(1ms);
    constexpr std::size_t packets = 300;
    const std::array<std::byte, 1000> packet{};
    for (std::size_t i = 0; i < packets; ++i) REQUIRE(transport.send(packet));
    interrupter.interrupt();
    receiver.join();
    std::size_t came = 0;
    std::thread reader([&] { came = read_to_end(peer); });
    transport.close();
    reader.join();
    CHECK(came == packets * packet.size());
  }
}
}  // namespace
