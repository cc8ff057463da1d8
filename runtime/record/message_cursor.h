// Goes through messages of a recording in their order, and reads only the chunks that may hold some.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/record/recording.h"

namespace jarol {

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
  ChunkSpot spot() const { return {recording_.parts()[chunks_[at_ - 1].part], chunks_[at_ - 1].offset}; }
  void next();

 private:
  bool wants(const ReadPlace& chunk) const;
  void require_whole() const;
  void open_chunk();

  const Recording& recording_;
  mcap::Reader reader_;  // of the part that the open chunk is in
  std::size_t part_ = 0;
  std::vector<ReadPlace> chunks_;  // that may hold some
  std::vector<bool> wanted_;
  Duration from_;
  std::size_t at_ = 0;     // the chunk that follows
  std::string records_;    // of the chunk that is open
  std::size_t place_ = 0;  // in these
  std::optional<mcap::Message> message_;
};

}  // namespace jarol
