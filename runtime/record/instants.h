// The messages of a recording instant by instant, those of one instant by topic.
#pragma once

#include <string>
#include <vector>

#include "runtime/record/message_cursor.h"

namespace jarol {

class RecordedInstants {
 public:
  struct Message {
    const ReadTopic* topic = nullptr;
    std::string data;
  };

  /// The recording outlives it. By channel which topics; instants before `from` are left out. `max_bytes`: of the
  /// messages of one instant.
  RecordedInstants(const Recording& recording, const std::vector<bool>& wanted, Duration from = {},
                   std::size_t max_bytes = std::size_t{2} << 30);

  /// False: there are no more. Throws LogError where an instant has more than it may.
  bool next();
  Duration instant() const { return instant_; }
  /// Of that instant, in bytewise order of topics; of one that comes twice as it was recorded.
  const std::vector<Message>& messages() const { return messages_; }

 private:
  const Recording& recording_;
  const std::size_t max_bytes_;
  std::vector<MessageCursor> cursors_;  // one for each of the streams that chunks are made of
  Duration instant_{};
  std::vector<Message> messages_;
};

/// Which channels have a topic that fits one of the patterns, with * for any part, separated by commas. Throws
/// InputError, "`option`: ...", where one fits none.
std::vector<bool> channels_named(const Recording& recording, const std::string& option, const std::string& patterns);

/// The channels of published values.
std::vector<bool> published_channels(const Recording& recording);

}  // namespace jarol
