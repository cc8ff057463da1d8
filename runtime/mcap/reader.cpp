#include "runtime/mcap/reader.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "runtime/mcap/compression.h"
#include "runtime/mcap/crc32.h"

namespace jarol::mcap {

Reader::Reader(const std::string& path) : file_(path, std::ios::binary) {
  if (!file_) throw std::system_error(errno, std::generic_category());
  file_.seekg(0, std::ios::end);
  size_ = static_cast<std::uint64_t>(std::streamoff(file_.tellg()));
  if (bytes(0, magic.size()) != magic) throw FormatError("is no MCAP file");
  offset_ = magic.size();
}

std::string Reader::bytes(std::uint64_t offset, std::uint64_t count) {
  if (offset >= size_) return "";
  std::string read(std::min(count, size_ - offset), '\0');
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(offset));
  file_.read(read.data(), static_cast<std::streamsize>(read.size()));
  read.resize(static_cast<std::size_t>(file_.gcount()));
  return read;
}

bool Reader::next(Record& record) {
  const std::string head = bytes(offset_, record_head);
  if (head.size() < record_head) return false;
  std::uint64_t length = 0;
  std::memcpy(&length, head.data() + 1, sizeof length);
  if (length > size_ - offset_ - record_head) return false;
  record.opcode = static_cast<Opcode>(head[0]);
  record.offset = offset_;
  record.content = bytes(offset_ + record_head, length);
  if (record.content.size() < length) return false;
  offset_ += record_head + length;
  return true;
}

ReadChunk read_chunk(std::string_view content) {
  ByteCursor in(content);
  ReadChunk chunk;
  chunk.start = in.time();
  chunk.end = in.time();
  const auto size = in.number<std::uint64_t>();
  const auto crc = in.number<std::uint32_t>();
  const std::string_view compression = in.text();
  const std::string_view stored = in.long_bytes();
  if (!in.at_end()) throw FormatError("a chunk that goes on after its bytes");
  chunk.records = uncompress(compression, stored, size);
  if (crc32(chunk.records) != crc) throw FormatError("a chunk whose check sum is another");
  return chunk;
}

void require_message_index(const Record& record) {
  if (record.opcode != Opcode::message_index) throw FormatError("a record that does not belong there");
  ByteCursor in(record.content);
  in.number<std::uint16_t>();
  if (in.text().size() % sizeof(IndexEntry) != 0 || !in.at_end())
    throw FormatError("a message index of another length");
}

Attachment read_attachment(std::string_view content) {
  ByteCursor in(content);
  in.number<std::uint64_t>();
  in.number<std::uint64_t>();
  Attachment attachment;
  attachment.name = in.text();
  attachment.media_type = in.text();
  attachment.data = in.long_bytes();
  const auto crc = in.number<std::uint32_t>();
  if (!in.at_end() || crc32(content.substr(0, content.size() - sizeof crc)) != crc)
    throw FormatError("an attachment whose check sum is another");
  return attachment;
}

}  // namespace jarol::mcap
