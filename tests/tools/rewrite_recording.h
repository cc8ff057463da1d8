// Writes a recording again, message by message, with another one's content or without some; all its check sums are
// right.
#pragma once

#include <cstdio>
#include <cstring>
#include <functional>
#include <string>

#include "runtime/mcap/reader.h"
#include "runtime/mcap/writer.h"

namespace command {

inline std::byte* copy_message(const jarol::mcap::Message& message, jarol::mcap::Chunk& chunk) {
  std::byte* const data = chunk.add_message(message.channel, message.sequence, message.time, message.data.size());
  std::memcpy(data, message.data.data(), message.data.size());
  return data;
}

using EachMessage = std::function<void(const jarol::mcap::Message&, jarol::mcap::Chunk&)>;

/// `each` puts what shall stand in the place of a message.
inline void rewrite_recording(const std::string& from, const std::string& to, const EachMessage& each) {
  using namespace jarol;
  std::FILE* const file = std::fopen(to.c_str(), "wb");
  mcap::Writer writer(file, mcap::Compression::lz4, "jarol");
  std::vector<mcap::Schema> schemas;
  std::vector<mcap::Channel> channels;
  mcap::Reader reader(from);
  for (mcap::Record record; reader.next(record) && record.opcode != mcap::Opcode::data_end;) {
    if (record.opcode == mcap::Opcode::attachment) writer.write(mcap::read_attachment(record.content));
    if (record.opcode != mcap::Opcode::chunk) continue;
    const mcap::ReadChunk read = mcap::read_chunk(record.content);
    mcap::Chunk chunk;
    mcap::for_each_record(read.records, [&](mcap::Opcode opcode, std::string_view content, std::size_t at) {
      if (opcode == mcap::Opcode::message) return each(mcap::read_message(content), chunk);
      chunk.add(std::string_view(read.records).substr(at, mcap::record_head + content.size()));
      if (opcode == mcap::Opcode::schema) schemas.push_back(mcap::read_schema(content));
      if (opcode == mcap::Opcode::channel) channels.push_back(mcap::read_channel(content));
    });
    writer.write(chunk);
  }
  writer.end(schemas, channels);
  std::fclose(file);
}

}  // namespace command
