#include "distributers/messages/packet.h"

#include "distributers/messages/bytes.h"
#include "distributers/messages/checksum.h"
#include "distributers/messages/payload.h"

namespace jarol::messages {
namespace {

const FieldForm& field_at(const MessageSet& set, std::size_t index) { return set.header->fields[index]; }

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
Flaw flawed(Flaw flaw, std::string* why, Text text) {
  if (why != nullptr) *why = text();
  return flaw;
}

}  // namespace

std::string_view name_of(Flaw flaw) {
  switch (flaw) {
    case Flaw::none: break;
    case Flaw::garbage: return "garbage";
    case Flaw::truncated: return "truncated";
    case Flaw::oversized: return "oversized";
    case Flaw::checksum: return "bad checksum";
    case Flaw::unknown_id: return "unknown id";
    case Flaw::payload: return "bad payload";
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

Flaw read_frame(const MessageSet& set, std::span<const std::byte> bytes, Frame& to, std::string* why) {
  const std::size_t around = set.header_size() + set.footer_size();
  if (bytes.size() < around)
    return flawed(Flaw::truncated, why, [&] {
      return "the packet has " + bytes_text(bytes.size()) + "; header and checksum alone take " +
             std::to_string(around);
    });
  const auto order = order_of(set, bytes.data());
  if (!order)
    return flawed(Flaw::garbage, why, [&] {
      const std::size_t size = set.sync_size();
      return "the packet begins with " + hex(header_field(set, set.sync_field, bytes.data(), set.order), size) +
             ", not with " + hex(set.sync, size);
    });
  const Announced announced = read_header(set, bytes.data(), *order);
  const std::size_t whole = around + announced.payload;
  if (announced.payload > set.most_payload)
    return flawed(Flaw::oversized, why, [&] {
      return "the header tells of " + bytes_text(announced.payload) + " of payload; at most " +
             std::to_string(set.most_payload) + " are allowed";
    });
  if (bytes.size() != whole)
    return flawed(bytes.size() < whole ? Flaw::truncated : Flaw::oversized, why, [&] {
      return "the packet has " + bytes_text(bytes.size()) + "; by its header it has " + std::to_string(whole);
    });
  to.order = *order;
  to.id = announced.id;
  to.header = bytes.first(set.header_size());
  to.payload = bytes.subspan(set.header_size(), announced.payload);
  if (set.checksum == Checksum::none) return Flaw::none;
  const auto summed = bytes.first(whole - set.footer_size());
  const std::uint64_t told = load_unsigned(bytes.data() + summed.size(), set.footer_size(), *order);
  const std::uint64_t right = checksum_of(set, summed);
  if (told == right) return Flaw::none;
  return flawed(Flaw::checksum, why, [&] {
    return "the checksum is " + hex(told, set.footer_size()) + "; " + hex(right, set.footer_size()) + " would be right";
  });
}

PacketReader::PacketReader(const MessageSet& set) : set_(set), header_(*set.header), kept_(set.messages.size()) {}

Flaw PacketReader::read(std::span<const std::byte> bytes, std::string* why) {
  message_ = {};
  Frame frame;
  const Flaw flaw = read_frame(set_, bytes, frame, why);
  if (flaw != Flaw::none && flaw != Flaw::checksum) return flaw;
  const MessageForm* const form = set_.find(frame.id, frame.payload.size());
  if (form == nullptr && flaw != Flaw::none) return flaw;
  if (form == nullptr)
    return flawed(Flaw::unknown_id, why, [&] {
      return "message id " + std::to_string(frame.id) + " is not in set " + std::string(set_.name);
    });
  Message& kept = kept_[form->index];
  if (kept.form() == nullptr) kept = Message(*form);
  order_ = frame.order;
  std::string* const more = flaw == Flaw::none ? why : nullptr;  // of two flaws the checksum says more
  if (!read_payload(*set_.header, frame.order, frame.header, header_.value(), more) ||
      !read_payload(*form, frame.order, frame.payload, kept.value(), more))
    return flaw == Flaw::none ? Flaw::payload : flaw;
  message_ = kept;
  message_.header = header_.value();
  return flaw;
}

bool write_packet(MessageRef header, MessageRef message, ByteOrder order, std::vector<std::byte>& to,
                  std::string* why) {
  const MessageSet& set = message.form->set();
  to.clear();
  bool good = write_payload(header, order, to, why) && write_payload(message, order, to, why);
  const std::size_t payload = to.size() - std::min(to.size(), set.header_size());
  if (good && payload > set.most_payload) {
    good = false;
    if (why != nullptr)
      *why = std::string(message.form->name) + " has " + bytes_text(payload) + " of payload; at most " +
             std::to_string(set.most_payload) + " are allowed";
  }
  if (!good) {
    to.clear();
    return false;
  }
  set_header_field(set, set.sync_field, to.data(), order, set.sync);
  set_header_field(set, set.id_field, to.data(), order, message.form->id);
  set_header_field(set, set.size_field, to.data(), order, payload);
  if (set.checksum != Checksum::none) append_unsigned(to, set.footer_size(), order, checksum_of(set, to));
  return true;
}

}  // namespace jarol::messages
