#include "distributers/links/udp.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace jarol::distributers {

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
  if (!made || bind(made.get(), listen_.get(), listen_.size()) != 0)
    throw std::runtime_error("can't listen at " + text() + ": " + std::strerror(errno));
  socket_ = std::move(made);
  peer_ = named_peer_;
  if (peer_) ++counts.connected;
}

void UdpTransport::associate(const Address& peer) {
  const std::lock_guard lock(peer_mutex_);
  if (peer_ == peer) return;
  peer_ = peer;
  ++counts.connected;
}

void UdpTransport::receive(const Interrupter& interrupter, ByteSink& sink) {
  std::array<std::byte, 65536> room;
  while (interrupter.wait(socket_.get(), std::chrono::milliseconds(-1)) != Interrupter::Woken::interrupted) {
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    // an error is that of a datagram sent before, as by a peer that has gone: the next may arrive all the same
    const auto length = recvfrom(socket_.get(), room.data(), room.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (length < 0) continue;
    const Address sender = Address::of(from, size);
    if (named_peer_ && !(sender == named_peer_)) {
      ++counts.strangers;
      continue;
    }
    // its number goes with the packet, for the packet may be looked at before there is an answer to it
    const std::uint64_t peer = counts.connected + (peer_ == sender ? 0 : 1);
    const bool valid =
        sink.take(std::span(room).first(static_cast<std::size_t>(length)), static_cast<std::uint32_t>(peer));
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
  socket_.close();
  const std::lock_guard lock(peer_mutex_);
  peer_ = {};
}

}  // namespace jarol::distributers
