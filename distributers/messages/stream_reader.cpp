#include "distributers/messages/stream_reader.h"

#include <algorithm>
#include <cstring>

namespace jarol::messages {

void PacketCounts::count(PacketError packet_error, std::size_t size) {
  if (packet_error == PacketError::none) {
    ++packets;
    bytes += size;
  } else {
    ++dropped[static_cast<std::size_t>(packet_error)];
    dropped_bytes += size;
  }
}

StreamReader::StreamReader(const MessageSet& set, std::size_t max_packet) : reader_(set) {
  const std::size_t max_of_set = set.header_size() + set.max_payload + set.footer_size();
  max_packet_ = max_packet == 0 ? max_of_set : std::min(max_packet, max_of_set);
  buffer_.resize(2 * std::max(max_packet_, set.header_size()));
}

std::span<std::byte> StreamReader::room() {
  // what is left moves to the front only when it is in the way
  if (begin_ == end_) {
    begin_ = end_ = 0;
  } else if (buffer_.size() - end_ < buffer_.size() / 2) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, held());
    end_ -= begin_;
    begin_ = 0;
  }
  return std::span(buffer_).subspan(end_);
}

bool StreamReader::next() {
  std::size_t size = 0;
  while (find_packet(size)) {
    const PacketError packet_error = reader_.check(bytes().first(size));
    if (packet_error == PacketError::checksum) {
      drop_candidate(packet_error, size);
      continue;
    }
    counts_.count(packet_error, size);
    packet_ = bytes().first(size);
    begin_ += size;
    candidate_left_ = 0;
    in_garbage_ = false;
    if (packet_error == PacketError::none) return true;
  }
  if (giving_up_)
    while (held() > 0) drop_byte();
  giving_up_ = false;
  return false;
}

// The next bytes that look like a packet of that size. False: more have to come.
bool StreamReader::find_packet(std::size_t& size) {
  const MessageSet& set = reader_.set();
  while (skip_to_sync()) {
    if (held() < set.header_size()) {
      if (!giving_up_) return false;
      drop_candidate(PacketError::truncated, held());
      continue;
    }
    const Announced announced = read_header(set, bytes().data(), *order_of(set, bytes().data()));
    size = set.header_size() + announced.payload + set.footer_size();
    const PacketError packet_error = impossible(announced, size);
    if (packet_error != PacketError::none) {
      drop_candidate(packet_error, size);
    } else if (held() >= size) {
      return true;
    } else if (giving_up_) {
      drop_candidate(PacketError::truncated, held());
    } else {
      return false;
    }
  }
  return false;
}

// What can't become a message is not waited for: its length may be as wrong as the rest.
PacketError StreamReader::impossible(const Announced& announced, std::size_t size) const {
  if (size > max_packet_) return PacketError::oversized;
  const MessageDescriptor* const descriptor = reader_.set().find(announced.id, announced.payload);
  if (descriptor == nullptr) return PacketError::unknown_id;
  const bool fits = descriptor->wire_size < 0 || descriptor->wire_size == static_cast<std::int64_t>(announced.payload);
  return fits ? PacketError::none : PacketError::payload;
}

// False: less than a sync is there.
bool StreamReader::skip_to_sync() {
  const MessageSet& set = reader_.set();
  for (; held() >= set.sync_size(); drop_byte())
    if (order_of(set, bytes().data())) return true;
  return false;
}

void StreamReader::drop_byte() {
  // a stretch of garbage counts once, unless a dropped packet explains it
  if (candidate_left_ > 0) {
    --candidate_left_;
  } else if (!in_garbage_) {
    in_garbage_ = true;
    ++counts_.dropped[static_cast<std::size_t>(PacketError::garbage)];
  }
  ++counts_.dropped_bytes;
  ++begin_;
}

// The sync was not that of a packet, or of one that is broken.
void StreamReader::drop_candidate(PacketError packet_error, std::size_t size) {
  if (candidate_left_ == 0) {
    ++counts_.dropped[static_cast<std::size_t>(packet_error)];
    candidate_left_ = std::max<std::size_t>(size, 1);
    in_garbage_ = false;
  }
  drop_byte();
}

}  // namespace jarol::messages
