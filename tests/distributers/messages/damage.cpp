#include "tests/distributers/messages/damage.h"

#include <algorithm>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/messages/recorded.h"

namespace jarol::tests {
namespace {

// bit by bit, unlike the codec's table
std::uint16_t crc_of(std::span<const std::byte> bytes) {
  std::uint16_t crc = 0;
  for (const std::byte b : bytes)
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (((crc ^ (std::to_integer<unsigned>(b) >> bit)) & 1U) != 0);
      crc = static_cast<std::uint16_t>((crc >> 1) ^ (carry ? 0xa001U : 0U));
    }
  return crc;
}

}  // namespace

std::size_t below(Random& random, std::size_t limit) { return random() % limit; }

std::array<std::byte, 2> Protocol::seal(std::span<const std::byte> bytes) const {
  const auto before = bytes.first(bytes.size() - 2);
  if (is_imc) {
    const std::uint16_t crc = crc_of(before);
    const std::byte low{static_cast<unsigned char>(crc & 0xff)}, high{static_cast<unsigned char>(crc >> 8)};
    if (bytes[0] == std::byte{0x54}) return {low, high};
    return {high, low};
  }
  unsigned sum = 0;
  for (const std::byte b : before.subspan(2)) sum += std::to_integer<unsigned>(b);
  return {std::byte{static_cast<unsigned char>(sum >> 8)}, std::byte{static_cast<unsigned char>(sum)}};
}

bool Protocol::is_sealed(std::span<const std::byte> bytes) const {
  return bytes.size() > 2 && std::ranges::equal(seal(bytes), bytes.last(2));
}

std::vector<Bytes> Protocol::packets() const {
  std::vector<Bytes> all;
  for (const nlohmann::json& packet : messages::recorded(recorded)) all.push_back(messages::bytes_of(packet["hex"]));
  return all;
}

const std::array<Protocol, 2>& protocols() {
  static const std::array<Protocol, 2> both{
      Protocol{messages::imc::message_set(), "imc-packets.jsonl", true},
      Protocol{messages::javiator::message_set(), "javiator-packets.jsonl", false}};
  return both;
}

Bytes random_bytes(const std::vector<Bytes>& packets, Random& random) {
  Bytes bytes(below(random, 130));
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  const Bytes& like = packets[below(random, packets.size())];
  if (random() % 2 == 0)
    std::copy_n(like.begin(), std::min(like.size(), std::min<std::size_t>(bytes.size(), 6)), bytes.begin());
  return bytes;
}

void damage(Bytes& packet, Random& random) {
  for (std::size_t times = 1 + below(random, 4); times > 0; --times) {
    const std::size_t at = below(random, packet.size() + 1);
    const auto value = static_cast<std::byte>(random());
    switch (below(random, 4)) {
      case 0: packet.insert(packet.begin() + static_cast<std::ptrdiff_t>(at), value); break;
      case 1:
        if (at < packet.size()) packet.erase(packet.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 2: packet.resize(at); break;
      default:
        if (at < packet.size()) packet[at] = value;
    }
  }
}

void damage_fields(const Protocol& protocol, Bytes& packet, Random& random) {
  const std::size_t header = protocol.set.header_size();
  Bytes payload(packet.begin() + static_cast<std::ptrdiff_t>(header), packet.end() - 2);
  damage(payload, random);
  if (!protocol.is_imc) payload.resize(std::min<std::size_t>(payload.size(), 122));
  packet.resize(header);
  packet.insert(packet.end(), payload.begin(), payload.end());
  packet.resize(packet.size() + 2);
  if (protocol.is_imc) {
    packet[4] = static_cast<std::byte>(payload.size());
    packet[5] = static_cast<std::byte>(payload.size() >> 8);
  } else {
    packet[3] = static_cast<std::byte>(payload.size());
  }
  const auto seal = protocol.seal(packet);
  std::copy(seal.begin(), seal.end(), packet.end() - 2);
}

}  // namespace jarol::tests
