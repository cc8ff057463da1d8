#include "distributers/session/recorded_events.h"

#include <functional>
#include <span>

#include "graph/values/type_of.h"
#include "runtime/record/cdr.h"
#include "runtime/record/instants.h"

namespace jarol {
namespace {

// Of a topic of ours, in their order. Throws LogError.
template <class T>
void each(const Recording& recording, std::string_view name, const std::function<void(Duration, const T&)>& take) {
  const ReadTopic* const topic = recording.find(name);
  if (topic == nullptr) return;
  for (MessageCursor cursor(recording, *topic); cursor.message() != nullptr; cursor.next()) {
    T value;
    const std::string_view data = cursor.message()->data;
    if (const std::string wrong =
            decode_cdr(type_of<T>(), {reinterpret_cast<const std::byte*>(data.data()), data.size()}, &value);
        !wrong.empty())
      throw LogError("'" + recording.path() + "' has a message of '" + std::string(name) + "' that " + wrong +
                     "; it is no recording that this jarol has written");
    take(cursor.message()->time, value);
  }
}

void each_event(const Recording& recording, const std::function<void(Duration, const RecordedEvent&)>& take) {
  each<RecordedEvent>(recording, topics::events, take);
}

}  // namespace

std::string words_of(const TimedEvent& event) {
  switch (event.kind) {
    case RunEvent::Kind::fault: break;
    case RunEvent::Kind::rest_begun: return "begins to bring the vehicle to rest";
    case RunEvent::Kind::at_rest: return "the vehicle is at rest";
    case RunEvent::Kind::mishap: return to_text(RunVerdict::VehicleMishap{event.task, event.cause});
  }
  return event.cause;
}

RecordedEvents read_events(const Recording& recording) {
  RecordedEvents read;
  each_event(recording, [&](Duration instant, const RecordedEvent& event) {
    if (read.events.size() == RecordedEvents::max)
      ++read.more;
    else
      read.events.push_back(
          {instant, event.kind, event.activation, std::string(event.task.view()), std::string(event.cause.view())});
  });
  return read;
}

std::vector<RunVerdict::VehicleMishap> read_mishaps(const Recording& recording) {
  std::vector<RunVerdict::VehicleMishap> mishaps;
  each_event(recording, [&](Duration, const RecordedEvent& event) {
    if (event.kind == RunEvent::Kind::mishap)
      mishaps.push_back({std::string(event.task.view()), std::string(event.cause.view())});
  });
  return mishaps;
}

std::optional<RecordedRest> read_rest(const Recording& recording) {
  std::optional<RecordedRest> rest;
  each_event(recording, [&](Duration instant, const RecordedEvent& event) {
    if (event.kind == RunEvent::Kind::rest_begun) rest = RecordedRest{instant, false};
    if (event.kind == RunEvent::Kind::at_rest && rest) rest->reached = true;
  });
  return rest;
}

std::vector<RunningDigest> read_digests(const Recording& recording) {
  std::vector<RunningDigest> digests;
  each<RunningDigest>(recording, topics::digests,
                      [&](Duration, const RunningDigest& digest) { digests.push_back(digest); });
  return digests;
}

std::string_view words_of(const std::optional<RecordedRest>& rest, bool is_whole) {
  if (!rest || (!rest->reached && !is_whole)) return "not known";
  return rest->reached ? "at rest" : "NOT AT REST";
}

std::string read_ended_by(const Recording& recording) {
  std::string reason;
  each<EndedBy>(recording, topics::ended, [&](Duration, const EndedBy& ended) { reason = ended.reason.view(); });
  return reason;
}

}  // namespace jarol
