// Where a socket is: an IPv4 or IPv6 address and a port.
#pragma once

#include <sys/socket.h>

#include <string>

#include "distributers/links/descriptor.h"

namespace jarol::distributers {

class Address {
 public:
  Address() = default;

  /// Of "7000", "192.168.2.3:7000", "[::1]:7000" or "name:7000"; without a host it is the loopback 127.0.0.1. Throws
  /// InputError that says what would be right.
  static Address parse(const std::string& text);
  /// As the socket functions give it.
  static Address of(const sockaddr_storage& storage, socklen_t size);

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage_); }
  socklen_t size() const { return size_; }
  int family() const { return storage_.ss_family; }
  int port() const;
  explicit operator bool() const { return size_ > 0; }
  bool operator==(const Address& other) const;

  /// Is it all addresses of the machine, as 0.0.0.0?
  bool is_any() const;

  /// Is it this machine alone, as 127.0.0.1?
  bool is_loopback() const;

  /// The same host with that port.
  Address with_port(int port) const;

  /// "127.0.0.1:7000", "[::1]:7000".
  std::string text() const;

 private:
  sockaddr_storage storage_{};
  socklen_t size_ = 0;
};

/// From where this machine would send to that address, port 0; none: there is no way to it.
Address local_towards(const Address& peer);

/// The port to which a socket is bound; of "0" the one that the system chose.
int port_of(const Descriptor& socket);

/// To whom a socket is connected; none: it is not.
Address peer_of(const Descriptor& socket);

/// To nobody but itself: as it was to connect to a port at which nobody listens, the system gave it that one.
bool is_connected_to_itself(const Descriptor& socket);

/// Its connection ends at once, and the system forgets it.
void break_off(Descriptor socket);

}  // namespace jarol::distributers
