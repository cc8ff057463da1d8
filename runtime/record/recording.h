// A recording as it is read: of what run it is, which files that had read, and the messages of its topics. Of one that
// breaks off or is damaged it is what is whole up to there.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/mcap/reader.h"
#include "runtime/record/recording_format.h"
#include "runtime/record/recording_writer.h"

namespace jarol {

/// A topic of a recording.
struct ReadTopic {
  mcap::Channel channel;
  std::string schema_name, schema;
  std::uint64_t messages = 0;
  bool is_own() const { return channel.topic.starts_with(topics::own); }
};

/// A chunk, and where it lies.
struct ReadPlace {
  std::uint64_t offset = 0;
  std::int64_t start = 0, end = 0;  // ns
  std::uint16_t least_channel = 0, most_channel = 0;
};

class Recording {
 public:
  /// With the offset of its chunk.
  using Visit = std::function<void(const mcap::Message& message, const ReadTopic& topic, std::uint64_t offset)>;

  /// With `visit` it goes through the whole file, and shows it each message; else, of a file that is whole, only
  /// through the index at its end. Throws LogError, "'path' ...", if it is no recording.
  explicit Recording(std::string path, const Visit& visit = {});

  const std::string& path() const { return path_; }
  const RecordingHeader& header() const { return header_; }
  const std::vector<RecordedFile>& files() const { return files_; }
  /// By the number of their channel.
  const std::map<std::uint16_t, ReadTopic>& topics() const { return topics_; }
  /// Null: it has none of that name.
  const ReadTopic* find(std::string_view topic) const;
  const std::vector<ReadPlace>& chunks() const { return chunks_; }

  /// Up to the mark at its end: the run has ended, and all was written.
  bool is_whole() const { return whole_; }
  /// It is good up to that byte.
  std::uint64_t good_until() const { return good_until_; }
  std::uint64_t size() const { return size_; }

 private:
  void read_begin(mcap::Reader& reader);
  bool read_summary(mcap::Reader& reader);
  void read_chunks(mcap::Reader& reader, const Visit& visit);
  void read_chunk(const mcap::Record& record, const Visit& visit);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  RecordingHeader header_;
  std::vector<RecordedFile> files_;
  std::map<std::uint16_t, mcap::Schema> schemas_;
  std::map<std::uint16_t, ReadTopic> topics_;
  std::vector<ReadPlace> chunks_;
  bool whole_ = false;
  std::uint64_t good_until_ = 0, size_ = 0;
};

/// Throws LogError: what stands in that chunk can't be there.
[[noreturn]] void fail_in_chunk(const std::string& path, std::uint64_t offset, const std::string& what);

/// The messages of some topics of a recording, chunk by chunk. Throws LogError where a chunk is damaged.
class MessageCursor {
 public:
  /// The recording outlives it. `wanted`: by channel; those from `from` on.
  MessageCursor(const Recording& recording, std::vector<bool> wanted, Duration from = {});
  /// Of that topic alone.
  MessageCursor(const Recording& recording, const ReadTopic& topic, Duration from = {});

  /// Null: there are no more. What it points to holds until `next`.
  const mcap::Message* message() const { return message_ ? &*message_ : nullptr; }
  /// The chunk that it is in.
  std::uint64_t chunk_offset() const { return chunks_[at_ - 1].offset; }
  void next();

 private:
  bool wants(const ReadPlace& chunk) const;
  void require_whole() const;
  void open_chunk();

  const Recording& recording_;
  mcap::Reader reader_;
  std::vector<ReadPlace> chunks_;  // that may hold some
  std::vector<bool> wanted_;
  std::int64_t from_;
  std::size_t at_ = 0;     // the chunk that follows
  std::string records_;    // of the chunk that is open
  std::size_t place_ = 0;  // in these
  std::optional<mcap::Message> message_;
};

}  // namespace jarol
