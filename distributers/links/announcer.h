// Where a link announces itself: datagrams to all who may look for systems. Nothing is received.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"

namespace jarol::distributers {

class Announcer {
 public:
  explicit Announcer(std::vector<Address> to) : to_(std::move(to)), failures_(to_.size()) {}

  /// Of "127.0.0.1:30100-30104" or "30100, 192.168.2.255:30100": addresses, each with a port or the first and last of
  /// some. Throws InputError that says what would be right.
  static std::vector<Address> parse(const std::string& text);

  /// Throws InputError with the cause.
  void open();
  /// Where nobody listens now somebody may later: that it arrives is not known, and no matter.
  void send(std::span<const std::byte> packet);
  void close() { sockets_.clear(); }

  /// Which could not be sent, as in "announcements to 10.0.0.9:30100 (Network is unreachable)", and how many; any
  /// thread.
  std::vector<std::pair<std::string, std::uint64_t>> unsent() const;

 private:
  struct Failures {
    std::atomic<std::uint64_t> count{0};
    std::atomic<int> error{0};  // of the first
  };
  std::string text() const;

  std::vector<Address> to_;
  std::vector<Descriptor> sockets_;  // of each address
  std::vector<Failures> failures_;   // likewise
};

}  // namespace jarol::distributers
