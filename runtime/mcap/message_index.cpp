#include "runtime/mcap/message_index.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "runtime/mcap/bytes.h"

namespace jarol::mcap {
namespace {

// visit(channel, time, offset) for each message
template <class Visit>
void for_each_message(std::string_view records, const Visit& visit) {
  std::uint64_t length = 0;
  for (std::size_t at = 0; records.size() - at >= message_head; at += record_head + length) {
    std::memcpy(&length, records.data() + at + 1, sizeof length);
    if (length > records.size() - at - record_head) return;
    if (static_cast<Opcode>(records[at]) != Opcode::message) continue;
    std::uint16_t channel = 0;
    std::int64_t time = 0;
    std::memcpy(&channel, records.data() + at + record_head, sizeof channel);
    std::memcpy(&time, records.data() + at + record_head + sizeof channel + sizeof(std::uint32_t), sizeof time);
    visit(channel, time, at);
  }
}

}  // namespace

void MessageIndex::make(std::string_view records) {
  counts_.resize(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1);
  channels_.clear();
  for_each_message(records, [&](std::uint16_t channel, std::int64_t, std::size_t) {
    if (counts_[channel]++ == 0) channels_.push_back({channel});
  });
  std::sort(channels_.begin(), channels_.end(),
            [](const OfChannel& a, const OfChannel& b) { return a.channel < b.channel; });
  records_.clear();
  for (OfChannel& of : channels_) {
    of.offset = records_.size();
    of.messages = counts_[of.channel];
    const std::uint64_t bytes = of.messages * sizeof(IndexEntry);
    put(records_, static_cast<std::uint8_t>(Opcode::message_index));
    put(records_, sizeof of.channel + sizeof(std::uint32_t) + bytes);
    put(records_, of.channel);
    put(records_, static_cast<std::uint32_t>(bytes));
    counts_[of.channel] = records_.size();  // from here on where the next entry goes
    records_.resize(records_.size() + bytes);
  }
  for_each_message(records, [&](std::uint16_t channel, std::int64_t time, std::size_t offset) {
    const IndexEntry entry{time, offset};
    std::memcpy(records_.data() + counts_[channel], &entry, sizeof entry);
    counts_[channel] += sizeof entry;
  });
  for (const OfChannel& of : channels_) counts_[of.channel] = 0;
}

}  // namespace jarol::mcap
