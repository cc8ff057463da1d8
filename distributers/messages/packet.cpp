#include "distributers/messages/packet.h"

#include "distributers/messages/bytes.h"
#include "distributers/messages/checksum.h"
#include "distributers/messages/payload.h"

namespace jarol::messages {
namespace {

const FieldDescriptor& field_at(const MessageSet& set, std::size_t index) { return set.header->fields[index]; }

// Where a field of the header stands on the wire: the header is packed and of fixed size.
std::size_t wire_offset(const MessageSet& set, std::size_t index) {
  std::size_t offset = 0;
  for (std::size_t i = 0; i < index; ++i) offset += size_of(field_at(set, i).wire);
  return offset;
}

std::uint64_t header_field(const MessageSet& set, std::size_t index, const std::byte* header, ByteOrder order) {
  return load_unsigned(header + wire_offset(set, index), size_of(field_at(set, index).wire), order);
}

void set_header_field(const MessageSet& set, std::size_t index, std::byte* header, ByteOrder order,
                      std::uint64_t value) {
  store_unsigned(header + wire_offset(set, index), size_of(field_at(set, index).wire), order, value);
}

std::string hex(std::uint64_t value, std::size_t size) {
  std::string text = "0x";
  for (std::size_t i = 2 * size; i-- > 0;) text += "0123456789abcdef"[(value >> (4 * i)) & 15];
  return text;
}

std::string bytes_text(std::size_t bytes) { return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes"); }

// Text is made only where someone wants to read it.
template <class Text>
PacketError fail(PacketError packet_error, std::string* why, Text text) {
  if (why != nullptr) *why = text();
  return packet_error;
}

}  // namespace

std::string_view name_of(PacketError packet_error) {
  switch (packet_error) {
    case PacketError::none: break;
    case PacketError::garbage: return "garbage";
    case PacketError::truncated: return "truncated";
    case PacketError::oversized: return "oversized";
    case PacketError::checksum: return "bad checksum";
    case PacketError::unknown_id: return "unknown id";
    case PacketError::payload: return "bad payload";
  }
  return "none";
}

std::optional<ByteOrder> order_of(const MessageSet& set, const std::byte* bytes) {
  if (header_field(set, set.sync_field, bytes, set.order) == set.sync) return set.order;
  if (set.either_order && header_field(set, set.sync_field, bytes, other(set.order)) == set.sync)
    return other(set.order);
  return std::nullopt;
}

Announced read_header(const MessageSet& set, const std::byte* header, ByteOrder order) {
  return {static_cast<std::uint32_t>(header_field(set, set.id_field, header, order)),
          header_field(set, set.size_field, header, order)};
}

namespace {

// The parts of a packet where they lie.
struct Frame {
  ByteOrder order = ByteOrder::little;
  std::uint32_t id = 0;
  std::span<const std::byte> header, payload;
};

// Looks at all but the fields. With a wrong checksum the frame is there all the same.
PacketError read_frame(const MessageSet& set, std::span<const std::byte> bytes, Frame& to, std::string* why) {
  const std::size_t around = set.header_size() + set.footer_size();
  if (bytes.size() < around)
    return fail(PacketError::truncated, why, [&] {
      return "the packet has " + bytes_text(bytes.size()) + "; header and checksum alone take " +
             std::to_string(around);
    });
  const auto order = order_of(set, bytes.data());
  if (!order)
    return fail(PacketError::garbage, why, [&] {
      const std::size_t size = set.sync_size();
      return "the packet begins with " + hex(header_field(set, set.sync_field, bytes.data(), set.order), size) +
             ", not with " + hex(set.sync, size);
    });
  const Announced announced = read_header(set, bytes.data(), *order);
  const std::size_t whole = around + announced.payload;
  if (announced.payload > set.max_payload)
    return fail(PacketError::oversized, why, [&] {
      return "the header states " + bytes_text(announced.payload) + " of payload; at most " +
             std::to_string(set.max_payload) + " are allowed";
    });
  if (bytes.size() != whole)
    return fail(bytes.size() < whole ? PacketError::truncated : PacketError::oversized, why, [&] {
      return "the packet has " + bytes_text(bytes.size()) + "; by its header it has " + std::to_string(whole);
    });
  to.order = *order;
  to.id = announced.id;
  to.header = bytes.first(set.header_size());
  to.payload = bytes.subspan(set.header_size(), announced.payload);
  if (set.checksum == Checksum::none) return PacketError::none;
  const auto summed = bytes.first(whole - set.footer_size());
  const std::uint64_t reported = load_unsigned(bytes.data() + summed.size(), set.footer_size(), *order);
  const std::uint64_t right = checksum_of(set, summed);
  if (reported == right) return PacketError::none;
  return fail(PacketError::checksum, why, [&] {
    return "the checksum is " + hex(reported, set.footer_size()) + "; " + hex(right, set.footer_size()) +
           " would be right";
  });
}

}  // namespace

PacketReader::PacketReader(const MessageSet& set) : set_(set), header_(*set.header), kept_(set.messages.size()) {}

PacketError PacketReader::check(std::span<const std::byte> bytes, std::string* why) {
  message_ = {};
  descriptor_ = nullptr;
  Frame frame;
  const PacketError packet_error = read_frame(set_, bytes, frame, why);
  if (packet_error != PacketError::none && packet_error != PacketError::checksum) return packet_error;
  const MessageDescriptor* const descriptor = set_.find(frame.id, frame.payload.size());
  if (descriptor == nullptr && packet_error != PacketError::none) return packet_error;
  if (descriptor == nullptr)
    return fail(PacketError::unknown_id, why,
                [&] { return "message id " + std::to_string(frame.id) + " is not in set " + std::string(set_.name); });
  order_ = frame.order;
  payload_ = frame.payload;
  std::string* const more = packet_error == PacketError::none ? why : nullptr;  // of two flaws the checksum says more
  if (!read_payload(*set_.header, order_, frame.header, header_.value(), more) ||
      !check_payload(*descriptor, order_, payload_, more))
    return packet_error == PacketError::none ? PacketError::payload : packet_error;
  descriptor_ = descriptor;
  return packet_error;
}

MessageRef PacketReader::take() {
  if (descriptor_ == nullptr) return message_;
  Message& kept = kept_[descriptor_->index];
  if (kept.descriptor() == nullptr) kept = Message(*descriptor_);
  static_cast<void>(read_payload(*descriptor_, order_, payload_, kept.value()));  // as it was checked
  message_ = kept;
  message_.header = header_.value();
  return message_;
}

PacketError PacketReader::read(std::span<const std::byte> bytes, std::string* why) {
  const PacketError packet_error = check(bytes, why);
  take();
  return packet_error;
}

bool write_packet(MessageRef header, MessageRef message, ByteOrder order, std::vector<std::byte>& to,
                  std::string* why) {
  const MessageSet& set = message.descriptor->set();
  to.clear();
  bool good = write_payload(header, order, to, why) && write_payload(message, order, to, why);
  const std::size_t payload = to.size() - std::min(to.size(), set.header_size());
  if (good && payload > set.max_payload) {
    good = false;
    if (why != nullptr)
      *why = std::string(message.descriptor->name) + " has " + bytes_text(payload) + " of payload; at most " +
             std::to_string(set.max_payload) + " are allowed";
  }
  if (!good) {
    to.clear();
    return false;
  }
  set_header_field(set, set.sync_field, to.data(), order, set.sync);
  set_header_field(set, set.id_field, to.data(), order, message.descriptor->id);
  set_header_field(set, set.size_field, to.data(), order, payload);
  if (set.checksum != Checksum::none) append_unsigned(to, set.footer_size(), order, checksum_of(set, to));
  return true;
}

}  // namespace jarol::messages
