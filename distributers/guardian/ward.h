// What a guardian knows of one link, and how it sends.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "distributers/guardian/stamped_packet.h"
#include "distributers/links/address.h"
#include "distributers/links/seal.h"

namespace jarol::distributers {

class Ward {
 public:
  /// The link's text, as people read it.
  Ward(const Stamping& stamping, std::string text) : stamping_(stamping), text_(std::move(text)) {}

  void add(std::span<const std::byte> packet) { packets_.emplace_back(packet.begin(), packet.end()); }
  void seal_with(const GuardianKey& key) { seal_.emplace(key); }
  void hold(Descriptor fd, std::vector<Address> peers);
  void let_go() { fd_.close(); }
  void set_steers_itself(bool steers_itself) { steers_itself_ = steers_itself; }

  /// All packets once, datagrams to each peer; none to what steers itself. A stream that has no room for them takes
  /// them later.
  void send();
  /// What a stream had no room for, as much as there is now; false: nothing is left.
  bool send_rest();

  /// As in "10 packets over udp 127.0.0.1:7002", or "none over udp 127.0.0.1:7002, as the vehicle there steers itself".
  std::string text() const;

 private:
  void write(std::span<const std::byte> bytes);
  void send_to_each(std::span<const std::byte> datagram);

  Stamping stamping_;
  std::string text_;
  std::vector<std::vector<std::byte>> packets_;
  std::optional<GuardianSeal> seal_;
  std::vector<std::byte> sealed_;
  Descriptor fd_;
  std::vector<Address> peers_;
  bool datagrams_ = false;
  bool steers_itself_ = false;
  std::vector<std::byte> rest_;
  std::uint64_t sent_ = 0;
};

}  // namespace jarol::distributers
