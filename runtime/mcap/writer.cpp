#include "runtime/mcap/writer.h"

#include <algorithm>
#include <numeric>

#include "runtime/mcap/crc32.h"

namespace jarol::mcap {
namespace {

void put_head(std::string& to, Opcode opcode, std::uint64_t length) {
  put(to, static_cast<std::uint8_t>(opcode));
  put(to, length);
}

std::string index_record(const ChunkPlace& chunk) {
  std::string content, indexes;
  for (const Duration time : {chunk.start, chunk.end}) put(content, time);
  put(content, chunk.offset);
  put(content, chunk.length);
  for (const auto& [channel, offset] : chunk.indexes) {
    put(indexes, channel);
    put(indexes, offset);
  }
  put_text(content, indexes);
  put(content, chunk.index_length);
  put_text(content, chunk.compression);
  put(content, chunk.compressed);
  put(content, chunk.uncompressed);
  return record_of(Opcode::chunk_index, content);
}

}  // namespace

Writer::Writer(std::FILE* file, Compression compression, std::string_view library)
    : file_(file), compression_(compression) {
  std::string content;
  put_text(content, "");  // no profile
  put_text(content, library);
  put_out(magic);
  put_out(record_of(Opcode::header, content));
  flush();
}

void Writer::write(const Attachment& attachment) {
  const std::uint64_t offset = this->offset();
  std::string content;
  for (int i = 0; i < 2; ++i) put(content, std::uint64_t{0});  // its times
  put_text(content, attachment.name);
  put_text(content, attachment.media_type);
  put(content, static_cast<std::uint64_t>(attachment.data.size()));
  content += attachment.data;
  put(content, crc32(content));
  const std::string record = record_of(Opcode::attachment, content);
  put_out(record);
  flush();
  std::string index;
  for (const std::uint64_t number : {offset, std::uint64_t{record.size()}, std::uint64_t{0}, std::uint64_t{0},
                                     std::uint64_t{attachment.data.size()}})
    put(index, number);
  put_text(index, attachment.name);
  put_text(index, attachment.media_type);
  attachment_indexes_ += record_of(Opcode::attachment_index, index);
  ++attachments_;
}

void Writer::write(const std::vector<Schema>& schemas, const std::vector<Channel>& channels) {
  for (const Schema& schema : schemas) put_out(record_of(schema));
  for (const Channel& channel : channels) put_out(record_of(channel));
  flush();
}

void Writer::write(const Chunk& chunk) {
  const std::string_view records = chunk.records();
  std::string_view stored = records;
  Compression compression = compression_;
  if (compression != Compression::none) {
    compress(compression, records, compressed_);
    if (compressed_.size() < records.size())
      stored = compressed_;
    else
      compression = Compression::none;
  }
  const std::uint32_t crc = chunk.crc();
  ChunkPlace place{.start = chunk.start(),
                   .end = chunk.end(),
                   .offset = offset(),
                   .compression = std::string(name_of(compression)),
                   .compressed = stored.size(),
                   .uncompressed = records.size()};
  const std::uint64_t length = 8 + 8 + 8 + 4 + (4 + place.compression.size()) + 8 + stored.size();
  place.length = record_head + length;
  head_.clear();
  put_head(head_, Opcode::chunk, length);
  put(head_, place.start);
  put(head_, place.end);
  put(head_, place.uncompressed);
  put(head_, crc);
  put_text(head_, place.compression);
  put(head_, place.compressed);
  put_out(head_);
  const std::uint64_t indexes_at = offset() + stored.size();
  index_.make(records);
  for (const auto& [channel, at, messages] : index_.channels()) {
    if (channel >= counts_.size()) counts_.resize(channel + std::size_t{1});
    counts_[channel] += messages;
    place.indexes.emplace_back(channel, indexes_at + at);
  }
  place.index_length = index_.records().size();
  // all of it in one go
  count(stored, compression == Compression::none ? crc : crc32(stored));
  count(index_.records(), crc32(index_.records()));
  file_.append(waiting_, stored, index_.records());
  waiting_.clear();
  chunk_indexes_ += index_record(place);
  start_ = chunks_ == 0 ? place.start : std::min(start_, place.start);
  end_ = std::max(end_, place.end);
  ++chunks_;
}

void Writer::end(const std::vector<Schema>& schemas, const std::vector<Channel>& channels) {
  std::string data_end;
  put(data_end, crc_);
  put_out(record_of(Opcode::data_end, data_end));
  const std::uint64_t summary = offset();
  crc_ = 0;
  std::string offsets;
  const auto put_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    std::string content;
    put(content, static_cast<std::uint8_t>(opcode));
    put(content, offset());
    put(content, static_cast<std::uint64_t>(records.size()));
    offsets += record_of(Opcode::summary_offset, content);
    count(records, crc32(records));
    file_.append(waiting_, records);
    waiting_.clear();
  };
  std::string records;
  for (const Schema& schema : schemas) records += record_of(schema);
  put_group(Opcode::schema, records);
  records.clear();
  for (const Channel& channel : channels) records += record_of(channel);
  put_group(Opcode::channel, records);
  std::string counts, statistics;
  for (std::size_t channel = 0; channel < counts_.size(); ++channel) {
    if (counts_[channel] == 0) continue;
    put(counts, static_cast<std::uint16_t>(channel));
    put(counts, counts_[channel]);
  }
  put(statistics, std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}));
  put(statistics, static_cast<std::uint16_t>(schemas.size()));
  put(statistics, static_cast<std::uint32_t>(channels.size()));
  put(statistics, attachments_);
  put(statistics, std::uint32_t{0});  // metadata
  put(statistics, chunks_);
  put(statistics, start_);
  put(statistics, end_);
  put_text(statistics, counts);
  put_group(Opcode::statistics, record_of(Opcode::statistics, statistics));
  put_group(Opcode::chunk_index, chunk_indexes_);
  put_group(Opcode::attachment_index, attachment_indexes_);
  const std::uint64_t offsets_at = offset();
  put_out(offsets);
  std::string footer;
  put_head(footer, Opcode::footer, 8 + 8 + 4);
  put(footer, summary);
  put(footer, offsets_at);
  put(footer, crc32(footer, crc_));
  put_out(footer);
  put_out(magic);
  flush();
  file_.end();
}

void Writer::put_out(std::string_view bytes) {
  waiting_ += bytes;
  count(bytes, crc32(bytes));
}

void Writer::count(std::string_view bytes, std::uint32_t crc) { crc_ = joined_crc32(crc_, crc, bytes.size()); }

void Writer::flush() {
  file_.append(waiting_);
  waiting_.clear();
}

}  // namespace jarol::mcap
