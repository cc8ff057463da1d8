#include "runtime/record/recorded_stream.h"

#include <algorithm>
#include <utility>

#include "graph/values/heap.h"
#include "graph/values/type_of.h"

namespace jarol {
namespace {
void widen(std::optional<Gap>& gap, const Gap& more) {
  if (!gap) gap = Gap{more.from, more.to, 0};
  gap->from = std::min(gap->from, more.from);
  gap->to = std::max(gap->to, more.to);
  gap->values += more.values;
}
}  // namespace

RecordedStream::RecordedStream(ChunkQueue& queue, Pressure pressure, const std::vector<mcap::Schema>& schemas,
                               const std::vector<std::optional<RecordedTopic>>& topics,
                               const std::vector<RecordedTopic>& beside)
    : queue_(queue),
      pressure_(pressure),
      reserved_(is_needed() || std::ranges::none_of(topics, [](const auto& topic) { return topic.has_value(); })
                    ? 0
                    : chunk_bytes + small_chunk_bytes),
      chunks_([this] { return make_chunk(); }) {
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
  if (const mcap::Chunk& chunk = chunks_.filling(); chunk.records().size() + size > chunk_bytes && chunk.messages() > 0)
    hand_on();
  put(lane, instant, value, size);
}

// However full the chunk is.
void RecordedStream::put(Lane& lane, Duration instant, const void* value, std::size_t size) {
  mcap::Chunk& chunk = chunks_.filling();
  if (!std::exchange(are_described_, true)) chunk.add(descriptions_);
  lane.encoder.encode(value, chunk.add_message(lane.channel, lane.next++, instant, size));
}

void RecordedStream::take_event(const RunEvent& event) {
  const MemoryScope outside(nullptr);  // of a run no text would find memory
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
  const mcap::Chunk& chunk = chunks_.filling();
  if (chunk.messages() == 0) return;
  if (chunk.records().size() >= small_chunk_bytes || (is_needed() && queue_.pushed() != pushed_) ||
      std::chrono::steady_clock::now() - handed_on_ >= std::chrono::milliseconds(200))
    hand_on();
}

void RecordedStream::finish() {
  bell_ = nullptr;  // whoever took is done
  if (chunks_.filling().messages() > 0 || gap_) hand_on(true);
  carry(true);
  if (lost_) widen(gap_, *std::exchange(lost_, std::nullopt));
  if (failure_) std::rethrow_exception(failure_);
  is_finished_ = true;
}

// What a replay needs can't lack anything: its recorder fails then.
void RecordedStream::take_loss(const Loss& loss) {
  if (!is_needed()) widen(gap_, {loss.from.count(), loss.to.count(), loss.values});
}

void RecordedStream::end_unfinished(Duration covered) {
  if (is_finished_ || !newest_) return;
  bell_ = nullptr;
  failure_ = nullptr;
  if (lost_) widen(gap_, *lost_);
  widen(gap_, {newest_->count(), std::max(covered, *newest_).count(), 0});
  drop_chunk(chunks_.filling().messages());
  hand_on(true);
  if (failure_) std::rethrow_exception(failure_);
}

// A gap stands in the chunk that follows it.
void RecordedStream::hand_on(bool last) {
  handed_on_ = std::chrono::steady_clock::now();
  mcap::Chunk& chunk = chunks_.filling();
  if (!chunks_.has_room() && !make_room(last)) {
    dropped_ += chunk.messages();
    return drop_chunk(chunk.messages());
  }
  if (gap_) put(beside_[1], Duration(gap_->to), &*gap_, beside_[1].encoder.size(&*gap_));
  chunk.seal();
  chunks_.next();
  gap_.reset();
  is_first_ = false;
  if (bell_ == nullptr)
    carry(last);
  else if (chunks_.waiting() >= ChunkRing::chunks / 2)
    bell_->ring_if_asleep();
  pushed_ = queue_.pushed();
}

// False: so far the writer is behind.
bool RecordedStream::make_room(bool last) {
  if (bell_ == nullptr) {
    carry(last);
  } else if (waits()) {
    bell_->ring_if_asleep();
    chunks_.wait_for_room();
  }
  return chunks_.has_room();
}

void RecordedStream::drop_chunk(std::uint64_t values) {
  mcap::Chunk& chunk = chunks_.filling();
  if (values > 0) widen(gap_, {chunk.start().count(), chunk.end().count(), values});
  chunk.clear();
  if (is_first_) are_described_ = false;  // they were in it
}

ChunkQueue::ChunkPointer RecordedStream::make_chunk() {
  ChunkQueue::ChunkPointer chunk = queue_.empty_chunk();
  chunk->reserve(reserved_);
  return chunk;
}

// `all`: however many wait in the queue.
bool RecordedStream::carry(bool all) {
  bool any = false;
  for (ChunkQueue::ChunkPointer* full = chunks_.full(); full != nullptr; full = chunks_.full()) {
    if (pressure_ == Pressure::drops && !all && !queue_.has_room_for((*full)->records().size())) return any;
    const std::size_t bytes = (*full)->records().size();
    const Gap range{(*full)->start().count(), (*full)->end().count(), (*full)->messages()};
    if (failure_ == nullptr) push(*full);
    if (failure_ != nullptr) {
      widen(lost_, range);
      (*full)->clear();
    }
    chunks_.taken(bytes);
    any = true;
  }
  return any;
}

// An empty one takes its place.
void RecordedStream::push(ChunkQueue::ChunkPointer& chunk) {
  try {
    ChunkQueue::ChunkPointer empty = make_chunk();
    std::swap(chunk, empty);
    waits() ? queue_.wait_and_push(std::move(empty)) : queue_.push(std::move(empty));
  } catch (...) { failure_ = std::current_exception(); }
}

}  // namespace jarol
