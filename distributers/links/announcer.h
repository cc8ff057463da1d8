// Datagrams to several addresses at once, for those who look for systems. Nothing is received.
#pragma once

#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/transport.h"

namespace jarol::distributers {

class Announcer : public Transport {
 public:
  explicit Announcer(std::vector<Address> to) : to_(std::move(to)) {}

  /// Of "127.0.0.1:30100-30104" or "30100, 192.168.2.255:30100": addresses, each with a port or the first and last of
  /// some. Throws std::invalid_argument that says what would be right.
  static std::vector<Address> parse(const std::string& text);

  std::string text() const override;
  void open() override;
  void receive(const Interrupter& interrupter, ByteSink&) override;
  /// Where nobody listens now somebody may later: that it arrives is not known, and no matter.
  bool send(std::span<const std::byte> packet) override;
  void close() override { sockets_.clear(); }

 private:
  std::vector<Address> to_;
  std::vector<Descriptor> sockets_;  // of each address
};

}  // namespace jarol::distributers
