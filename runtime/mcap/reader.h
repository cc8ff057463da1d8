// Reads the records of an MCAP file one after the other, as they come or from a place on, with what is whole of a file
// that breaks off.
#pragma once

#include <fstream>
#include <string>
#include <string_view>

#include "runtime/mcap/records.h"

namespace jarol::mcap {

struct Record {
  Opcode opcode{};
  std::uint64_t offset = 0;
  std::string content;
};

class Reader {
 public:
  /// Throws FormatError, "is no MCAP file", std::system_error where it can't be read.
  explicit Reader(const std::string& path);

  std::uint64_t size() const { return size_; }
  /// Of the record that comes next, or of what breaks off.
  std::uint64_t offset() const { return offset_; }
  void seek(std::uint64_t offset) { offset_ = offset; }
  /// False: there is no whole record any more.
  bool next(Record& record);
  /// The bytes from there on, so many as there are.
  std::string bytes(std::uint64_t offset, std::uint64_t count);

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0, offset_ = 0;
};

/// A chunk that was read.
struct ReadChunk {
  Duration start{}, end{};
  std::string records;  // uncompressed
};

/// Throws FormatError where the chunk is not whole or its sum is another.
ReadChunk read_chunk(std::string_view content);

/// Calls visit(opcode, content, offset) for each record of a chunk. Throws FormatError.
template <class Visit>
void for_each_record(std::string_view records, Visit&& visit) {
  for (std::size_t at = 0; at < records.size();) {
    if (records.size() - at < record_head) throw FormatError("a record that breaks off");
    const auto opcode = static_cast<Opcode>(records[at]);
    std::uint64_t length = 0;
    std::memcpy(&length, records.data() + at + 1, sizeof length);
    if (length > records.size() - at - record_head) throw FormatError("a record that breaks off");
    visit(opcode, records.substr(at + record_head, length), at);
    at += record_head + length;
  }
}

/// Throws FormatError where it is no message index, or one of another length than it says.
void require_message_index(const Record& record);

/// The attachment, whose sum is checked. Throws FormatError.
Attachment read_attachment(std::string_view content);

}  // namespace jarol::mcap
