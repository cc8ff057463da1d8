// What a link's input port holds of a packet: the receiving thread has decoded it, and the run's thread takes it as it
// is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributers/messages/packet.h"

namespace jarol::distributers {

// An entry is bytes, as it crosses to another thread: its head, the header's struct, and the message's struct. A
// message with texts or lists has memory that can't cross; of it the payload follows, which was checked, and whose
// fields the other thread takes out.

/// Bytes of the longest entry of a set.
std::size_t longest_entry(const messages::MessageSet& set);

/// Of the thread that receives.
class EntryWriter {
 public:
  explicit EntryWriter(const messages::MessageSet& set);

  /// The entry of a packet that was checked and is good, from the peer of that number; until the next.
  std::span<const std::byte> write(const messages::PacketReader& packet, std::uint32_t peer);

 private:
  std::vector<std::byte> entry_;
  std::size_t message_at_;
};

/// Of the thread that takes them out of the port.
class EntryReader {
 public:
  explicit EntryReader(const messages::MessageSet& set);

  /// Where an entry is put before it is read.
  std::span<std::byte> room() { return entry_; }
  /// Its message with the header; until the next.
  messages::MessageRef read();
  /// Who sent what was read last; 0 before.
  std::uint32_t peer() const { return peer_; }

 private:
  const messages::MessageSet& set_;
  std::vector<std::byte> entry_;
  std::size_t message_at_;
  std::uint32_t peer_ = 0;
  std::vector<messages::Message> kept_;  // with texts or lists, of the form of the same index in the set
};

}  // namespace jarol::distributers
