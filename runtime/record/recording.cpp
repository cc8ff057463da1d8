#include "runtime/record/recording.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include "graph/language/inputs.h"
#include "graph/text/shell_word.h"
#include "runtime/mcap/crc32.h"

namespace jarol {
namespace {

constexpr std::string_view old_format = "{\"schema\":\"jarol.log/1\"";

bool is_old_log(const std::string& path) {
  std::string begin(old_format.size(), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == old_format;
}

mcap::Attachment attachment_of(const mcap::Record& record, const std::string& path) {
  try {
    return mcap::read_attachment(record.content);
  } catch (const mcap::FormatError&) {
    throw DamagedLog("'" + path + "' is damaged at byte " + std::to_string(record.offset) +
                     ", before what was recorded, and can't be replayed");
  }
}

// The header of a file and the attachment that it begins with: what stands there says that a run wrote it.
RecordingHeader read_header(mcap::Reader& reader, const std::string& path) {
  mcap::Record record;
  if (!reader.next(record) || record.opcode != mcap::Opcode::header) throw mcap::FormatError("no header");
  if (!reader.next(record) || record.opcode != mcap::Opcode::attachment) throw mcap::FormatError("no recording");
  const mcap::Attachment attachment = attachment_of(record, path);
  if (attachment.name != RecordingHeader::attachment) throw mcap::FormatError("no recording");
  try {
    return parse_header(attachment.data);
  } catch (const LogError&) { throw mcap::FormatError("no recording"); }
}

constexpr std::size_t footer_bytes = mcap::record_head + 8 + 8 + 4;

// The footer and the mark behind it, or what stands there; less of a file that has less.
std::string end_of_file(mcap::Reader& reader) {
  const std::uint64_t bytes = std::min<std::uint64_t>(reader.size(), footer_bytes + mcap::magic.size());
  return reader.bytes(reader.size() - bytes, bytes);
}

// Where the summary begins, by the footer.
std::optional<std::uint64_t> summary_begin(std::string_view end) {
  if (end.size() != footer_bytes + mcap::magic.size() || !end.ends_with(mcap::magic)) return std::nullopt;
  if (static_cast<mcap::Opcode>(end.front()) != mcap::Opcode::footer) return std::nullopt;
  return mcap::ByteCursor(end.substr(mcap::record_head)).number<std::uint64_t>();
}

}  // namespace

Recording::Recording(std::string path, const Visit& visit) : path_(std::move(path)) {
  std::error_code none;
  const auto status = std::filesystem::status(path_, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail("is no regular file, and a recording is read twice; give a file");
  try {
    mcap::Reader reader(path_);
    note_input(path_);
    parts_.push_back(path_);
    last_size_ = reader.size();
    read_begin(reader);
    do {
      whole_ = false;
      if (visit || !read_summary(reader)) read_chunks(reader, visit);
    } while (whole_ && open_next_part(reader));
  } catch (const std::system_error& error) {
    throw LogError("can't read '" + path_ + "': " + error.code().message());
  } catch (const mcap::FormatError&) {
    if (is_old_log(path_))
      fail("is a log of jarol 0.1.0, before logs were MCAP recordings; replay it with that version, or run again");
    fail("is no recording; one comes from jarol run --record or --log");
  }
  // the part that follows was not begun, or is gone
  const ReadTopic* const end = find(topics::end);
  if (header_.split > 0 && (end == nullptr || end->messages == 0)) whole_ = false;
}

// The header of the file and the attachments, which a run writes first.
void Recording::read_begin(mcap::Reader& reader) {
  header_ = read_header(reader, path_);
  if (header_.part > 1)
    fail("is part " + std::to_string(header_.part) + " of a recording that is split; give its first part");
  for (const std::string& set : header_.overrides.set)
    if (names_plugins(set))
      fail("sets '" + set + "', and a recording names no code to load; it is none that jarol run has written");
  good_until_ = reader.offset();
  for (mcap::Record record; reader.next(record) && record.opcode == mcap::Opcode::attachment;) {
    mcap::Attachment file = attachment_of(record, path_);
    note_input(file.name);
    files_.push_back({std::move(file.name), std::move(file.data)});
    good_until_ = reader.offset();
  }
  reader.seek(good_until_);
}

// Of the run that the part before it is of.
bool Recording::open_next_part(mcap::Reader& reader) {
  if (header_.split == 0 || good_until_ != last_size_) return false;
  const std::string next = path_of_part(path_, parts_.size() + 1);
  std::error_code none;
  if (!std::filesystem::is_regular_file(next, none)) return false;
  try {
    mcap::Reader candidate(next);
    const RecordingHeader header = read_header(candidate, next);
    if (header.part != parts_.size() + 1 || header.follows != mark_of_part(parts_.back())) return false;
    reader = std::move(candidate);
  } catch (const mcap::FormatError&) { return false; } catch (const LogError&) {
    return false;
  }
  note_input(next);
  parts_.push_back(next);
  sizes_before_ += last_size_;
  last_size_ = reader.size();
  good_until_ = reader.offset();
  return true;
}

// False: there is none that is whole, and the file has to be gone through. Nothing has changed then.
bool Recording::read_summary(mcap::Reader& reader) {
  const std::string end = end_of_file(reader);
  const std::optional<std::uint64_t> begin = summary_begin(end);
  const std::uint64_t footer_at = last_size_ - end.size();
  if (!begin || *begin < good_until_ || *begin > footer_at) return false;
  std::map<std::uint16_t, mcap::Schema> schemas;
  std::map<std::uint16_t, ReadTopic> found;
  std::vector<ReadPlace> chunks;
  try {
    mcap::ByteCursor footer(std::string_view(end).substr(footer_bytes - sizeof(std::uint32_t)));
    const auto crc = footer.number<std::uint32_t>();
    const std::string summary = reader.bytes(*begin, footer_at - *begin + footer_bytes - sizeof crc);
    if (mcap::crc32(summary) != crc) return false;
    const auto read = [&](mcap::Opcode opcode, std::string_view content, std::size_t) {
      mcap::ByteCursor in(content);
      if (opcode == mcap::Opcode::schema) {
        mcap::Schema schema = mcap::read_schema(content);
        schemas[schema.id] = std::move(schema);
      } else if (opcode == mcap::Opcode::channel) {
        mcap::Channel channel = mcap::read_channel(content);
        const auto schema = schemas.find(channel.schema);
        if (schema == schemas.end()) throw mcap::FormatError("a channel without a schema");
        found.emplace(channel.id, ReadTopic{channel, schema->second.name, schema->second.text});
      } else if (opcode == mcap::Opcode::statistics) {
        in.number<std::uint64_t>();
        in.number<std::uint16_t>();
        for (int i = 0; i < 4; ++i) in.number<std::uint32_t>();
        for (int i = 0; i < 2; ++i) in.number<std::int64_t>();
        for (mcap::ByteCursor counts(in.text()); !counts.at_end();) {
          const auto topic = found.find(counts.number<std::uint16_t>());
          if (topic == found.end()) throw mcap::FormatError("messages of no channel");
          topic->second.messages = counts.number<std::uint64_t>();
        }
      } else if (opcode == mcap::Opcode::chunk_index) {
        ReadPlace place{parts_.size() - 1, 0, {}, {}, 65535, 0};
        place.start = in.time();
        place.end = in.time();
        place.offset = in.number<std::uint64_t>();
        in.number<std::uint64_t>();
        for (mcap::ByteCursor indexes(in.text()); !indexes.at_end(); indexes.number<std::uint64_t>()) {
          const auto channel = indexes.number<std::uint16_t>();
          place.min_channel = std::min(place.min_channel, channel);
          place.max_channel = std::max(place.max_channel, channel);
        }
        chunks.push_back(place);
      }
    };
    mcap::for_each_record(std::string_view(summary).substr(0, footer_at - *begin), read);
  } catch (const mcap::FormatError&) { return false; }
  schemas_.merge(schemas);
  for (const auto& [id, topic] : found) {
    const auto [at, is_new] = topics_.emplace(id, topic);
    if (!is_new) at->second.messages += topic.messages;
  }
  chunks_.insert(chunks_.end(), chunks.begin(), chunks.end());
  good_until_ = last_size_;
  return whole_ = true;
}

void Recording::read_chunks(mcap::Reader& reader, const Visit& visit) {
  if (read_data(reader, visit)) {
    for (mcap::Record record; reader.next(record);) {
      if (record.opcode != mcap::Opcode::footer) continue;  // of the summary
      if (reader.bytes(reader.offset(), mcap::magic.size()) != mcap::magic) break;
      good_until_ = reader.offset() + mcap::magic.size();
      whole_ = true;
      return;
    }
    // a summary that can't be gone through is no loss
    whole_ = end_of_file(reader).ends_with(mcap::magic);
  } else {
    // nor is the mark of the end of the data, where all up to it are good
    constexpr std::size_t data_end_bytes = mcap::record_head + 4;
    whole_ = summary_begin(end_of_file(reader)) == good_until_ + data_end_bytes;
  }
  if (whole_) good_until_ = last_size_;
}

// True: up to the end of the data.
bool Recording::read_data(mcap::Reader& reader, const Visit& visit) {
  for (mcap::Record record; reader.next(record);) {
    try {
      if (record.opcode == mcap::Opcode::chunk)
        read_chunk(record, visit);
      else if (record.opcode == mcap::Opcode::data_end)
        return true;
      else if (record.opcode == mcap::Opcode::schema || record.opcode == mcap::Opcode::channel)
        describe(record.opcode, record.content);
      else
        mcap::require_message_index(record);
    } catch (const mcap::FormatError&) {
      return false;  // what follows can't be trusted
    }
    good_until_ = reader.offset();
  }
  return false;
}

void Recording::describe(mcap::Opcode opcode, std::string_view content) {
  if (opcode == mcap::Opcode::schema) {
    mcap::Schema schema = mcap::read_schema(content);
    schemas_[schema.id] = std::move(schema);
    return;
  }
  const mcap::Channel channel = mcap::read_channel(content);
  const auto schema = schemas_.find(channel.schema);
  if (schema == schemas_.end()) throw mcap::FormatError("a channel without a schema");
  topics_.emplace(channel.id, ReadTopic{channel, schema->second.name, schema->second.text});
}

void Recording::read_chunk(const mcap::Record& record, const Visit& visit) {
  const mcap::ReadChunk chunk = mcap::read_chunk(record.content);
  ReadPlace place{parts_.size() - 1, record.offset, chunk.start, chunk.end, 65535, 0};
  const ChunkSpot spot{parts_.back(), record.offset};
  mcap::for_each_record(chunk.records, [&](mcap::Opcode opcode, std::string_view content, std::size_t) {
    if (opcode == mcap::Opcode::schema || opcode == mcap::Opcode::channel) {
      describe(opcode, content);
    } else if (opcode == mcap::Opcode::message) {
      const mcap::Message message = mcap::read_message(content);
      const auto topic = topics_.find(message.channel);
      if (topic == topics_.end()) throw mcap::FormatError("a message of no channel");
      place.min_channel = std::min(place.min_channel, message.channel);
      place.max_channel = std::max(place.max_channel, message.channel);
      ++topic->second.messages;
      if (visit) visit(message, topic->second, spot);
    }
  });
  chunks_.push_back(place);
}

std::string Recording::text_of_break() const {
  const std::string byte = "at byte " + std::to_string(good_until_);
  if (header_.split == 0) return byte;
  if (good_until_ < last_size_ || last_size_ == 0) return byte + " of '" + parts_.back() + "'";
  return "after '" + parts_.back() + "', and there is no '" + path_of_part(path_, parts_.size() + 1) +
         "' that follows it";
}

std::string Recording::text_of_rest() const {
  const std::uint64_t more = last_size_ - good_until_;
  if (!whole_ || more == 0) return "";
  return "goes on for " + std::to_string(more) + (more == 1 ? " byte" : " bytes") +
         " after its end; what was recorded is: head -c " + std::to_string(good_until_) + " " +
         shell_word(parts_.back());
}

const ReadTopic* Recording::find(std::string_view topic) const {
  for (const auto& [id, t] : topics_)
    if (t.channel.topic == topic) return &t;
  return nullptr;
}

void Recording::fail(const std::string& what) const { throw LogError("'" + path_ + "' " + what); }

void fail_in_chunk(const ChunkSpot& spot, const std::string& what) {
  throw LogError("'" + spot.path + "' has in the chunk at byte " + std::to_string(spot.offset) + " " + what +
                 "; it is no recording that jarol run has written");
}

}  // namespace jarol
