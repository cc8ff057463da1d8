#include "runtime/mcap/verify.h"

#include <algorithm>
#include <map>
#include <optional>

#include "runtime/mcap/crc32.h"
#include "runtime/mcap/reader.h"

namespace jarol::mcap {
namespace {

class Verifier {
 public:
  explicit Verifier(const std::string& path) : reader_(path) {}

  std::vector<std::string> run() {
    Record record;
    while (problems_.size() < max && reader_.next(record)) {
      if (!summary_at_) {
        look_at_data(record);
      } else if (record.opcode == Opcode::footer) {
        look_at_footer(record);
        return problems_;
      } else {
        look_at_summary(record);
      }
    }
    if (problems_.size() < max) add(reader_.offset(), "it breaks off");
    return problems_;
  }

 private:
  static constexpr std::size_t max = 20;

  void add(std::uint64_t offset, const std::string& what) {
    problems_.push_back("at byte " + std::to_string(offset) + " " + what);
  }

  void look_at_data(const Record& record) {
    try {
      switch (record.opcode) {
        case Opcode::header:
        case Opcode::schema:
        case Opcode::channel: break;
        case Opcode::attachment: read_attachment(record.content); break;
        case Opcode::chunk: look_at_chunk(record); break;
        case Opcode::message_index: look_at_index(record); break;
        case Opcode::data_end: look_at_data_end(record); break;
        default: add(record.offset, "there is a record that does not belong there");
      }
    } catch (const FormatError& error) { add(record.offset, std::string("there is ") + error.what()); }
  }

  void require_all_indexed() {
    for (const auto& [channel, entries] : entries_)
      add(chunks_.back().offset,
          "the chunk has messages of channel " + std::to_string(channel) + " and no index of them");
    entries_.clear();
  }

  void look_at_chunk(const Record& record) {
    require_all_indexed();
    const ReadChunk chunk = read_chunk(record.content);
    Duration start{}, end{};
    bool any = false;
    for_each_record(chunk.records, [&](Opcode opcode, std::string_view content, std::size_t offset) {
      if (opcode != Opcode::message) return;
      const Message message = read_message(content);
      entries_[message.channel].push_back({message.time.count(), offset});
      start = any ? std::min(start, message.time) : message.time;
      end = any ? std::max(end, message.time) : message.time;
      any = true;
      ++messages_;
    });
    if (chunk.start != start || chunk.end != end) add(record.offset, "a chunk has other times than it says");
    chunks_.push_back({.start = chunk.start,
                       .end = chunk.end,
                       .offset = record.offset,
                       .length = record_head + record.content.size()});
  }

  void look_at_index(const Record& record) {
    require_message_index(record);
    ByteCursor in(record.content);
    const auto channel = in.number<std::uint16_t>();
    const std::string_view bytes = in.text();
    const auto at = entries_.find(channel);
    const bool right = at != entries_.end() && bytes.size() == at->second.size() * sizeof(IndexEntry) &&
                       std::memcmp(bytes.data(), at->second.data(), bytes.size()) == 0;
    if (!right)
      add(record.offset, "an index has other messages of channel " + std::to_string(channel) + " than its chunk");
    entries_.erase(channel);
  }

  void look_at_data_end(const Record& record) {
    require_all_indexed();
    summary_at_ = record.offset + record_head + record.content.size();
    if (ByteCursor(record.content).number<std::uint32_t>() != crc_of(0, record.offset) ||
        record.content.size() != sizeof(std::uint32_t))
      add(record.offset, "the check sum of all before is another");
  }

  void look_at_summary(const Record& record) {
    if (record.opcode == Opcode::chunk_index) look_at_chunk_index(record);
    if (record.opcode != Opcode::statistics) return;
    if (ByteCursor(record.content).number<std::uint64_t>() != messages_)
      add(record.offset, "the number of messages is another");
  }

  void look_at_chunk_index(const Record& record) {
    ByteCursor in(record.content);
    const std::size_t i = indexed_++;
    const Duration start = in.time(), end = in.time();
    const auto offset = in.number<std::uint64_t>(), length = in.number<std::uint64_t>();
    if (i >= chunks_.size() || chunks_[i].start != start || chunks_[i].end != end || chunks_[i].offset != offset ||
        chunks_[i].length != length)
      add(record.offset, "an index is of no chunk that is there");
  }

  void look_at_footer(const Record& record) {
    if (indexed_ != chunks_.size()) add(record.offset, "the file has chunks that its index lacks");
    ByteCursor in(record.content);
    const auto summary = in.number<std::uint64_t>();
    in.number<std::uint64_t>();
    const std::uint64_t sum_at = record.offset + record_head + 16;
    if (summary != *summary_at_ || record.content.size() != 20 ||
        in.number<std::uint32_t>() != crc_of(*summary_at_, sum_at))
      add(record.offset, "the check sum of the summary is another");
    if (reader_.bytes(reader_.offset(), magic.size()) != magic) add(reader_.offset(), "the mark of the end is another");
    const std::uint64_t end = reader_.offset() + magic.size();
    if (reader_.size() > end) add(end, "there is more after the end");
  }

  std::uint32_t crc_of(std::uint64_t from, std::uint64_t to) {
    constexpr std::uint64_t piece = std::uint64_t{1} << 20;
    std::uint32_t crc = 0;
    for (; from < to; from += piece) crc = crc32(reader_.bytes(from, std::min(piece, to - from)), crc);
    return crc;
  }

  Reader reader_;
  std::vector<std::string> problems_;
  std::vector<ChunkPlace> chunks_;
  std::map<std::uint16_t, std::vector<IndexEntry>> entries_;  // of the newest chunk, not yet found in an index
  std::uint64_t messages_ = 0;
  std::size_t indexed_ = 0;
  std::optional<std::uint64_t> summary_at_;
};

}  // namespace

std::vector<std::string> verify(const std::string& path) {
  try {
    return Verifier(path).run();
  } catch (const FormatError& error) {
    if (std::string_view(error.what()) == "is no MCAP file") throw;
    return {std::string("there is ") + error.what()};
  }
}

}  // namespace jarol::mcap
