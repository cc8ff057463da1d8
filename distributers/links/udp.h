// Datagrams, one packet each.
#pragma once

#include <mutex>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"
#include "distributers/links/transport.h"

namespace jarol::distributers {

/// With a peer named, only its datagrams count. Without, the sender of the last valid one is the peer, so that one that
/// was started anew is found again.
class UdpTransport : public Transport {
 public:
  /// `seen_from`: who is told where it can be reached, or none. It matters where it listens at all addresses.
  UdpTransport(const Address& listen, const Address& peer, const Address& seen_from = {})
      : listen_(listen), named_peer_(peer), seen_from_(seen_from) {}

  std::string text() const override;
  std::string address() const override;
  void open() override;
  void receive(const Interrupter& interrupter, ByteSink& sink) override;
  bool send(std::span<const std::byte> packet) override;
  void close() override;

  /// The port that it listens at; of "0" the one that the system chose.
  int port() const { return port_of(socket_); }

 private:
  void associate(const Address& peer);

  Address listen_;
  Address named_peer_;
  Address seen_from_;
  Descriptor socket_;
  std::uint32_t overflown_ = 0;  // datagrams that the system had no room for, as last told
  std::mutex peer_mutex_;
  Address peer_;  // written by the receiving thread
};

}  // namespace jarol::distributers
