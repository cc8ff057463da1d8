#include "runtime/record/instants.h"

#include <fnmatch.h>

#include <algorithm>
#include <sstream>

#include "graph/language/problems.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {
constexpr std::size_t channels = 65536;

// What a replay needs is recorded apart from what is published and what happens beside that.
bool is_of_inputs(const ReadTopic& topic) {
  const std::string& name = topic.channel.topic;
  return topic.is_own() && name != topics::events && name != topics::gaps && !name.starts_with(topics::truth);
}
}  // namespace

RecordedInstants::RecordedInstants(const Recording& recording, const std::vector<bool>& wanted, Duration from,
                                   std::size_t max_bytes)
    : recording_(recording), max_bytes_(max_bytes) {
  cursors_.reserve(2);  // what a cursor shows lies in it
  for (const bool of_inputs : {true, false}) {
    std::vector<bool> some(channels);
    bool any = false;
    for (const auto& [id, topic] : recording.topics())
      if (wanted[id] && is_of_inputs(topic) == of_inputs) some[id] = any = true;
    if (any) cursors_.emplace_back(recording, std::move(some), from);
  }
}

bool RecordedInstants::next() {
  messages_.clear();
  bool any = false;
  for (const MessageCursor& cursor : cursors_) {
    if (cursor.message() == nullptr) continue;
    const Duration instant = cursor.message()->time;
    instant_ = any ? std::min(instant_, instant) : instant;
    any = true;
  }
  std::size_t bytes = 0;
  for (MessageCursor& cursor : cursors_)
    for (const mcap::Message* m = cursor.message(); m != nullptr && Duration(m->time) <= instant_;
         cursor.next(), m = cursor.message()) {
      bytes += sizeof(Message) + m->data.size();
      if (bytes > max_bytes_)
        fail_in_chunk(cursor.spot(), "an instant, " + seconds_text(instant_) + " s, of more than " +
                                         std::to_string(max_bytes_) + " bytes");
      messages_.push_back({&recording_.topics().at(m->channel), std::string(m->data)});
    }
  std::stable_sort(messages_.begin(), messages_.end(),
                   [](const Message& a, const Message& b) { return a.topic->channel.topic < b.topic->channel.topic; });
  return any;
}

std::vector<bool> channels_named(const Recording& recording, const std::string& option, const std::string& patterns) {
  std::vector<bool> named(channels);
  std::istringstream words(patterns + ",");
  for (std::string word; std::getline(words, word, ',');) {
    bool fits = false;
    for (const auto& [id, topic] : recording.topics())
      if (fnmatch(word.c_str(), topic.channel.topic.c_str(), 0) == 0) named[id] = fits = true;
    if (fits) continue;
    std::vector<std::string> names;
    for (const auto& [id, topic] : recording.topics()) names.push_back(topic.channel.topic);
    throw InputError(option + ": the recording has no topic '" + word + "'" + did_you_mean(word, names) +
                     "; it has: " + list_of(names));
  }
  return named;
}

std::vector<bool> published_channels(const Recording& recording) {
  std::vector<bool> published(channels);
  for (const auto& [id, topic] : recording.topics()) published[id] = !topic.is_own();
  return published;
}

}  // namespace jarol
