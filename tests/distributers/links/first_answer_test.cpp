// Who answers a peer's first packet at once, from another thread, reaches it.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <array>
#include <future>
#include <thread>

#include "distributers/links/descriptor.h"
#include "distributers/links/udp.h"

namespace {
using namespace jarol::distributers;
using namespace std::chrono_literals;

// Takes its time over a packet after another thread has seen it, as a busy processor may.
struct SlowSink : ByteSink {
  explicit SlowSink(UdpTransport& to) : transport(to) {}
  bool take(std::span<const std::byte> bytes, std::uint32_t) override {
    if (answered.valid()) return true;
    answered = std::async(std::launch::async,
                          [this, packet = std::vector(bytes.begin(), bytes.end())] { return transport.send(packet); });
    std::this_thread::sleep_for(50ms);
    return true;
  }
  void begin_stream() override {}

  UdpTransport& transport;
  std::future<bool> answered;
};

TEST_SUITE("distributers/links/first_answer") {
  TEST_CASE("the answer to the first packet of a new peer is sent, however soon it comes") {
    const Address any = Address::parse("127.0.0.1:0");
    UdpTransport transport(any, Address());
    transport.open();
    SlowSink sink(transport);
    Interrupter interrupter;
    std::thread receiver([&] { transport.receive(interrupter, sink); });
    const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const Address to = any.with_port(transport.port());
    const std::array<char, 4> question{'p', 'i', 'n', 'g'};
    sendto(socket.get(), question.data(), question.size(), 0, to.get(), to.size());
    const timeval patience{20, 0};
    setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::array<char, 8> answer{};
    CHECK(recv(socket.get(), answer.data(), answer.size(), 0) == 4);
    interrupter.interrupt();
    receiver.join();
    CHECK(sink.answered.get());
    CHECK(transport.counts.unsent == 0);
    transport.close();
  }
}
}  // namespace
