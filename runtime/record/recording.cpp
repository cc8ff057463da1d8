#include "runtime/record/recording.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "graph/language/inputs.h"
#include "runtime/mcap/crc32.h"

namespace jarol {
namespace {

constexpr std::string_view old_format = "{\"schema\":\"jarol.log/1\"";

bool is_old_log(const std::string& path) {
  std::string begin(old_format.size(), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == old_format;
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
    size_ = reader.size();
    read_begin(reader);
    if (visit || !read_summary(reader)) read_chunks(reader, visit);
  } catch (const std::system_error& error) {
    throw LogError("can't read '" + path_ + "': " + error.code().message());
  } catch (const mcap::FormatError&) {
    if (is_old_log(path_))
      fail("is a log of jarol 0.1.0, before logs were MCAP recordings; replay it with that version, or run again");
    fail("is no recording; one comes from jarol run --record or --log");
  }
}

// The header of the file and the attachments, which a run writes first.
void Recording::read_begin(mcap::Reader& reader) {
  mcap::Record record;
  if (!reader.next(record) || record.opcode != mcap::Opcode::header) throw mcap::FormatError("no header");
  good_until_ = reader.offset();
  bool is_first = true;
  while (reader.next(record) && record.opcode == mcap::Opcode::attachment) {
    mcap::Attachment attachment;
    try {
      attachment = mcap::read_attachment(record.content);
    } catch (const mcap::FormatError&) {
      fail("is damaged at byte " + std::to_string(record.offset) + ", before what was recorded, and can't be replayed");
    }
    if (is_first) {
      if (attachment.name != RecordingHeader::attachment) throw mcap::FormatError("no recording");
      try {
        header_ = parse_header(attachment.data);
      } catch (const LogError&) { throw mcap::FormatError("no recording"); }
    } else {
      files_.push_back({std::move(attachment.name), std::move(attachment.data)});
    }
    is_first = false;
    good_until_ = reader.offset();
  }
  if (is_first) throw mcap::FormatError("no recording");
  for (const std::string& set : header_.overrides.set)
    if (names_plugins(set))
      fail("sets '" + set + "', and a recording names no code to load; it is none that jarol run has written");
  reader.seek(good_until_);
}

// False: there is none that is whole, and the file has to be gone through. Nothing has changed then.
bool Recording::read_summary(mcap::Reader& reader) {
  constexpr std::size_t footer_bytes = mcap::record_head + 8 + 8 + 4;
  if (size_ < good_until_ + footer_bytes + mcap::magic.size()) return false;
  const std::uint64_t footer_at = size_ - mcap::magic.size() - footer_bytes;
  const std::string end = reader.bytes(footer_at, footer_bytes + mcap::magic.size());
  if (!end.ends_with(mcap::magic) || static_cast<mcap::Opcode>(end[0]) != mcap::Opcode::footer) return false;
  std::map<std::uint16_t, mcap::Schema> schemas;
  std::map<std::uint16_t, ReadTopic> found;
  std::vector<ReadPlace> chunks;
  try {
    mcap::ByteCursor footer(std::string_view(end).substr(mcap::record_head));
    const auto begin = footer.number<std::uint64_t>();
    footer.number<std::uint64_t>();
    const auto crc = footer.number<std::uint32_t>();
    if (begin < good_until_ || begin > footer_at) return false;
    const std::string summary = reader.bytes(begin, footer_at - begin + footer_bytes - sizeof crc);
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
        ReadPlace place{0, 0, 0, 65535, 0};
        place.start = in.number<std::int64_t>();
        place.end = in.number<std::int64_t>();
        place.offset = in.number<std::uint64_t>();
        in.number<std::uint64_t>();
        for (mcap::ByteCursor indexes(in.text()); !indexes.at_end(); indexes.number<std::uint64_t>()) {
          const auto channel = indexes.number<std::uint16_t>();
          place.least_channel = std::min(place.least_channel, channel);
          place.most_channel = std::max(place.most_channel, channel);
        }
        chunks.push_back(place);
      }
    };
    mcap::for_each_record(std::string_view(summary).substr(0, footer_at - begin), read);
  } catch (const mcap::FormatError&) { return false; }
  schemas_ = std::move(schemas);
  topics_ = std::move(found);
  chunks_ = std::move(chunks);
  good_until_ = size_;
  return whole_ = true;
}

void Recording::read_chunks(mcap::Reader& reader, const Visit& visit) {
  mcap::Record record;
  bool ended = false;
  while (reader.next(record)) {
    if (record.opcode == mcap::Opcode::footer && ended) {
      whole_ = reader.bytes(reader.offset(), mcap::magic.size()) == mcap::magic;
      if (whole_) good_until_ = reader.offset() + mcap::magic.size();
      return;
    }
    if (ended) continue;  // the summary
    try {
      if (record.opcode == mcap::Opcode::chunk)
        read_chunk(record, visit);
      else if (record.opcode == mcap::Opcode::data_end)
        ended = true;
      else
        mcap::require_message_index(record);
    } catch (const mcap::FormatError&) {
      return;  // what follows can't be trusted
    }
    if (!ended) good_until_ = reader.offset();
  }
}

void Recording::read_chunk(const mcap::Record& record, const Visit& visit) {
  const mcap::ReadChunk chunk = mcap::read_chunk(record.content);
  ReadPlace place{record.offset, chunk.start, chunk.end, 65535, 0};
  mcap::for_each_record(chunk.records, [&](mcap::Opcode opcode, std::string_view content, std::size_t) {
    if (opcode == mcap::Opcode::schema) {
      mcap::Schema schema = mcap::read_schema(content);
      schemas_[schema.id] = std::move(schema);
    } else if (opcode == mcap::Opcode::channel) {
      mcap::Channel channel = mcap::read_channel(content);
      const auto schema = schemas_.find(channel.schema);
      if (schema == schemas_.end()) throw mcap::FormatError("a channel without a schema");
      topics_.emplace(channel.id, ReadTopic{channel, schema->second.name, schema->second.text});
    } else if (opcode == mcap::Opcode::message) {
      const mcap::Message message = mcap::read_message(content);
      const auto topic = topics_.find(message.channel);
      if (topic == topics_.end()) throw mcap::FormatError("a message of no channel");
      place.least_channel = std::min(place.least_channel, message.channel);
      place.most_channel = std::max(place.most_channel, message.channel);
      ++topic->second.messages;
      if (visit) visit(message, topic->second, record.offset);
    }
  });
  chunks_.push_back(place);
}

const ReadTopic* Recording::find(std::string_view topic) const {
  for (const auto& [id, t] : topics_)
    if (t.channel.topic == topic) return &t;
  return nullptr;
}

void Recording::fail(const std::string& what) const { throw LogError("'" + path_ + "' " + what); }

namespace {
std::vector<bool> only(const ReadTopic& topic) {
  std::vector<bool> wanted(topic.channel.id + std::size_t{1});
  wanted.back() = true;
  return wanted;
}
}  // namespace

void fail_in_chunk(const std::string& path, std::uint64_t offset, const std::string& what) {
  throw LogError("'" + path + "' has in the chunk at byte " + std::to_string(offset) + " " + what +
                 "; it is no recording that jarol run has written");
}

MessageCursor::MessageCursor(const Recording& recording, const ReadTopic& topic, Duration from)
    : MessageCursor(recording, only(topic), from) {}

MessageCursor::MessageCursor(const Recording& recording, std::vector<bool> wanted, Duration from)
    : recording_(recording), reader_(recording.path()), wanted_(std::move(wanted)), from_(from.count()) {
  wanted_.resize(65536);
  for (const ReadPlace& chunk : recording.chunks())
    if (chunk.end >= from_ && wants(chunk)) chunks_.push_back(chunk);
  next();
}

bool MessageCursor::wants(const ReadPlace& chunk) const {
  for (std::size_t channel = chunk.least_channel; channel <= chunk.most_channel; ++channel)
    if (wanted_[channel]) return true;
  return false;
}

void MessageCursor::open_chunk() {
  const std::uint64_t offset = chunks_[at_++].offset;
  reader_.seek(offset);
  mcap::Record record;
  try {
    if (!reader_.next(record) || record.opcode != mcap::Opcode::chunk) throw mcap::FormatError("no chunk");
    records_ = mcap::read_chunk(record.content).records;
    place_ = 0;
    require_whole();
  } catch (const mcap::FormatError& error) {
    throw LogError("'" + recording_.path() + "' is damaged: at byte " + std::to_string(offset) + " there is " +
                   error.what());
  }
}

// From here on it is believed.
void MessageCursor::require_whole() const {
  mcap::for_each_record(records_, [&](mcap::Opcode opcode, std::string_view content, std::size_t) {
    if (opcode == mcap::Opcode::message && !recording_.topics().contains(mcap::read_message(content).channel))
      throw mcap::FormatError("a message of no channel");
  });
}

void MessageCursor::next() {
  message_.reset();
  for (;;) {
    if (place_ == records_.size()) {
      if (at_ == chunks_.size()) return;
      open_chunk();
      continue;
    }
    std::uint64_t length = 0;
    std::memcpy(&length, records_.data() + place_ + 1, sizeof length);
    const std::string_view content = std::string_view(records_).substr(place_ + mcap::record_head, length);
    const bool is_message = static_cast<mcap::Opcode>(records_[place_]) == mcap::Opcode::message;
    place_ += mcap::record_head + length;
    if (!is_message) continue;
    const mcap::Message message = mcap::read_message(content);
    if (!wanted_[message.channel] || message.time < from_) continue;
    message_ = message;
    return;
  }
}

}  // namespace jarol
