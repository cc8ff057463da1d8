#include "distributers/links/link.h"

#include <signal.h>

#include <cstring>
#include <stdexcept>

#include "distributers/links/timestamp.h"
#include "graph/floating_point.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

// Signals to the process go to its other threads.
void take_no_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

}  // namespace

PacketPorts Link::make_port(const PortOptions& options, std::size_t longest) {
  if (options.kind == PortKind::push) return PacketPorts(std::in_place_type<PushPacketPort>, options.packets, longest);
  return PacketPorts(std::in_place_type<PacketPort>, options.packets, longest);
}

Link::Link(std::unique_ptr<Transport> transport, const messages::MessageSet& set, const LinkOptions& options)
    : set_(set),
      transport_(std::move(transport)),
      longest_(longest_packet(set)),
      input_(make_port(options.input, longest_entry(set))),
      output_(make_port(options.output, longest_)),
      seal_(options.key ? std::make_unique<Seal>(*options.key, set.name) : nullptr),
      translator_(set, options, seal_.get(), input_),
      entries_(set),
      header_(*set.header),
      default_header_(*set.header),
      own_header_(*set.header),
      timestamp_(find_timestamp(set)) {
  if (auto to = transport_->announces_to(); !to.empty()) {
    constexpr std::size_t announcements = 4;
    announcer_ = std::make_unique<Announcer>(std::move(to));
    announcements_ = std::make_unique<PacketPort>(announcements, longest_);
  }
  packet_.reserve(longest_);
  for (const auto& [name, value] : options.header) {
    const messages::FieldDescriptor& field = find_header_field(*set.header, name, value);
    std::memcpy(static_cast<std::byte*>(header_.value()) + field.offset, &value, size_of(field.wire));
  }
}

Link::~Link() { disconnect(); }

// One of a plugin may say by any exception that there is no way: it is no error of ours.
void Link::open_transport() {
  try {
    transport_->open();
  } catch (const Unfinished&) { throw; } catch (const std::system_error&) {
    throw;
  } catch (const std::bad_alloc&) { throw; } catch (const std::exception& error) {
    throw InputError(error.what());
  }
}

void Link::connect() {
  if (connected_) return;
  open_transport();
  try {
    if (announcer_) announcer_->open();
  } catch (...) {
    transport_->close();
    throw;
  }
  interrupter_.reset();
  send_signal_.resume();
  ending_ = false;
  receiving_.failed = sending_.failed = false;
  sends_ = true;
  connected_ = true;
  try {
    receiver_ = std::thread([this] { run(receiving_, [this] { transport_->receive(interrupter_, translator_); }); });
    sender_ = std::thread([this] {
      run(sending_, [this] { run_sender(); });
      sends_ = false;
    });
  } catch (...) {
    disconnect();
    throw;
  }
}

template <class Work>
void Link::run(Failure& failure, Work work) {
  set_floating_point_control(default_floating_point_control());
  take_no_signals();
  try {
    work();
    return;
  } catch (const std::exception& error) { failure.text = error.what(); } catch (...) {
    failure.text = "something was thrown that is no exception";
  }
  failure.failed.store(true, std::memory_order_release);
}

void Link::require_works(const Failure& thread, const char* what) const {
  if (thread.failed.load(std::memory_order_acquire))
    throw Unfinished(transport_->text() + ": " + what + " has failed: " + thread.text);
}

void Link::disconnect() {
  if (!connected_) return;
  ending_ = true;
  send_signal_.interrupt();
  // one that could not be had has nothing to send
  if (sender_.joinable()) sender_.join();
  sends_ = false;
  interrupter_.interrupt();
  if (receiver_.joinable()) receiver_.join();
  transport_->close();
  if (announcer_) announcer_->close();
  connected_ = false;
}

void Link::receive(messages::Receiver& receiver) {
  require_works(receiving_, "receiving");
  require_works(sending_, "sending");
  const auto read = [&](auto& port) { return port.read(entries_.room()); };
  for (auto left = std::visit([](const auto& port) { return port.capacity(); }, input_); left > 0; --left) {
    if (!std::visit(read, input_)) return;
    receiver.receive(entries_.read());
  }
}

// What the header of a message leaves as it is by default, the link says.
messages::Message& Link::header_of(messages::MessageRef message) {
  if (message.header == nullptr) return header_;
  for (const messages::FieldDescriptor& field : set_.header->fields) {
    const auto at = [&](const void* header) { return static_cast<const std::byte*>(header) + field.offset; };
    const std::size_t size = size_of(field.wire);
    const bool its_own = std::memcmp(at(message.header), at(default_header_.value()), size) != 0;
    std::memcpy(static_cast<std::byte*>(own_header_.value()) + field.offset,
                at(its_own ? message.header : header_.value()), size);
  }
  return own_header_;
}

std::span<const std::byte> Link::encode(messages::MessageRef message) {
  messages::Message& header = header_of(message);
  set_timestamp(timestamp_, header.value());
  write_packet(header, message, set_.order, packet_);
  return packet_;
}

void Link::send(messages::MessageRef message) {
  if (encode(message).empty() || !std::visit([&](auto& port) { return port.write(packet_); }, output_)) {
    ++refused_;
    return;
  }
  ++given_;
}

void Link::announce(messages::MessageRef message) {
  if (!encode(message).empty() && announcements_->write(packet_)) ++given_;
}

void Link::flush() {
  require_works(sending_, "sending");
  if (queued_.load(std::memory_order_relaxed) == given_) return;
  queued_.store(given_, std::memory_order_seq_cst);
  // a sender that is busy looks again before it waits
  if (send_signal_.signal() != Signalling::done) ++busy_;
}

void Link::run_sender() {
  std::vector<std::byte> room(longest_), sealed;
  while (!ending_.load(std::memory_order_acquire)) {
    const std::uint64_t queued = queued_.load(std::memory_order_seq_cst);
    send_pending(room, sealed);
    static_cast<void>(send_signal_.await_unless([&] { return queued_.load(std::memory_order_seq_cst) != queued; }));
  }
  send_pending(room, sealed);
}

void Link::send_pending(std::vector<std::byte>& room, std::vector<std::byte>& sealed) {
  const auto read = [&](auto& port) { return port.read(room); };
  while (const auto length = std::visit(read, output_)) {
    const auto packet = std::span<const std::byte>(room).first(*length);
    if (seal_) seal_->seal(packet, sealed);
    if (!transport_->send(seal_ ? std::span<const std::byte>(sealed) : packet)) continue;
    packets_out_.fetch_add(1, std::memory_order_relaxed);
    bytes_out_.fetch_add(*length, std::memory_order_relaxed);
  }
  while (announcer_) {
    const auto length = announcements_->read(room);
    if (!length) break;
    announcer_->send(std::span<const std::byte>(room).first(*length));
  }
}

LinkReport Link::report() const {
  const TransportCounts& t = transport_->counts;
  const Ownership* const ownership = transport_->ownership();
  LinkReport report;
  report.link = transport_->text() + (seal_ ? " with a key" : "");
  const auto add = [&](std::string name, std::uint64_t count) { report.counts.emplace_back(std::move(name), count); };
  translator_.add_carried_to(report);
  add("packets out", packets_out_);
  add("bytes out", bytes_out_);
  add("peers", t.connected);
  add("takeovers", ownership == nullptr ? 0 : ownership->takeovers());
  add("ends of stream", t.disconnected);
  add("closed ports", t.closed);
  add("dropped: stranger", t.strangers);
  add("dropped: no room in the system", t.overflown);
  report.dropped += t.strangers + t.overflown;
  translator_.add_dropped_to(report);
  add("send signals while busy", busy_);
  add("unsent: output port full", refused_);
  add("unsent: no peer", t.unsent);
  for (auto& [what, count] : unsent_announcements()) add("unsent: " + what, count);
  if (ownership != nullptr) ownership->add_to(report);
  return report;
}

}  // namespace jarol::distributers
