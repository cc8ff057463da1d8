// Random and damaged packets, and whether a checksum holds, by code of their own.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "distributers/messages/message_set.h"

namespace jarol::tests {

using Bytes = std::vector<std::byte>;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t limit);

/// A message set and packets of real peers.
struct Protocol {
  const messages::MessageSet& set;
  const char* recorded;
  bool is_imc;

  /// The checksum that the bytes should end with, as two bytes on the wire.
  std::array<std::byte, 2> seal(std::span<const std::byte> bytes) const;
  bool is_sealed(std::span<const std::byte> bytes) const;
  std::vector<Bytes> packets() const;
};

const std::array<Protocol, 2>& protocols();

/// Up to 130 bytes; half of them begin like a packet.
Bytes random_bytes(const std::vector<Bytes>& packets, Random& random);

/// Bytes changed, put in, left out or cut off.
void damage(Bytes& packet, Random& random);

/// Damages the payload and makes size and checksum right again, so that the fields are looked at.
void damage_fields(const Protocol& protocol, Bytes& packet, Random& random);

}  // namespace jarol::tests
