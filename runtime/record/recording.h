// A recording as it is read: of what run it is, which files that had read, and the messages of its topics. Of one that
// breaks off or is damaged it is what is whole up to there.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "runtime/mcap/reader.h"
#include "runtime/record/recording_format.h"
#include "runtime/record/recording_parts.h"

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
  std::size_t part = 0;  // index in Recording::parts
  std::uint64_t offset = 0;
  Duration start{}, end{};
  std::uint16_t min_channel = 0, max_channel = 0;
};

/// For messages about a chunk: the file, and the byte at which it begins there.
struct ChunkSpot {
  const std::string& path;
  std::uint64_t offset;
};

class Recording {
 public:
  /// With the chunk that it is in.
  using Visit = std::function<void(const mcap::Message& message, const ReadTopic& topic, const ChunkSpot& spot)>;

  /// With `visit` it goes through all of it, and shows it each message; else, where it is whole, only through the
  /// index at its end. The parts of one that is split are found beside the first. Throws LogError, "'path' ...", if it
  /// is no recording.
  explicit Recording(std::string path, const Visit& visit = {});

  const std::string& path() const { return path_; }
  /// Its files, one at least.
  const std::vector<std::string>& parts() const { return parts_; }
  const RecordingHeader& header() const { return header_; }
  const std::vector<RecordedFile>& files() const { return files_; }
  /// By the number of their channel.
  const std::map<std::uint16_t, ReadTopic>& topics() const { return topics_; }
  /// Null: it has none of that name.
  const ReadTopic* find(std::string_view topic) const;
  const std::vector<ReadPlace>& chunks() const { return chunks_; }

  /// The run has ended, and all that was recorded is there, whatever has happened to the index behind it.
  bool is_whole() const { return whole_; }
  /// Its last part is good up to that byte, and has so many.
  std::uint64_t good_until() const { return good_until_; }
  std::uint64_t size_of_last() const { return last_size_; }
  /// Where it breaks off, as in "at byte 100".
  std::string text_of_break() const;
  /// What follows the end of one that is whole, and is none of it, as in "goes on for 3 bytes after its end; ...";
  /// empty: nothing does.
  std::string text_of_rest() const;
  /// Of all parts, in bytes.
  std::uint64_t size() const { return sizes_before_ + last_size_; }

 private:
  void read_begin(mcap::Reader& reader);
  bool open_next_part(mcap::Reader& reader);
  void describe(mcap::Opcode opcode, std::string_view content);
  bool read_summary(mcap::Reader& reader);
  void read_chunks(mcap::Reader& reader, const Visit& visit);
  bool read_data(mcap::Reader& reader, const Visit& visit);
  void read_chunk(const mcap::Record& record, const Visit& visit);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::vector<std::string> parts_;
  RecordingHeader header_;
  std::vector<RecordedFile> files_;
  std::map<std::uint16_t, mcap::Schema> schemas_;
  std::map<std::uint16_t, ReadTopic> topics_;
  std::vector<ReadPlace> chunks_;
  bool whole_ = false;
  std::uint64_t good_until_ = 0, last_size_ = 0, sizes_before_ = 0;
};

/// Throws LogError: what stands in that chunk can't be there.
[[noreturn]] void fail_in_chunk(const ChunkSpot& spot, const std::string& what);

}  // namespace jarol
