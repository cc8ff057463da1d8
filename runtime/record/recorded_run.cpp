#include "runtime/record/recorded_run.h"

#include <algorithm>
#include <map>
#include <span>

#include "graph/values/type_of.h"
#include "runtime/record/cdr.h"

namespace jarol {
namespace {

constexpr std::size_t max_kept = 10'000'000;  // misses, and running digests

bool is_time(Duration instant) { return instant >= Duration{} && instant <= longest_duration; }
bool is_time(std::int64_t ns) { return is_time(Duration(ns)); }

std::span<const std::byte> bytes_of(const mcap::Message& message) {
  return {reinterpret_cast<const std::byte*>(message.data.data()), message.data.size()};
}

// What can't be so.
std::string wrong_with(const Miss& miss, std::size_t tasks) {
  if (miss.task >= tasks)
    return "a miss of task " + std::to_string(miss.task) + ", and there are " + std::to_string(tasks);
  if (miss.left_out > 1) return "a miss that is neither late nor left out";
  return miss.activation < 0 || miss.ended_after < Miss::unknown ? "a miss at a time below zero" : "";
}

std::string wrong_with(const RunningDigest& digest, const std::vector<RunningDigest>& before) {
  if (digest.exact > 1) return "a digest that is neither exact nor not";
  if (!is_time(digest.settled)) return "a digest at no time of a run";
  return !before.empty() && digest.settled < before.back().settled ? "a digest before the one before it" : "";
}

std::string wrong_with(const RestBegin& rest, bool has_begun) {
  if (!is_time(rest.begun)) return "a way to rest from no time of a run on";
  return has_begun ? "a second way to rest" : "";
}

std::string wrong_with(const LogEnd& end, const std::vector<RunningDigest>& before, bool has_ended) {
  if (has_ended) return "a second end";
  if (!is_time(end.covered) || !is_time(end.simulated)) return "an end at no time of a run";
  return !before.empty() && end.covered < before.back().settled ? "an end before its last digest" : "";
}

std::string wrong_with(const EndedBy&) { return ""; }

std::string wrong_with(const Gap& gap) {
  return !is_time(gap.from) || !is_time(gap.to) || gap.from > gap.to ? "a gap at no time of a run" : "";
}

}  // namespace

std::optional<LogEnd> find_end(const Recording& recording) {
  const ReadTopic* const topic = recording.find(topics::end);
  if (!recording.is_whole() || topic == nullptr) return std::nullopt;
  MessageCursor cursor(recording, *topic);
  if (cursor.message() == nullptr) return std::nullopt;
  LogEnd end;
  std::string wrong = decode_cdr(type_of<LogEnd>(), bytes_of(*cursor.message()), &end);
  const ChunkSpot spot = cursor.spot();
  cursor.next();
  wrong = wrong.empty() ? wrong_with(end, {}, cursor.message() != nullptr) : "an end that " + wrong;
  if (!wrong.empty()) fail_in_chunk(spot, wrong);
  return end;
}

std::vector<Gap> read_gaps(const Recording& recording) {
  std::vector<Gap> gaps;
  const ReadTopic* const topic = recording.find(topics::gaps);
  if (topic == nullptr) return gaps;
  for (MessageCursor cursor(recording, *topic); cursor.message() != nullptr; cursor.next()) {
    Gap gap;
    const ChunkSpot spot = cursor.spot();
    std::string wrong = decode_cdr(type_of<Gap>(), bytes_of(*cursor.message()), &gap);
    wrong = wrong.empty() ? wrong_with(gap) : "a gap that " + wrong;
    if (!wrong.empty()) fail_in_chunk(spot, wrong);
    gaps.push_back(gap);
  }
  return gaps;
}

RecordedRun::RecordedRun(std::string path) : path_(std::move(path)) {
  recording_ = std::make_unique<Recording>(path_, [this](const mcap::Message& message, const ReadTopic& topic,
                                                         const ChunkSpot& spot) { keep(message, topic, spot); });
  if (!recording_->is_whole()) end_.reset();
  // what follows the end may be another recording, or what else somebody has added: it is not what the run was
  if (const std::string rest = recording_->text_of_rest(); !rest.empty()) fail(rest);
  if (recording_->is_whole() && !end_) fail("does not say how its run ended; it is none that jarol run has written");
}

// What no run writes was made, and is refused.
void RecordedRun::keep(const mcap::Message& message, const ReadTopic& topic, const ChunkSpot& spot) {
  const std::string& name = topic.channel.topic;
  if (!topic.is_own()) return;
  const auto read = [&]<class T>(T value, const auto&... context) {
    if (const std::string wrong = decode_cdr(type_of<T>(), bytes_of(message), &value); !wrong.empty())
      fail_in_chunk(spot, "a message of '" + name + "' that " + wrong);
    if (const std::string wrong = wrong_with(value, context...); !wrong.empty()) fail_in_chunk(spot, wrong);
    return value;
  };
  if (name.starts_with(topics::taken)) {
    if (!is_time(message.time) || message.time < last_value_)
      fail_in_chunk(spot, "a value of '" + name.substr(topics::taken.size()) + "' before the one before it");
    last_value_ = message.time;
    ++values_;
  } else if (name == topics::misses) {
    // of tasks that the header names
    misses_.push_back(read(Miss{}, std::size_t{1} << 32));
  } else if (name == topics::digests) {
    digests_.push_back(read(RunningDigest{}, digests_));
  } else if (name == topics::rest) {
    rest_begun_ = Duration(read(RestBegin{}, rest_begun_.has_value()).begun);
  } else if (name == topics::ended) {
    ended_by_ = read(EndedBy{}).reason.view();
  } else if (name == topics::end) {
    end_ = read(LogEnd{}, digests_, end_.has_value());
  } else if (name == topics::gaps) {
    gaps_.push_back(read(Gap{}));
  } else if (name == topics::checkpoints) {
    if (!is_time(message.time) || (!saved_.empty() && message.time <= saved_.back()))
      fail_in_chunk(spot, "a checkpoint that is not after the one before it");
    saved_.push_back(message.time);
  }
  if (misses_.size() > max_kept || digests_.size() > max_kept || gaps_.size() > max_kept)
    fail("has more than " + std::to_string(max_kept) + " misses, digests or gaps; record a shorter run");
}

Duration RecordedRun::covered() const {
  if (end_) return Duration(end_->covered);
  Duration covered{};
  for (const RunningDigest& digest : digests_) covered = std::max(covered, Duration(digest.settled));
  return covered;
}

std::optional<Duration> RecordedRun::saved_before(Duration instant) const {
  const auto after = std::upper_bound(saved_.begin(), saved_.end(), instant);
  return after == saved_.begin() ? std::nullopt : std::optional(*(after - 1));
}

std::string RecordedRun::saved_at(Duration instant) const {
  const ReadTopic* const topic = recording_->find(topics::checkpoints);
  std::optional<MessageCursor> cursor;
  if (topic != nullptr) cursor.emplace(*recording_, *topic, instant);
  SavedState state;
  if (!cursor || cursor->message() == nullptr || cursor->message()->time != instant)
    fail("has no checkpoint at " + seconds_text(instant) + " s");
  if (const std::string wrong = decode_cdr(type_of<SavedState>(), bytes_of(*cursor->message()), &state); !wrong.empty())
    fail_in_chunk(cursor->spot(), "a checkpoint that " + wrong);
  return std::string(state.bytes);
}

std::vector<Miss> RecordedRun::begin(const Graph& graph, Duration from) {
  graph_ = &graph;
  const std::vector<std::size_t> inputs = logged_inputs(graph);
  std::map<std::string, std::size_t> communicator_of;
  for (const RecordingHeader::Input& logged : header().inputs) {
    const auto at = std::find_if(inputs.begin(), inputs.end(),
                                 [&](std::size_t i) { return graph.communicators[i].name == logged.name; });
    if (at == inputs.end()) fail_for_graph("has values of '" + logged.name + "', which takes none in");
    if (signature_of(*graph.communicators[*at].type) != logged.signature)
      fail_for_graph("has values of '" + logged.name + "', which have another type in");
    communicator_of[logged.name] = *at;
  }
  for (const std::size_t i : inputs)
    if (!communicator_of.contains(graph.communicators[i].name))
      fail_for_graph("has no values of '" + graph.communicators[i].name + "', which takes some in");
  std::vector<bool> wanted(65536);
  communicators_.assign(65536, 0);
  for (const auto& [id, topic] : recording_->topics()) {
    if (!topic.channel.topic.starts_with(topics::taken)) continue;
    const std::string name = topic.channel.topic.substr(topics::taken.size());
    const auto at = communicator_of.find(name);
    if (at == communicator_of.end())
      fail("has values of '" + name + "', of which its begin does not say what they are");
    wanted[id] = true;
    communicators_[id] = at->second;
  }
  std::map<std::string_view, std::uint32_t> tasks;
  for (std::uint32_t i = 0; i < graph.tasks.size(); ++i) tasks.emplace(graph.tasks[i].name, i);
  std::vector<Miss> misses = misses_;
  for (Miss& miss : misses) {
    if (const std::string wrong = wrong_with(miss, header().tasks.size()); !wrong.empty()) fail("has " + wrong);
    const std::string& name = header().tasks[miss.task];
    const auto task = tasks.find(name);
    if (task == tasks.end()) fail_for_graph("says that task '" + name + "' was late, which is not in");
    miss.task = task->second;
  }
  next_.emplace(*recording_, std::move(wanted), from);
  return misses;
}

bool RecordedRun::take(Duration instant, std::size_t communicator, void* value) {
  require_not_before(instant);
  const mcap::Message* const message = next_->message();
  if (message == nullptr || message->time != instant || communicators_[message->channel] != communicator) return false;
  const Type& type = *graph_->communicators[communicator].type;
  if (const std::string wrong = decode_cdr(type, bytes_of(*message), value); !wrong.empty())
    fail_in_chunk(next_->spot(), "a value of '" + name_of_next() + "' that " + wrong);
  next_->next();
  return true;
}

void RecordedRun::require_all_taken() const { require_not_before(covered()); }

const std::string& RecordedRun::name_of_next() const {
  return graph_->communicators[communicators_[next_->message()->channel]].name;
}

void RecordedRun::require_not_before(Duration instant) const {
  const mcap::Message* const message = next_->message();
  if (message == nullptr || message->time >= instant) return;
  fail_for_graph("has a value of '" + name_of_next() + "' at " + seconds_text(message->time) +
                 " s, when it takes none in");
}

void RecordedRun::fail_for_graph(const std::string& what) const {
  fail(what + " graph '" + graph_->name + "'; replay the graph of the run");
}

void RecordedRun::fail(const std::string& what) const { throw LogError("'" + path_ + "' " + what); }

}  // namespace jarol
