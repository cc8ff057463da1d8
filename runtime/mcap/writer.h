// Writes an MCAP file from its begin to its end: attachments, chunks with their indexes, and the summary by which
// readers seek. What is written is never changed: what a killed program leaves is readable up to its last chunk.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/files/appender.h"
#include "runtime/mcap/chunk.h"
#include "runtime/mcap/compression.h"
#include "runtime/mcap/message_index.h"

namespace jarol::mcap {

class Writer {
 public:
  /// The file stays the caller's. Throws std::system_error where it can't be written; so do the others.
  Writer(std::FILE* file, Compression compression, std::string_view library);

  void write(const Attachment& attachment);
  /// So that chunks need not describe their channels.
  void write(const std::vector<Schema>& schemas, const std::vector<Channel>& channels);
  void write(const Chunk& chunk);
  /// The summary; `schemas` and `channels` are those of all chunks.
  void end(const std::vector<Schema>& schemas, const std::vector<Channel>& channels);

  /// Written so far.
  std::uint64_t bytes() const { return file_.bytes(); }
  bool has_chunks() const { return chunks_ > 0; }

 private:
  std::uint64_t offset() const { return file_.bytes() + waiting_.size(); }
  void put_out(std::string_view bytes);
  void count(std::string_view bytes, std::uint32_t crc);
  void flush();

  Appender file_;
  Compression compression_;
  std::string waiting_;    // for the next flush
  std::uint32_t crc_ = 0;  // of all up to here
  std::uint32_t chunks_ = 0;
  Duration start_{}, end_{};           // of the first message of all and the last one
  std::vector<std::uint64_t> counts_;  // messages, per channel
  std::string chunk_indexes_;          // records, as a long recording has many
  std::string attachment_indexes_;     // records
  std::uint32_t attachments_ = 0;
  std::string head_, compressed_;  // memory that is used again
  MessageIndex index_;
};

}  // namespace jarol::mcap
