// What a link's receiving thread does with bytes: packets that are valid and count go into the input port.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "distributers/links/entries.h"
#include "distributers/links/link_options.h"
#include "distributers/links/seal.h"
#include "distributers/links/stamp_limits.h"
#include "distributers/links/stamp_order.h"
#include "distributers/links/transport.h"
#include "distributers/messages/packet.h"
#include "distributers/messages/stream_reader.h"
#include "runtime/external_system.h"
#include "runtime/jarol/port.h"
#include "runtime/jarol/push_port.h"

namespace jarol::distributers {

using PacketPorts = std::variant<PacketPort, PushPacketPort>;

/// The integer field of a set's header that has room for the value. Throws InputError if there is none.
const messages::FieldDescriptor& find_header_field(const messages::MessageDescriptor& descriptor,
                                                   const std::string& name, std::uint64_t value);

/// Bytes of the longest packet of a set.
std::size_t longest_packet(const messages::MessageSet& set);

class Translator : public ByteSink {
 public:
  /// `seal`: with which packets come, or null. The port has room for entries of the set.
  Translator(const messages::MessageSet& set, const LinkOptions& options, Seal* seal, PacketPorts& input);

  bool take(std::span<const std::byte> bytes, std::uint32_t peer) override;
  std::span<const std::byte> answer() override { return answers_; }
  bool is_valid_begin(std::span<const std::byte> bytes) const override;
  bool is_broken() const override { return broken_; }
  void begin_stream() override;

  /// Packets that came and counted; any thread.
  std::uint64_t heard() const;
  void add_carried_to(LinkReport& report) const;
  void add_dropped_to(LinkReport& report) const;

 private:
  struct Accepted {
    const messages::FieldDescriptor* field;
    std::uint64_t value, other;
    bool accepts(messages::MessageRef header) const;
  };

  bool take_datagram(std::span<const std::byte> bytes, std::uint32_t peer);
  bool take_stream(std::span<const std::byte> bytes);
  bool take_sealed(std::span<const std::byte> bytes, std::uint32_t peer);
  bool take_sealed_stream(std::span<const std::byte> bytes);
  bool is_to_itself(messages::MessageRef header) const;
  bool write(const messages::PacketReader& packet, std::uint32_t peer);
  void store(const messages::PacketCounts& now);

  // read by other threads
  struct Counts {
    std::atomic<std::uint64_t> packets{0}, bytes{0}, dropped_bytes{0}, refused{0}, others{0}, late{0}, sealed{0},
        elsewhere{0};
    std::array<std::atomic<std::uint64_t>, messages::packet_error_count> dropped{};
    std::array<std::atomic<std::uint64_t>, StampLimits::finding_count> stamps{};
    std::array<std::atomic<std::uint64_t>, Seal::finding_count> seals{};
  };

  // Where a packet is counted that does not count here; null: it does.
  std::atomic<std::uint64_t> Counts::*why_not(messages::MessageRef header) const;

  const messages::MessageSet& set_;
  messages::PacketReader datagrams_;
  std::unique_ptr<messages::StreamReader> stream_;
  bool streams_ = false, begins_ = false, broken_ = false;
  PacketPorts& input_;
  Seal* seal_;
  std::vector<std::byte> sealed_;   // of a stream, the begin of a packet
  std::vector<std::byte> answers_;  // to what was taken last
  StampLimits limits_;
  StampOrder order_;
  EntryWriter entries_;
  std::vector<Accepted> accepted_;
  std::optional<Accepted> destination_;                // this system, or any
  const messages::FieldDescriptor* sender_ = nullptr;  // where there is a destination
  messages::PacketCounts reported_, before_;           // before_: of the streams that have ended
  Counts counts_;
};

}  // namespace jarol::distributers
