#include "runtime/mcap/records.h"

namespace jarol::mcap {

std::string record_of(Opcode opcode, std::string_view content) {
  std::string record;
  record.reserve(record_head + content.size());
  put(record, static_cast<std::uint8_t>(opcode));
  put(record, static_cast<std::uint64_t>(content.size()));
  record += content;
  return record;
}

std::string record_of(const Schema& schema) {
  std::string content;
  put(content, schema.id);
  put_text(content, schema.name);
  put_text(content, schema.encoding);
  put_text(content, schema.text);
  return record_of(Opcode::schema, content);
}

std::string record_of(const Channel& channel) {
  std::string content;
  put(content, channel.id);
  put(content, channel.schema);
  put_text(content, channel.topic);
  put_text(content, channel.encoding);
  put_texts(content, channel.metadata);
  return record_of(Opcode::channel, content);
}

Schema read_schema(std::string_view content) {
  ByteCursor in(content);
  Schema schema;
  schema.id = in.number<std::uint16_t>();
  schema.name = in.text();
  schema.encoding = in.text();
  schema.text = in.text();
  return schema;
}

Channel read_channel(std::string_view content) {
  ByteCursor in(content);
  Channel channel;
  channel.id = in.number<std::uint16_t>();
  channel.schema = in.number<std::uint16_t>();
  channel.topic = in.text();
  channel.encoding = in.text();
  channel.metadata = in.texts();
  return channel;
}

Message read_message(std::string_view content) {
  constexpr std::size_t fields = message_head - record_head;
  if (content.size() < fields) throw FormatError("a message that ends before its data");
  ByteCursor in(content);
  Message message;
  message.channel = in.number<std::uint16_t>();
  message.sequence = in.number<std::uint32_t>();
  message.time = in.time();
  message.data = content.substr(fields);
  return message;
}

}  // namespace jarol::mcap
