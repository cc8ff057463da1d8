#include "distributers/links/udp.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <thread>

#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

using std::chrono::milliseconds;

// in a flood of strangers the door is left alone for a while, so that it costs little
constexpr int strangers_before_rest = 64;
constexpr milliseconds rest_time{10};

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
  const auto end = Ownership::Clock::now() + std::chrono::milliseconds(500);
  while (bind(fd, address.get(), address.size()) != 0) {
    if (errno != EADDRINUSE || Ownership::Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

void set_option(const Descriptor& socket, int option, int value) {
  setsockopt(socket.get(), SOL_SOCKET, option, &value, sizeof value);
}

}  // namespace

std::string UdpTransport::text() const {
  return "udp " + listen_.text() + (named_peer_ ? " with " + named_peer_.text() : "");
}

std::string UdpTransport::address() const {
  const Address host = listen_.is_any() && !announce_.empty() ? local_towards(announce_.front()) : listen_;
  const bool reachable = host && (listen_.family() == AF_INET6 || host.family() == AF_INET);
  return reachable ? "udp://" + host.with_port(port()).text() : "";
}

std::string UdpTransport::doubt() const {
  if (!listen_.is_loopback()) return "";
  const auto far =
      std::find_if(announce_.begin(), announce_.end(), [](const Address& address) { return !address.is_loopback(); });
  if (far == announce_.end()) return "";
  const std::string all = listen_.family() == AF_INET6 ? "[::]:" : "0.0.0.0:";
  return "announces itself to " + far->text() + ", which can't answer, as " + listen_.text() +
         " is reached from this machine alone; listen at " + all + std::to_string(listen_.port());
}

void UdpTransport::open() {
  Descriptor made(socket(listen_.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made || !bind_with_patience(made.get(), listen_))
    throw InputError("can't listen at " + text() + ": " + std::strerror(errno));
  set_option(made, SO_RXQ_OVFL, 1);
  door_.socket = std::move(made);
  door_.overflown = 0;
  ownership_.begin(Ownership::Clock::now());
  strangers_in_row_ = 0;
  if (named_peer_)
    associate(0, named_peer_);
  else if (holder != nullptr)
    holder->hold(door_.socket.get(), {});
}

// A socket at the same port as the door, to which only that peer's datagrams go. The port is shared with nobody else.
Descriptor UdpTransport::connect_beside(const Address& peer) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  if (getsockname(door_.socket.get(), reinterpret_cast<sockaddr*>(&storage), &size) != 0) return {};
  Descriptor made(socket(peer.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made) return {};
  const auto share_port = [&](int shared) {
    set_option(made, SO_REUSEADDR, shared);
    set_option(door_.socket, SO_REUSEADDR, shared);
    for (const Peer& other : peers_)
      if (other.own.socket) set_option(other.own.socket, SO_REUSEADDR, shared);
  };
  share_port(1);
  const bool there = bind(made.get(), reinterpret_cast<const sockaddr*>(&storage), size) == 0 &&
                     connect(made.get(), peer.get(), peer.size()) == 0;
  share_port(0);
  set_option(made, SO_RXQ_OVFL, 1);
  return there ? std::move(made) : Descriptor();
}

// Under peers_mutex_, once anything can be sent.
void UdpTransport::associate(std::size_t place, const Address& peer) {
  forget(peers_[place]);
  peers_[place].own.socket = connect_beside(peer);
  peers_[place].address = peer;
  ++counts.connected;
  show_peers();
}

// Likewise: to the holder.
void UdpTransport::show_peers() {
  if (holder == nullptr) return;
  std::vector<Address> all;
  for (const Peer& peer : peers_)
    if (peer.address) all.push_back(peer.address);
  holder->hold(door_.socket.get(), all);
}

// Likewise.
void UdpTransport::forget(Peer& peer) {
  peer.address = {};
  peer.own.socket.close();
  peer.own.overflown = 0;
  peer.own.refused = false;
}

bool UdpTransport::have_sockets() const {
  return ownership_.is_owned() && std::all_of(peers_.begin(), peers_.end(), [](const Peer& peer) {
           return bool(peer.own.socket) == bool(peer.address);
         });
}

void UdpTransport::receive(const Interrupter& interrupter, ByteSink& sink) {
  std::array<std::byte, 65536> room;
  std::array<int, 1 + Ownership::max_places> sockets;
  for (;;) {
    const bool rests = strangers_in_row_ >= strangers_before_rest && have_sockets();
    sockets[0] = rests ? -1 : door_.socket.get();
    for (std::size_t i = 0; i < peers_.size(); ++i) sockets[1 + i] = peers_[i].own.socket.get();
    const auto [interrupted, ready] = interrupter.wait_for_some(
        std::span(sockets).first(1 + peers_.size()),
        rests ? rest_time : (ownership_.is_owned() ? Ownership::look_interval : milliseconds(-1)));
    if (interrupted) return;
    ownership_.look(Ownership::Clock::now());
    if (rests) strangers_in_row_ = 0;
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (ready[1 + i]) receive_one(peers_[i].own, sink, room);
      if (peers_[i].own.refused.exchange(false)) leave_closed_port(i, sink, room);
    }
    if (!ready[0]) continue;
    const std::uint64_t peers = counts.connected;
    receive_one(door_, sink, room);
    // what a new peer has sent before it had a socket of its own comes first
    for (int i = 0; counts.connected != peers && i < 1024 && receive_one(door_, sink, room); ++i) {}
  }
}

// False: there is none now.
bool UdpTransport::receive_one(Receiving& from, ByteSink& sink, std::span<std::byte> room) {
  const Datagram datagram = receive_from(from.socket.get(), room);
  if (datagram.length < 0) {
    // an error is that of a datagram sent before
    if (errno == ECONNREFUSED) from.refused = true;
    return false;
  }
  if (datagram.overflown) {
    counts.overflown += *datagram.overflown - from.overflown;
    from.overflown = *datagram.overflown;
  }
  take(room.first(static_cast<std::size_t>(datagram.length)), datagram.sender, sink);
  return true;
}

void UdpTransport::take(std::span<const std::byte> bytes, const Address& sender, ByteSink& sink) {
  if (!ownership_.may_speak(sender)) {
    ++counts.strangers;
    ++strangers_in_row_;
    ownership_.count_stranger(sender);
    return;
  }
  // its number goes with the packet, for the packet may be looked at before there is an answer to it
  const bool is_owner = ownership_.is_owner(sender);
  const std::uint32_t number = ownership_.tenure_of(sender);
  // who answers a new peer at once waits until it is known
  std::unique_lock lock(peers_mutex_, std::defer_lock);
  if (!is_owner) lock.lock();
  const bool valid = sink.take(bytes, number);
  if (const auto answer = sink.answer(); !answer.empty())
    sendto(door_.socket.get(), answer.data(), answer.size(), MSG_NOSIGNAL, sender.get(), sender.size());
  if (is_owner || valid)
    strangers_in_row_ = 0;
  else
    ++strangers_in_row_;
  if (!valid) return;
  const std::size_t place = ownership_.heard(sender, Ownership::Clock::now());
  if (!is_owner) associate(place, sender);
}

// A named peer may come again, and is sent to all the same. Of another what it has sent before still counts.
void UdpTransport::leave_closed_port(std::size_t place, ByteSink& sink, std::span<std::byte> room) {
  ++counts.closed;
  if (named_peer_) return;
  while (peers_[place].own.socket && receive_one(peers_[place].own, sink, room)) {}
  ownership_.gone(place);
  const std::lock_guard lock(peers_mutex_);
  forget(peers_[place]);
  show_peers();
}

// To all; true: to one at least.
bool UdpTransport::send(std::span<const std::byte> packet) {
  const std::lock_guard lock(peers_mutex_);
  std::size_t sent = 0, peers = 0;
  for (Peer& peer : peers_) {
    if (!peer.address) continue;
    ++peers;
    if (send_to(peer, packet)) ++sent;
  }
  if (sent == 0 || sent < peers) ++counts.unsent;
  return sent > 0;
}

bool UdpTransport::send_to(Peer& peer, std::span<const std::byte> packet) {
  const auto sent_by = [&](const Descriptor& socket) {
    const Address& to = peer.address;
    return socket && sendto(socket.get(), packet.data(), packet.size(), MSG_NOSIGNAL, to.get(), to.size()) >= 0;
  };
  if (sent_by(peer.own.socket)) return true;
  const bool closed = peer.own.socket && errno == ECONNREFUSED;
  if (closed) peer.own.refused = true;
  // the error was that of a packet before; or the way to the peer is another now
  return (!closed || named_peer_) && sent_by(door_.socket);
}

void UdpTransport::close() {
  if (holder != nullptr) holder->let_go();
  const std::lock_guard lock(peers_mutex_);
  for (Peer& peer : peers_) forget(peer);
  door_.socket.close();
}

}  // namespace jarol::distributers
