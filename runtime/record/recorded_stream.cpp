#include "runtime/record/recorded_stream.h"

#include <algorithm>
#include <utility>

#include "graph/values/type_of.h"

namespace jarol {

RecordedStream::RecordedStream(ChunkQueue& queue, Pressure pressure, const std::vector<mcap::Schema>& schemas,
                               const std::vector<std::optional<RecordedTopic>>& topics,
                               const std::vector<RecordedTopic>& beside)
    : queue_(queue), pressure_(pressure), chunk_(queue.empty_chunk()) {
  std::vector<bool> described(schemas.size() + 1);
  const auto lane = [&](const RecordedTopic& topic) {
    const std::uint16_t schema = topic.channel.schema;
    if (!described[schema]) descriptions_ += record_of(schemas[schema - std::size_t{1}]);
    described[schema] = true;
    descriptions_ += record_of(topic.channel);
    return Lane{CdrEncoder(*topic.type), topic.channel.id};
  };
  static const Type& nothing = type_of<bool>();
  for (const std::optional<RecordedTopic>& topic : topics)
    lanes_.push_back(topic ? lane(*topic) : Lane{CdrEncoder(nothing), 0, 0, false});
  for (const RecordedTopic& topic : beside) beside_.push_back(lane(topic));
}

void RecordedStream::take(Duration instant, std::uint32_t output, const void* value) {
  if (wants(output)) append(lanes_[output], instant, value);
}

void RecordedStream::append(Lane& lane, Duration instant, const void* value) {
  newest_ = instant;
  const std::size_t size = lane.encoder.size(value);
  if (chunk_->records().size() + size > chunk_bytes && chunk_->messages() > 0) hand_on();
  put(lane, instant, value, size);
}

// However full the chunk is.
void RecordedStream::put(Lane& lane, Duration instant, const void* value, std::size_t size) {
  if (!std::exchange(are_described_, true)) chunk_->add(descriptions_);
  lane.encoder.encode(value, chunk_->add_message(lane.channel, lane.next++, instant.count(), size));
}

void RecordedStream::take_event(const RunEvent& event) {
  if (beside_.empty()) return;
  RecordedEvent recorded{.kind = event.kind, .activation = event.activation};
  if (event.kind == RunEvent::Kind::fault && event.task < task_names_.size())
    recorded.task = String(task_names_[event.task]);
  if (event.kind == RunEvent::Kind::mishap) recorded.task = String(event.distributer);
  recorded.cause = String(event.cause);
  append_beside(0, event.instant, &recorded);
}

void RecordedStream::append_beside(std::size_t i, Duration instant, const void* value) {
  append(beside_[i], instant, value);
}

// Not so often that chunks are small, and not so seldom that much is lost with a program that is killed, or with the
// later parts of a recording.
void RecordedStream::pause() {
  if (chunk_->messages() == 0) return;
  if (chunk_->records().size() >= small_chunk_bytes || (is_needed() && queue_.pushed() != pushed_) ||
      std::chrono::steady_clock::now() - handed_on_ >= std::chrono::milliseconds(200))
    hand_on();
}

void RecordedStream::finish() {
  if (chunk_->messages() > 0 || gap_) hand_on(true);
  is_finished_ = true;
}

// What a replay needs can't lack anything: its recorder fails then.
void RecordedStream::take_loss(const Loss& loss) {
  if (!is_needed()) add_to_gap(loss.from.count(), loss.to.count(), loss.values);
}

void RecordedStream::end_unfinished(Duration covered) {
  if (is_finished_ || !newest_) return;
  const std::int64_t last = std::max(covered, *newest_).count();
  add_to_gap(newest_->count(), last, 0);
  if (chunk_) {
    drop_chunk(chunk_->messages());
  } else {
    chunk_ = queue_.empty_chunk();
  }
  hand_on(true);
}

// A gap stands in the chunk that follows it.
void RecordedStream::hand_on(bool last) {
  handed_on_ = std::chrono::steady_clock::now();
  const std::uint64_t values = chunk_->messages();
  if (gap_) put(beside_[1], Duration(gap_->to), &*gap_, beside_[1].encoder.size(&*gap_));
  chunk_->seal();
  if (pressure_ == Pressure::drops && !last && !queue_.push_if_room(chunk_)) {
    dropped_ += values;
    return drop_chunk(values);
  }
  if (waits() && chunk_) queue_.wait_and_push(std::move(chunk_));
  if (chunk_) queue_.push(std::move(chunk_));
  pushed_ = queue_.pushed();
  chunk_ = queue_.empty_chunk();
  gap_.reset();
  is_first_ = false;
}

void RecordedStream::drop_chunk(std::uint64_t values) {
  if (values > 0) add_to_gap(chunk_->start(), chunk_->end(), values);
  chunk_->clear();
  if (is_first_) are_described_ = false;  // they were in it
}

void RecordedStream::add_to_gap(std::int64_t from, std::int64_t to, std::uint64_t values) {
  if (!gap_) gap_ = Gap{from, to, 0};
  gap_->from = std::min(gap_->from, from);
  gap_->to = std::max(gap_->to, to);
  gap_->values += values;
}

}  // namespace jarol
