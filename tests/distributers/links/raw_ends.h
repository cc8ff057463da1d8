// The other ends of links, that send any bytes.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "distributers/links/link.h"

namespace jarol::tests {

/// A link of one kind, connected, and what is at the other end of it.
class RawEnd {
 public:
  virtual ~RawEnd() = default;
  /// The bytes arrive as one datagram, or as the next piece of a stream; waits for room.
  void write(std::span<const std::byte> bytes) const;

  std::unique_ptr<distributers::Link> link;
  bool datagrams = false;

 protected:
  distributers::Descriptor end_;
};

/// "udp", "tcp_client", "tcp_server" (the kind of the link), or "serial".
std::unique_ptr<RawEnd> make_raw_end(const std::string& kind, const messages::MessageSet& set,
                                     const distributers::LinkOptions& options = {});

std::uint64_t count_of(const distributers::Link& link, const std::string& name);

/// All packets that a link dropped for a flaw.
std::uint64_t flawed(const distributers::Link& link);

/// These, and those that it took.
std::uint64_t looked_at(const distributers::Link& link);

}  // namespace jarol::tests
