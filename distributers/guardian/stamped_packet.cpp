#include "distributers/guardian/stamped_packet.h"

#include <bit>

#include "distributers/links/timestamp.h"
#include "distributers/messages/bytes.h"
#include "distributers/messages/checksum.h"

namespace jarol::distributers {

Stamping stamping_of(const messages::MessageSet& set) {
  Stamping stamping{.checksum = set.checksum, .order = set.order};
  if (set.checksum != messages::Checksum::none) stamping.checksum_from = static_cast<std::uint32_t>(set.checksum_from);
  const messages::FieldDescriptor* const time = find_timestamp(set);
  std::uint32_t offset = 0;  // the header is packed, and of fixed size
  for (const messages::FieldDescriptor& field : set.header->fields) {
    if (&field == time) stamping.time_at = offset;
    offset += static_cast<std::uint32_t>(messages::size_of(field.wire));
  }
  return stamping;
}

void stamp(const Stamping& stamping, std::span<std::byte> packet) {
  constexpr std::size_t time_size = 8, sum_size = 2;
  const bool has_sum = stamping.checksum_from != Stamping::none;
  const std::size_t end = packet.size() - (has_sum ? std::min(sum_size, packet.size()) : 0);
  if (stamping.time_at == Stamping::none || stamping.time_at + time_size > end) return;
  messages::store_unsigned(packet.data() + stamping.time_at, time_size, stamping.order,
                           std::bit_cast<std::uint64_t>(seconds_since_1970()));
  if (!has_sum || stamping.checksum_from > end) return;
  const std::span<const std::byte> summed = packet.first(end).subspan(stamping.checksum_from);
  messages::store_unsigned(packet.data() + end, sum_size, stamping.order,
                           messages::checksum_of(stamping.checksum, summed));
}

}  // namespace jarol::distributers
