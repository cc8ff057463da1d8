#include "runtime/record/message_cursor.h"

namespace jarol {
namespace {

std::vector<bool> only(const ReadTopic& topic) {
  std::vector<bool> wanted(topic.channel.id + std::size_t{1});
  wanted.back() = true;
  return wanted;
}

}  // namespace

MessageCursor::MessageCursor(const Recording& recording, const ReadTopic& topic, Duration from)
    : MessageCursor(recording, only(topic), from) {}

MessageCursor::MessageCursor(const Recording& recording, std::vector<bool> wanted, Duration from)
    : recording_(recording), reader_(recording.path()), wanted_(std::move(wanted)), from_(from) {
  wanted_.resize(65536);
  for (const ReadPlace& chunk : recording.chunks())
    if (chunk.end >= from_ && wants(chunk)) chunks_.push_back(chunk);
  next();
}

bool MessageCursor::wants(const ReadPlace& chunk) const {
  for (std::size_t channel = chunk.min_channel; channel <= chunk.max_channel; ++channel)
    if (wanted_[channel]) return true;
  return false;
}

void MessageCursor::open_chunk() {
  const ReadPlace& place = chunks_[at_++];
  const std::string& path = recording_.parts()[place.part];
  mcap::Record record;
  try {
    if (place.part != part_) reader_ = mcap::Reader(path);
    part_ = place.part;
    reader_.seek(place.offset);
    if (!reader_.next(record) || record.opcode != mcap::Opcode::chunk) throw mcap::FormatError("no chunk");
    records_ = mcap::read_chunk(record.content).records;
    place_ = 0;
    require_whole();
  } catch (const mcap::FormatError& error) {
    throw DamagedLog("'" + path + "' is damaged: at byte " + std::to_string(place.offset) + " there is " +
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
