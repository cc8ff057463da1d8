#include "distributers/links/translator.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "graph/language/problems.h"
#include "graph/text/errors.h"

namespace jarol::distributers {

using messages::PacketError;

namespace {

std::vector<std::string> names_of_fields(const messages::MessageDescriptor& descriptor) {
  std::vector<std::string> names;
  for (const messages::FieldDescriptor& field : descriptor.fields) names.emplace_back(field.name);
  return names;
}

std::uint64_t default_of(const messages::MessageDescriptor& descriptor, const messages::FieldDescriptor& field) {
  messages::Message made(descriptor);
  std::uint64_t value = 0;
  std::memcpy(&value, static_cast<const std::byte*>(made.value()) + field.offset, size_of(field.wire));
  return value;
}

template <class Array, class Finding>
auto& count_of(Array& counts, Finding finding) {
  return counts[static_cast<std::size_t>(finding)];
}

}  // namespace

const messages::FieldDescriptor& find_header_field(const messages::MessageDescriptor& descriptor,
                                                   const std::string& name, std::uint64_t value) {
  for (const messages::FieldDescriptor& field : descriptor.fields) {
    if (field.name != name || field.wire > messages::Wire::uint64) continue;
    const std::size_t size = size_of(field.wire);
    if (size < 8 && value >> (8 * size) != 0)
      throw InputError("field '" + name + "' of the header has no room for " + std::to_string(value));
    return field;
  }
  throw InputError("the header has no integer field '" + name + "'; it has: " + list_of(names_of_fields(descriptor)));
}

std::size_t longest_packet(const messages::MessageSet& set) {
  return set.header_size() + set.max_payload + set.footer_size();
}

// What a field of a header has to be; little-endian machines only.
bool Translator::Accepted::accepts(messages::MessageRef header) const {
  const auto* at = static_cast<const std::byte*>(header.value) + field->offset;
  return std::memcmp(at, &value, size_of(field->wire)) == 0 || std::memcmp(at, &other, size_of(field->wire)) == 0;
}

Translator::Translator(const messages::MessageSet& set, const LinkOptions& options, Seal* seal, PacketPorts& input)
    : set_(set),
      datagrams_(set),
      input_(input),
      seal_(seal),
      limits_(set, options.silence),
      order_(set),
      entries_(set) {
  for (const auto& [name, value] : options.accept)
    accepted_.push_back({&find_header_field(*set.header, name, value), value, value});
  for (const auto& [name, id] : options.header)
    for (const messages::FieldDescriptor& field : set.header->fields)
      if (name == "src" && field.name == "dst") {
        destination_ = {&field, id, default_of(*set.header, field)};
        sender_ = &find_header_field(*set.header, name, id);
      }
}

bool Translator::take(std::span<const std::byte> bytes, std::uint32_t peer) {
  answers_.clear();
  if (seal_ != nullptr) return streams_ ? take_sealed_stream(bytes) : take_sealed(bytes, peer);
  return streams_ ? take_stream(bytes) : take_datagram(bytes, peer);
}

void Translator::begin_stream() {
  if (stream_) {
    stream_->give_up();
    while (stream_->next()) write(stream_->reader(), 0);
    store(stream_->counts());
    before_ = reported_;
  }
  streams_ = begins_ = true;
  broken_ = false;
  sealed_.clear();
  if (seal_ == nullptr) stream_ = std::make_unique<messages::StreamReader>(set_);
  limits_.begin();
  order_.begin();
}

bool Translator::is_valid_begin(std::span<const std::byte> bytes) const {
  if (seal_ != nullptr) return seal_->is_authentic(bytes);
  messages::StreamReader reader(set_);
  while (!bytes.empty()) {
    const std::span<std::byte> room = reader.room();
    const std::size_t part = std::min(room.size(), bytes.size());
    std::memcpy(room.data(), bytes.data(), part);
    reader.filled(part);
    bytes = bytes.subspan(part);
    while (reader.next())
      if (why_not(reader.header()) == nullptr) return true;
  }
  return false;
}

bool Translator::take_datagram(std::span<const std::byte> bytes, std::uint32_t peer) {
  const PacketError packet_error = datagrams_.check(bytes);
  if (packet_error != PacketError::none && seal_ == nullptr && Seal::is_sealed(bytes)) {
    ++counts_.sealed;
    return false;
  }
  reported_.count(packet_error, bytes.size());
  const bool counts = packet_error == PacketError::none && write(datagrams_, peer);
  store(reported_);
  return counts;
}

bool Translator::take_stream(std::span<const std::byte> bytes) {
  if (std::exchange(begins_, false) && Seal::is_sealed(bytes)) {
    ++counts_.sealed;
    broken_ = true;
    return false;
  }
  bool valid = false;
  while (!bytes.empty()) {
    const std::span<std::byte> room = stream_->room();
    const std::size_t part = std::min(room.size(), bytes.size());
    std::memcpy(room.data(), bytes.data(), part);
    stream_->filled(part);
    bytes = bytes.subspan(part);
    while (stream_->next()) valid |= write(stream_->reader(), 0);
  }
  store(stream_->counts());
  return valid;
}

bool Translator::take_sealed(std::span<const std::byte> bytes, std::uint32_t peer) {
  const Seal::Opened opened = seal_->open(bytes);
  answers_.insert(answers_.end(), seal_->answer().begin(), seal_->answer().end());
  if (opened.finding == Seal::Finding::content) return take_datagram(opened.content, peer);
  ++count_of(counts_.seals, opened.finding);
  return opened.fresh;
}

// What does not begin as a sealed packet, or has another key, has no end that could be trusted.
bool Translator::take_sealed_stream(std::span<const std::byte> bytes) {
  sealed_.insert(sealed_.end(), bytes.begin(), bytes.end());
  std::span<const std::byte> rest = sealed_;
  bool valid = false;
  while (!broken_ && rest.size() >= Seal::head_size) {
    const std::size_t size = Seal::size_of(rest);
    const bool is_one = Seal::is_sealed(rest) && size <= Seal::overhead + longest_packet(set_);
    if (is_one && size > rest.size()) break;
    const auto packet = rest.first(is_one ? size : rest.size());
    const std::uint64_t wrong = count_of(counts_.seals, Seal::Finding::wrong_key);
    valid |= take_sealed(packet, 0);
    broken_ = !is_one || count_of(counts_.seals, Seal::Finding::wrong_key) > wrong;
    rest = rest.subspan(packet.size());
  }
  sealed_.erase(sealed_.begin(), sealed_.end() - static_cast<std::ptrdiff_t>(rest.size()));
  return valid;
}

std::atomic<std::uint64_t> Translator::Counts::*Translator::why_not(messages::MessageRef header) const {
  for (const Accepted& field : accepted_)
    if (!field.accepts(header)) return &Counts::others;
  const bool is_for_us = !destination_ || destination_->accepts(header) || is_to_itself(header);
  return is_for_us ? nullptr : &Counts::elsewhere;
}

// DUNE sends what its tasks send each other, as which entity is which, addressed to its own system.
bool Translator::is_to_itself(messages::MessageRef header) const {
  const auto* const value = static_cast<const std::byte*>(header.value);
  const messages::FieldDescriptor& to = *destination_->field;
  return std::memcmp(value + sender_->offset, value + to.offset, size_of(to.wire)) == 0;
}

// False: it does not count, as from another sender than the one that does.
bool Translator::write(const messages::PacketReader& packet, std::uint32_t peer) {
  const messages::MessageRef header = packet.header();
  if (const auto count = why_not(header); count != nullptr) {
    ++(counts_.*count);
    return false;
  }
  const double here = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  if (const auto stamp = limits_.look(header, StampLimits::Clock::now(), here); stamp != StampLimits::Finding::good) {
    ++count_of(counts_.stamps, stamp);
    return false;
  }
  if (order_.is_late(header, peer)) ++counts_.late;
  const auto entry = entries_.write(packet, peer);
  if (!std::visit([&](auto& port) { return port.write(entry); }, input_)) ++counts_.refused;
  return true;
}

// After what is counted is in the port: who sees the count finds the packets.
void Translator::store(const messages::PacketCounts& now) {
  if (stream_) {
    reported_ = before_;
    reported_.packets += now.packets;
    reported_.bytes += now.bytes;
    reported_.dropped_bytes += now.dropped_bytes;
    for (std::size_t i = 0; i < now.dropped.size(); ++i) reported_.dropped[i] += now.dropped[i];
  }
  counts_.bytes.store(reported_.bytes, std::memory_order_relaxed);
  counts_.dropped_bytes.store(reported_.dropped_bytes, std::memory_order_relaxed);
  for (std::size_t i = 0; i < reported_.dropped.size(); ++i)
    counts_.dropped[i].store(reported_.dropped[i], std::memory_order_relaxed);
  counts_.packets.store(reported_.packets, std::memory_order_release);
}

std::uint64_t Translator::heard() const {
  const std::uint64_t packets = counts_.packets;  // before the others: no more of them than these
  const std::uint64_t stamps = counts_.stamps[1] + counts_.stamps[2] + counts_.stamps[3];
  return packets - std::min<std::uint64_t>(packets, counts_.others + counts_.elsewhere + stamps);
}

void Translator::add_carried_to(LinkReport& report) const {
  report.heard = heard();
  report.counts.emplace_back("packets in", counts_.packets);
  report.counts.emplace_back("bytes in", counts_.bytes);
  report.counts.emplace_back("bytes dropped", counts_.dropped_bytes);
  report.counts.emplace_back("late", counts_.late);
}

void Translator::add_dropped_to(LinkReport& report) const {
  const auto add_dropped = [&](const std::string& why, std::uint64_t count) {
    report.counts.emplace_back("dropped: " + why, count);
    report.dropped += count;
  };
  for (std::size_t i = 1; i < messages::packet_error_count; ++i)
    add_dropped(std::string(name_of(static_cast<PacketError>(i))), counts_.dropped[i]);
  add_dropped("other source", counts_.others);
  add_dropped("other destination", counts_.elsewhere);
  add_dropped("stamp is no time", count_of(counts_.stamps, StampLimits::Finding::no_time));
  add_dropped("stamp in the future", count_of(counts_.stamps, StampLimits::Finding::ahead));
  add_dropped("stamp in the past", count_of(counts_.stamps, StampLimits::Finding::behind));
  add_dropped("sealed with a key", counts_.sealed);
  for (std::size_t i = static_cast<std::size_t>(Seal::Finding::no_key); i < Seal::finding_count; ++i)
    add_dropped(std::string(name_of(static_cast<Seal::Finding>(i))), counts_.seals[i]);
  add_dropped("input port full", counts_.refused);
  if (const auto* push = std::get_if<PushPacketPort>(&input_)) add_dropped("overwritten by newer", push->lost());
}

}  // namespace jarol::distributers
