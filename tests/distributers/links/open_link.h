// Links that name no peer, and sockets that speak to them.
#pragma once

#include <doctest/doctest.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "distributers/links/udp.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/links/pairs.h"

namespace jarol::tests {

using namespace distributers;

inline const Address any = Address::parse("127.0.0.1:0");

inline std::vector<std::byte> packet_of(int id) {
  const messages::javiator::MotorSignals signals{0, 0, 0, 0, static_cast<std::uint16_t>(id)};
  const messages::javiator::Header header;
  std::vector<std::byte> bytes;
  REQUIRE(write_packet(messages::refer_to(header), messages::refer_to(signals), messages::javiator::message_set().order,
                       bytes));
  return bytes;
}

template <class Listens>
std::unique_ptr<Listens> listening(std::chrono::nanoseconds silence) {
  if constexpr (std::is_same_v<Listens, UdpTransport>)
    return std::make_unique<UdpTransport>(any, Address{}, std::vector<Address>{}, silence);
  else
    return std::make_unique<Listens>(any, silence);
}

/// A link that names no peer.
template <class Listens>
struct Open {
  explicit Open(std::chrono::nanoseconds silence = std::chrono::hours(1), LinkOptions options = {}) {
    options.input = {PortKind::plain, 4096};
    auto transport = listening<Listens>(silence);
    const Listens& at = *transport;
    link = std::make_unique<Link>(std::move(transport), messages::javiator::message_set(), options);
    link->connect();
    address = any.with_port(at.port());
  }
  std::uint64_t count(const std::string& name) const { return count_of(*link, name); }
  std::unique_ptr<Link> link;
  Address address;
};

/// A socket that says what it is told to.
class Speaker {
 public:
  Speaker(const Address& to, int type) : socket_(::socket(AF_INET, type | SOCK_CLOEXEC, 0)) {
    REQUIRE(connect(socket_.get(), to.get(), to.size()) == 0);
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&storage), &size);
    name = Address::of(storage, size).text();
  }
  void say(std::span<const std::byte> bytes) const { ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  void say(int id) const { say(packet_of(id)); }
  bool hears() const {
    std::byte byte{};
    return ::recv(socket_.get(), &byte, 1, MSG_DONTWAIT | MSG_PEEK) > 0;
  }
  /// The next datagram that has come; empty: there is none.
  std::vector<std::byte> heard() const {
    std::vector<std::byte> bytes(2000);
    const ssize_t length = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
    return bytes;
  }
  /// Of so many motor signals that come, the ids.
  std::vector<int> ids(std::size_t count) const {
    std::vector<int> ids;
    messages::PacketReader reader(messages::javiator::message_set());
    wait_for([&] {
      while (ids.size() < count) {
        const auto bytes = heard();
        if (bytes.empty()) break;
        if (reader.read(bytes) == messages::PacketError::none)
          ids.push_back(reader.message().as<messages::javiator::MotorSignals>()->id);
      }
      return ids.size() == count;
    });
    return ids;
  }
  bool is_ended() const {
    char room[4096];
    ssize_t length = 0;
    while ((length = ::recv(socket_.get(), room, sizeof room, MSG_DONTWAIT)) > 0) {}
    return length == 0;
  }
  std::string name;

 private:
  Descriptor socket_;
};

}  // namespace jarol::tests
