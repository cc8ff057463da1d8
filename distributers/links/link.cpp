#include "distributers/links/link.h"

#include <signal.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "distributers/links/stamp_order.h"
#include "distributers/links/timestamp.h"
#include "graph/yaml/problems.h"

namespace jarol::distributers {
namespace {

using messages::Flaw;

// Signals to the process go to its other threads.
void take_no_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

// in the input port the number of its peer goes before a packet
constexpr std::size_t peer_size = sizeof(std::uint32_t);

std::size_t longest_packet(const messages::MessageSet& set) {
  return set.header_size() + set.most_payload + set.footer_size();
}

std::vector<std::string> names_of_fields(const messages::MessageForm& form) {
  std::vector<std::string> names;
  for (const messages::FieldForm& field : form.fields) names.emplace_back(field.name);
  return names;
}

// The integer field of a header that has room for the value.
const messages::FieldForm& find_field(const messages::MessageForm& form, const std::string& name, std::uint64_t value) {
  for (const messages::FieldForm& field : form.fields) {
    if (field.name != name || field.wire > messages::Wire::uint64) continue;
    const std::size_t size = size_of(field.wire);
    if (size < 8 && value >> (8 * size) != 0)
      throw std::invalid_argument("field '" + name + "' of the header has no room for " + std::to_string(value));
    return field;
  }
  throw std::invalid_argument("the header has no integer field '" + name +
                              "'; it has: " + list_of(names_of_fields(form)));
}

// What a field of a header has to be; little-endian machines only.
struct Accepted {
  const messages::FieldForm* field;
  std::uint64_t value;
  bool accepts(messages::MessageRef header) const {
    return std::memcmp(static_cast<const std::byte*>(header.value) + field->offset, &value, size_of(field->wire)) == 0;
  }
};

}  // namespace

// What the receiving thread does with bytes: packets that are valid go into the input port.
class Link::Translator : public ByteSink {
 public:
  Translator(const messages::MessageSet& set, const LinkOptions& options, PacketPorts& input)
      : set_(set), datagrams_(set), input_(input), order_(set), entry_(peer_size + longest_packet(set)) {
    for (const auto& [name, value] : options.accept)
      accepted_.push_back({&find_field(*set.header, name, value), value});
  }

  bool take(std::span<const std::byte> bytes, std::uint32_t peer) override {
    return stream_ ? take_stream(bytes) : take_datagram(bytes, peer);
  }

  void begin_stream() override {
    if (stream_) {
      stream_->give_up();
      while (stream_->next()) write(stream_->header(), stream_->packet(), 0);
      store(stream_->counts());
      before_ = told_;
    }
    stream_ = std::make_unique<messages::StreamReader>(set_);
    order_.begin();
  }

  // read by other threads
  struct Counts {
    std::atomic<std::uint64_t> packets{0}, bytes{0}, dropped_bytes{0}, refused{0}, others{0}, late{0};
    std::array<std::atomic<std::uint64_t>, messages::flaw_count> dropped{};
  };
  const Counts& counts() const { return counts_; }

 private:
  bool take_datagram(std::span<const std::byte> bytes, std::uint32_t peer) {
    const Flaw flaw = datagrams_.read(bytes);
    told_.count(flaw, bytes.size());
    const bool counts = flaw == Flaw::none && write(datagrams_.header(), bytes, peer);
    store(told_);
    return counts;
  }

  bool take_stream(std::span<const std::byte> bytes) {
    bool valid = false;
    while (!bytes.empty()) {
      const std::span<std::byte> room = stream_->room();
      const std::size_t part = std::min(room.size(), bytes.size());
      std::memcpy(room.data(), bytes.data(), part);
      stream_->filled(part);
      bytes = bytes.subspan(part);
      while (stream_->next()) valid |= write(stream_->header(), stream_->packet(), 0);
    }
    store(stream_->counts());
    return valid;
  }

  // False: it is from another sender than the one that counts.
  bool write(messages::MessageRef header, std::span<const std::byte> packet, std::uint32_t peer) {
    for (const Accepted& accepted : accepted_) {
      if (accepted.accepts(header)) continue;
      ++counts_.others;
      return false;
    }
    if (order_.is_late(header, peer)) ++counts_.late;
    std::memcpy(entry_.data(), &peer, peer_size);
    std::memcpy(entry_.data() + peer_size, packet.data(), packet.size());
    const auto entry = std::span(entry_).first(peer_size + packet.size());
    if (!std::visit([&](auto& port) { return port.write(entry); }, input_)) ++counts_.refused;
    return true;
  }

  // After what is counted is in the port: who sees the count finds the packets.
  void store(const messages::PacketCounts& now) {
    if (stream_) {
      told_ = before_;
      told_.packets += now.packets;
      told_.bytes += now.bytes;
      told_.dropped_bytes += now.dropped_bytes;
      for (std::size_t i = 0; i < now.dropped.size(); ++i) told_.dropped[i] += now.dropped[i];
    }
    counts_.bytes.store(told_.bytes, std::memory_order_relaxed);
    counts_.dropped_bytes.store(told_.dropped_bytes, std::memory_order_relaxed);
    for (std::size_t i = 0; i < told_.dropped.size(); ++i)
      counts_.dropped[i].store(told_.dropped[i], std::memory_order_relaxed);
    counts_.packets.store(told_.packets, std::memory_order_release);
  }

  const messages::MessageSet& set_;
  messages::PacketReader datagrams_;
  std::unique_ptr<messages::StreamReader> stream_;
  PacketPorts& input_;
  StampOrder order_;
  std::vector<std::byte> entry_;
  std::vector<Accepted> accepted_;
  messages::PacketCounts told_, before_;  // before_: of the streams that have ended
  Counts counts_;
};

Link::PacketPorts Link::make_port(const PortOptions& options, std::size_t longest) {
  if (options.kind == PortKind::push) return PacketPorts(std::in_place_type<PushPacketPort>, options.packets, longest);
  return PacketPorts(std::in_place_type<PacketPort>, options.packets, longest);
}

Link::Link(std::unique_ptr<Transport> transport, const messages::MessageSet& set, const LinkOptions& options)
    : set_(set),
      transport_(std::move(transport)),
      longest_(longest_packet(set)),
      input_(make_port(options.input, peer_size + longest_)),
      output_(make_port(options.output, longest_)),
      translator_(std::make_unique<Translator>(set, options, input_)),
      reader_(set),
      header_(*set.header),
      timestamp_(find_timestamp(set)) {
  packet_.reserve(longest_);
  room_.resize(peer_size + longest_);
  for (const auto& [name, value] : options.header) {
    const messages::FieldForm& field = find_field(*set.header, name, value);
    std::memcpy(static_cast<std::byte*>(header_.value()) + field.offset, &value, size_of(field.wire));
  }
}

Link::~Link() { disconnect(); }

void Link::connect() {
  if (connected_) return;
  transport_->open();
  interrupter_.reset();
  send_signal_.resume();
  ending_ = false;
  receiver_ = std::thread([this] {
    take_no_signals();
    transport_->receive(interrupter_, *translator_);
  });
  sender_ = std::thread([this] {
    take_no_signals();
    run_sender();
  });
  connected_ = true;
}

void Link::disconnect() {
  if (!connected_) return;
  ending_ = true;
  send_signal_.interrupt();
  sender_.join();
  interrupter_.interrupt();
  receiver_.join();
  transport_->close();
  connected_ = false;
}

void Link::receive(messages::Receiver& receiver) {
  const auto read = [&](auto& port) { return port.read(room_); };
  for (auto left = std::visit([](const auto& port) { return port.capacity(); }, input_); left > 0; --left) {
    const auto length = std::visit(read, input_);
    if (!length) return;
    const auto packet = std::span<const std::byte>(room_).first(*length).subspan(peer_size);
    if (reader_.read(packet) != Flaw::none) continue;  // it was valid when it arrived
    std::memcpy(&peer_, room_.data(), peer_size);
    receiver.receive(reader_.message());
  }
}

std::span<const std::byte> Link::encode(messages::MessageRef message) {
  set_timestamp(timestamp_, header_.value());
  write_packet(header_, message, set_.order, packet_);
  return packet_;
}

void Link::send(messages::MessageRef message) {
  if (encode(message).empty() || !std::visit([&](auto& port) { return port.write(packet_); }, output_)) {
    ++refused_;
    return;
  }
  ++given_;
}

void Link::flush() {
  if (queued_.load(std::memory_order_relaxed) == given_) return;
  queued_.store(given_, std::memory_order_seq_cst);
  // a sender that is busy looks again before it waits
  if (send_signal_.signal() != Signalling::done) ++busy_;
}

void Link::run_sender() {
  std::vector<std::byte> room(longest_);
  while (!ending_.load(std::memory_order_acquire)) {
    const std::uint64_t queued = queued_.load(std::memory_order_seq_cst);
    send_pending(room);
    static_cast<void>(send_signal_.await_unless([&] { return queued_.load(std::memory_order_seq_cst) != queued; }));
  }
  send_pending(room);
}

void Link::send_pending(std::vector<std::byte>& room) {
  const auto read = [&](auto& port) { return port.read(room); };
  while (const auto length = std::visit(read, output_)) {
    if (!transport_->send(std::span(room).first(*length))) continue;
    packets_out_.fetch_add(1, std::memory_order_relaxed);
    bytes_out_.fetch_add(*length, std::memory_order_relaxed);
  }
}

LinkReport Link::report() const {
  const Translator::Counts& in = translator_->counts();
  const TransportCounts& t = transport_->counts;
  LinkReport report{transport_->text(), {}, in.packets - std::min<std::uint64_t>(in.packets, in.others), 0};
  const auto add = [&](std::string name, std::uint64_t count) { report.counts.emplace_back(std::move(name), count); };
  const auto add_dropped = [&](const std::string& why, std::uint64_t count) {
    add("dropped: " + why, count);
    report.dropped += count;
  };
  add("packets in", in.packets);
  add("bytes in", in.bytes);
  add("bytes dropped", in.dropped_bytes);
  add("packets out", packets_out_);
  add("bytes out", bytes_out_);
  add("peers", t.connected);
  add("ends of stream", t.disconnected);
  add("late", in.late);
  for (std::size_t i = 1; i < messages::flaw_count; ++i)
    add_dropped(std::string(name_of(static_cast<Flaw>(i))), in.dropped[i]);
  add_dropped("stranger", t.strangers);
  add_dropped("no room in the system", t.overflown);
  add_dropped("other source", in.others);
  add_dropped("input port full", in.refused);
  if (const auto* push = std::get_if<PushPacketPort>(&input_)) add_dropped("overwritten by newer", push->lost());
  add("send signals while busy", busy_);
  add("unsent: output port full", refused_);
  add("unsent: no peer", t.unsent);
  return report;
}

}  // namespace jarol::distributers
