// The records of an MCAP file (mcap.dev/spec) as far as Jarol writes and reads them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/mcap/bytes.h"

namespace jarol::mcap {

/// A file begins and ends with it.
inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  attachment,
  attachment_index,
  statistics,
  metadata,
  metadata_index,
  summary_offset,
  data_end,
};

/// Opcode and length of what follows.
inline constexpr std::size_t record_head = 1 + 8;

struct Schema {
  std::uint16_t id = 0;  // 0 is none
  std::string name;
  std::string encoding;
  std::string text;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;  // of its messages
  Texts metadata{};
};

struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  Duration time{};
  std::string_view data;
};

/// Bytes of a message before its data, those of the record's head among them.
inline constexpr std::size_t message_head = record_head + 2 + 4 + 8 + 8;

/// As it stands in a file.
struct IndexEntry {
  std::int64_t time = 0;     // ns
  std::uint64_t offset = 0;  // within the records of the chunk
};

struct Attachment {
  std::string name;
  std::string media_type;
  std::string data;
};

/// Of a chunk that lies in a file.
struct ChunkPlace {
  Duration start{}, end{};                                         // of its first message and its last one
  std::uint64_t offset = 0, length = 0;                            // of its record in the file
  std::vector<std::pair<std::uint16_t, std::uint64_t>> indexes{};  // channel and offset of its message index
  std::uint64_t index_length = 0;                                  // of all of these
  std::string compression{};
  std::uint64_t compressed = 0, uncompressed = 0;
};

/// A whole record.
std::string record_of(Opcode opcode, std::string_view content);
std::string record_of(const Schema& schema);
std::string record_of(const Channel& channel);

Schema read_schema(std::string_view content);
Channel read_channel(std::string_view content);
Message read_message(std::string_view content);

}  // namespace jarol::mcap
