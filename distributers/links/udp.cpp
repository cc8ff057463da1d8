#include "distributers/links/udp.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>

namespace jarol::distributers {
namespace {

struct Datagram {
  ssize_t length = -1;  // bytes; negative: none
  Address sender;
  std::optional<std::uint32_t> overflown;  // before it, since the socket was made; wraps
};

Datagram receive_from(int fd, std::span<std::byte> room) {
  sockaddr_storage from{};
  iovec bytes{room.data(), room.size()};
  alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof(std::uint32_t))> extras{};
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof from;
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = extras.data();
  message.msg_controllen = extras.size();
  Datagram datagram;
  datagram.length = recvmsg(fd, &message, 0);
  if (datagram.length < 0) return datagram;
  datagram.sender = Address::of(from, message.msg_namelen);
  const cmsghdr* extra = CMSG_FIRSTHDR(&message);
  if (extra == nullptr || extra->cmsg_level != SOL_SOCKET || extra->cmsg_type != SO_RXQ_OVFL) return datagram;
  std::memcpy(&datagram.overflown.emplace(), CMSG_DATA(extra), sizeof(std::uint32_t));
  return datagram;
}

// The guardian of a program that crashed has the port for a moment longer.
bool bind_with_patience(int fd, const Address& address) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(500);
  while (bind(fd, address.get(), address.size()) != 0) {
    if (errno != EADDRINUSE || Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

}  // namespace

std::string UdpTransport::text() const {
  return "udp " + listen_.text() + (named_peer_ ? " with " + named_peer_.text() : "");
}

std::string UdpTransport::address() const {
  const Address host = listen_.is_any() && seen_from_ ? local_towards(seen_from_) : listen_;
  const bool reachable = host && (listen_.family() == AF_INET6 || host.family() == AF_INET);
  return reachable ? "udp://" + host.with_port(port()).text() : "";
}

void UdpTransport::open() {
  Descriptor made(socket(listen_.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made || !bind_with_patience(made.get(), listen_))
    throw std::runtime_error("can't listen at " + text() + ": " + std::strerror(errno));
  const int on = 1;
  setsockopt(made.get(), SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
  overflown_ = 0;
  socket_ = std::move(made);
  peer_ = named_peer_;
  if (peer_) ++counts.connected;
  if (holder != nullptr) holder->hold(socket_.get(), peer_);
}

void UdpTransport::associate(const Address& peer) {
  const std::lock_guard lock(peer_mutex_);
  if (peer_ == peer) return;
  peer_ = peer;
  ++counts.connected;
  if (holder != nullptr) holder->hold(socket_.get(), peer_);
}

void UdpTransport::receive(const Interrupter& interrupter, ByteSink& sink) {
  std::array<std::byte, 65536> room;
  while (interrupter.wait(socket_.get(), std::chrono::milliseconds(-1)) != Interrupter::Woken::interrupted) {
    // an error is that of a datagram sent before, as by a peer that has gone: the next may arrive all the same
    const Datagram datagram = receive_from(socket_.get(), room);
    if (datagram.length < 0) continue;
    if (datagram.overflown) {
      counts.overflown += *datagram.overflown - overflown_;
      overflown_ = *datagram.overflown;
    }
    const Address& sender = datagram.sender;
    if (named_peer_ && !(sender == named_peer_)) {
      ++counts.strangers;
      continue;
    }
    // its number goes with the packet, for the packet may be looked at before there is an answer to it
    const std::uint64_t peer = counts.connected + (peer_ == sender ? 0 : 1);
    const bool valid =
        sink.take(std::span(room).first(static_cast<std::size_t>(datagram.length)), static_cast<std::uint32_t>(peer));
    if (valid && !named_peer_) associate(sender);
  }
}

bool UdpTransport::send(std::span<const std::byte> packet) {
  Address peer;
  {
    const std::lock_guard lock(peer_mutex_);
    peer = peer_;
  }
  if (peer && sendto(socket_.get(), packet.data(), packet.size(), MSG_NOSIGNAL, peer.get(), peer.size()) >= 0)
    return true;
  ++counts.unsent;
  return false;
}

void UdpTransport::close() {
  if (holder != nullptr) holder->let_go();
  socket_.close();
  const std::lock_guard lock(peer_mutex_);
  peer_ = {};
}

}  // namespace jarol::distributers
