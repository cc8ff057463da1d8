// Packets out of a stream of bytes, as from a serial line or over TCP: whatever lies between them is passed over.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "distributers/messages/packet.h"

namespace jarol::messages {

/// What was dropped, by reason, and what was not.
struct PacketCounts {
  std::uint64_t packets = 0;  // taken
  std::uint64_t bytes = 0;    // of these
  std::uint64_t dropped_bytes = 0;
  std::array<std::uint64_t, packet_error_count>
      dropped{};  // packets by flaw; in a stream, garbage counts its stretches

  std::uint64_t dropped_for(PacketError packet_error) const { return dropped[static_cast<std::size_t>(packet_error)]; }

  /// Counts a packet of so many bytes that was read with that result.
  void count(PacketError packet_error, std::size_t size);
};

/// Finds packets in what arrives piece by piece. Only what has a sync, an id of the set, a size that its message can
/// have and the right checksum counts as a packet; behind anything else it looks for a sync again, one byte on. Its
/// memory is taken once, that of its messages when the first of a form comes.
class StreamReader {
 public:
  /// Packets of more than `max_packet` bytes are dropped; 0 is what the set allows.
  explicit StreamReader(const MessageSet& set, std::size_t max_packet = 0);

  /// Room for bytes that arrive, at least for one packet once `next` has returned false.
  std::span<std::byte> room();
  /// So many bytes of the room have been filled.
  void filled(std::size_t bytes) { end_ += bytes; }

  /// Reads the next packet, if it is there as a whole. A length that is wrong may make it wait for as many bytes.
  bool next();

  /// Of the packet that `next` has read; its bytes are there until there is room for others.
  std::span<const std::byte> packet() const { return packet_; }
  ByteOrder order() const { return reader_.order(); }
  MessageRef header() const { return reader_.header(); }
  MessageRef message() { return reader_.take(); }
  /// Its form and what it consists of, for who takes it out elsewhere.
  const PacketReader& reader() const { return reader_; }

  /// What has not come of a packet that has begun will not come: the stream has ended. Then `next` looks
  /// through what there is.
  void give_up() { giving_up_ = true; }

  const PacketCounts& counts() const { return counts_; }

 private:
  bool find_packet(std::size_t& size);
  PacketError impossible(const Announced& announced, std::size_t size) const;
  bool skip_to_sync();
  void drop_byte();
  void drop_candidate(PacketError packet_error, std::size_t size);
  std::size_t held() const { return end_ - begin_; }
  std::span<const std::byte> bytes() const { return std::span(buffer_).subspan(begin_, held()); }

  PacketReader reader_;
  std::size_t max_packet_;
  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::span<const std::byte> packet_;
  std::size_t candidate_left_ = 0;  // bytes of a dropped packet still ahead: what looks like another within counts not
  bool in_garbage_ = false;
  bool giving_up_ = false;
  PacketCounts counts_;
};

}  // namespace jarol::messages
