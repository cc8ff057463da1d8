#include "tests/distributers/messages/random_message.h"

#include "distributers/messages/json.h"
#include "distributers/messages/packet.h"
#include "distributers/messages/payload.h"

namespace jarol::messages {
namespace {

using Random = std::mt19937_64;

void fill_bytes(void* to, std::size_t size, Random& random) {
  auto* const bytes = static_cast<unsigned char*>(to);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(random());
}

// Nothing, or a message that may stand in the field.
InlineMessage random_inline(const MessageSet& set, const FieldDescriptor& field, Random& random, int depth) {
  InlineMessage made;
  if (random() % 4 == 0) return made;
  const MessageDescriptor* descriptor = nullptr;
  while (descriptor == nullptr) {
    const std::uint32_t id =
        field.ids.empty() ? set.messages[random() % set.messages.size()]->id : field.ids[random() % field.ids.size()];
    descriptor = set.find_nested(id);
  }
  if (!put_inline(random_message(*descriptor, random, depth - 1), made)) return {};
  return made;
}

void fill(const MessageSet& set, const FieldDescriptor& field, void* to, Random& random, int depth) {
  switch (field.wire) {
    case Wire::plaintext: {
      const std::size_t length = random() % 20;
      fill_bytes(static_cast<String*>(to)->resize(length), length, random);
      return;
    }
    case Wire::rawdata:
    case Wire::rest: {
      auto& bytes = *static_cast<Sequence<std::uint8_t>*>(to);
      bytes.resize(random() % 20);
      fill_bytes(bytes.data(), bytes.size(), random);
      return;
    }
    case Wire::message:
      if (depth > 0) *static_cast<InlineMessage*>(to) = random_inline(set, field, random, depth);
      return;
    case Wire::message_list: {
      auto& list = *static_cast<Sequence<InlineMessage>*>(to);
      if (depth > 0) list.resize(random() % 4);
      for (InlineMessage& element : list) element = random_inline(set, field, random, depth);
      return;
    }
    default: fill_bytes(to, size_of(field.wire) * std::max(field.count, 1U), random);
  }
}

std::string round_trip(const Message& message, ByteOrder order, PacketReader& reader, Random& random) {
  const MessageDescriptor& descriptor = *message.descriptor();
  const std::string name = std::string(descriptor.name) + ": ";
  std::string why;
  std::vector<std::byte> bytes, again;
  if (!write_packet(random_message(*descriptor.set().header, random), message, order, bytes, &why)) return name + why;
  if (reader.read(bytes, &why) != PacketError::none) return name + why;
  if (reader.message().descriptor != &descriptor) return name + "read as another message";
  if (!write_packet(reader.header(), reader.message(), order, again, &why)) return name + why;
  if (again != bytes) return name + "other bytes";
  Message from_text(descriptor);
  if (!from_json(to_json(reader.message()), from_text, why)) return name + why;
  if (!write_packet(reader.header(), from_text, order, again, &why)) return name + why;
  return again == bytes ? "" : name + "other bytes after JSON";
}

}  // namespace

Message random_message(const MessageDescriptor& descriptor, Random& random, int depth) {
  Message message(descriptor);
  for (const FieldDescriptor& field : descriptor.fields)
    fill(descriptor.set(), field, static_cast<std::byte*>(message.value()) + field.offset, random, depth);
  return message;
}

std::string round_trip(const MessageSet& set, Random& random, int times) {
  PacketReader reader(set);
  for (const MessageDescriptor* descriptor : set.messages)
    for (int i = 0; i < times; ++i) {
      const ByteOrder order = !set.either_order ? set.order : random() % 2 == 0 ? ByteOrder::little : ByteOrder::big;
      // a rest of the packet may make it the size of another message, or too long
      const Message message = random_message(*descriptor, random);
      std::vector<std::byte> payload;
      if (write_payload(message, order, payload) && payload.size() > set.max_payload) continue;
      if (std::string wrong = round_trip(message, order, reader, random); !wrong.empty()) return wrong;
    }
  return "";
}

}  // namespace jarol::messages
