// Datagrams, one packet each.
#pragma once

#include <mutex>

#include "distributers/links/transport.h"

namespace jarol {
struct DistributerClass;
}

namespace jarol::distributers {

struct LinkType;

/// The link type `udp`.
LinkType udp_link();

/// Why a link of such a distributer can't have several peers at once; empty: it can.
std::string why_one_peer(const DistributerClass& distributer);

/// With a peer named, only its datagrams count. Without, the link is that of the first that speak validly, as many as
/// it has places for (ownership.h), each until its port is closed. What is sent goes to all of them.
///
/// Each peer has a socket of its own beside that at which all arrive: the same port, but connected. So the system keeps
/// its datagrams apart, whatever flood there is of others', and reports when its port is closed.
class UdpTransport : public Transport {
 public:
  /// `announce`: to whom. All are sent the same: the address at which the first of them sees this end.
  UdpTransport(const Address& listen, const Address& peer, std::vector<Address> announce = {},
               std::chrono::nanoseconds silence = Ownership::default_silence, std::size_t places = 1)
      : listen_(listen),
        named_peer_(peer),
        announce_(std::move(announce)),
        ownership_(silence, peer, places),
        peers_(places) {}

  std::string text() const override;
  std::string address() const override;
  std::vector<Address> announces_to() const override { return announce_; }
  std::string doubt() const override;
  void open() override;
  void receive(const Interrupter& interrupter, ByteSink& sink) override;
  bool send(std::span<const std::byte> packet) override;
  void close() override;
  bool can_be_held() const override { return true; }
  const Ownership* ownership() const override { return &ownership_; }

  /// The port that it listens at; of "0" the one that the system chose.
  int port() const { return port_of(door_.socket); }

 private:
  struct Receiving {
    Descriptor socket;
    std::uint32_t overflown = 0;       // datagrams that the system had no room for, as last reported
    std::atomic<bool> refused{false};  // the port to which it is connected has turned out to be closed
  };
  struct Peer {
    Address address;  // none: nobody has this place
    Receiving own;    // no socket: it can't be had now, as without a way to the peer
  };

  Descriptor connect_beside(const Address& peer);
  void associate(std::size_t place, const Address& peer);
  void forget(Peer& peer);
  void show_peers();
  bool have_sockets() const;
  bool receive_one(Receiving& from, ByteSink& sink, std::span<std::byte> room);
  void take(std::span<const std::byte> bytes, const Address& sender, ByteSink& sink);
  void leave_closed_port(std::size_t place, ByteSink& sink, std::span<std::byte> room);
  bool send_to(Peer& peer, std::span<const std::byte> packet);

  Address listen_;
  Address named_peer_;
  std::vector<Address> announce_;
  Receiving door_;  // where all arrive that are no peers
  Ownership ownership_;
  int strangers_in_row_ = 0;

  std::mutex peers_mutex_;   // written by the receiving thread, read by that which sends
  std::vector<Peer> peers_;  // by their places
};

}  // namespace jarol::distributers
