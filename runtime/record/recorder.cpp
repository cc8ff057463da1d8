#include "runtime/record/recorder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "graph/text/errors.h"
#include "graph/values/pack.h"

namespace jarol {
namespace {
constexpr std::uint64_t ended_bit = std::uint64_t{1} << 63;
}  // namespace

Recorder::Recorder(std::vector<RecordSink*> sinks, Duration hand_on_period)
    : carrying_(take_direct(sinks)),
      direct_(carrying_.load(std::memory_order_relaxed)),
      others_(std::move(sinks), failures_),
      hand_on_period_(hand_on_period),
      memory_(make_large_zeros(chunk_bytes * chunks)),
      now_(memory_.get()) {
  if (direct_ != nullptr) direct_->take_directly(&bell_);
  find_wanted();
  thread_ = std::thread([this] { run(); });
}

// The first that can; it stands among the others no more.
DirectSink* Recorder::take_direct(std::vector<RecordSink*>& sinks) {
  const auto can = std::find_if(sinks.begin(), sinks.end(), [](RecordSink* sink) { return sink->direct() != nullptr; });
  if (can == sinks.end()) return nullptr;
  DirectSink* const direct = (*can)->direct();
  sinks.erase(can);
  return direct;
}

Recorder::~Recorder() {
  try {
    close();
  } catch (...) {
    // whoever cares for a loss closes first
  }
}

void Recorder::expect(const std::vector<Output>& outputs) {
  outputs_ = outputs;
  others_.expect(outputs);
  find_wanted();
}

void Recorder::put_in_order(Duration longest) {
  others_.put_in_order(longest);
  if (direct_ == nullptr) return;
  carrying_.store(nullptr, std::memory_order_release);
  direct_->take_directly(nullptr);
  others_.add(std::exchange(direct_, nullptr));
  find_wanted();
}

void Recorder::find_wanted() {
  wanted_.clear();
  for (std::uint32_t i = 0; i < outputs_.size(); ++i) {
    const bool by_direct = direct_ != nullptr && direct_->wants(i);
    const bool is_too_large = outputs_[i].type->size > max_bytes;  // which is found on the way to the ring
    wanted_.push_back(static_cast<std::uint8_t>((by_direct && !is_too_large ? directly : 0) |
                                                (others_.want(i) || (by_direct && is_too_large) ? by_ring : 0)));
  }
  wanted_beside_ = static_cast<std::uint8_t>((direct_ != nullptr ? directly : 0) | (others_.are_none() ? 0 : by_ring));
}

void Recorder::append_deep(Duration instant, std::uint32_t output, const void* value) {
  const Type& type = *outputs_[output].type;
  const std::uint8_t by = wanted_by(output);
  if (by == 0) return;
  const std::size_t size = packed_size(type, value);
  if (size > max_bytes) return lose_too_large(instant, output, size);
  if ((by & directly) != 0) give(instant, output, value);
  if ((by & by_ring) == 0) return;
  const std::size_t padded = (size + 7U) & ~std::size_t{7};
  if (sizeof(RecordHeader) + padded > chunk_bytes) return append_large(instant, output, value, size);
  if (chunk_bytes - used_ < sizeof(RecordHeader) + padded) next_chunk();
  const RecordHeader header{instant, output, static_cast<std::uint32_t>(size)};
  std::memcpy(now_ + used_, &header, sizeof header);
  pack(type, value, now_ + used_ + sizeof header);
  used_ += sizeof header + padded;
}

void Recorder::append_large(Duration instant, std::uint32_t output, const void* value, std::size_t size) {
  if (size > max_bytes) return lose_too_large(instant, output, size);
  if (used_ > 0) next_chunk();
  if (is_cut_off_) return lost_values_.add(instant, output);
  const std::size_t bytes = sizeof(RecordHeader) + ((size + 7U) & ~std::size_t{7});
  std::byte* const room = large_.room(written_.load(std::memory_order_relaxed) % chunks, bytes, [this] {
    if (waits_) wait_for_sinks();
    return waits_;
  });
  if (room == nullptr) return lose(instant, output, size, "there was no memory to record it");
  const RecordHeader header{instant, output, static_cast<std::uint32_t>(size)};
  std::memcpy(room, &header, sizeof header);
  pack(*outputs_[output].type, value, room + sizeof header);
  now_ = room;
  used_ = bytes;
  next_chunk();
}

void Recorder::lose_too_large(Duration instant, std::uint32_t output, std::size_t size) {
  too_large_values_.add(instant, output);
  const std::string why = "values of up to " + std::to_string(max_bytes) + " can be recorded";
  if (too_large_.empty()) too_large_ = loss_text(instant, output, size, why);
  lose(instant, output, size, why);
}

void Recorder::lose(Duration instant, std::uint32_t output, std::size_t size, const std::string& why) {
  lost_values_.add(instant, output);
  if (lost_.empty()) lost_ = loss_text(instant, output, size, why);
}

std::string Recorder::loss_text(Duration instant, std::uint32_t output, std::size_t size,
                                const std::string& why) const {
  return "output '" + outputs_[output].name + "' had " + std::to_string(size) + " bytes at " +
         std::to_string(instant.count()) + "ns; " + why;
}

void Recorder::pause_direct() {
  if (direct_ == nullptr) return;
  try {
    direct_->pause();
  } catch (...) { fail_directly(); }
}

// It gets nothing more, nor is it asked to finish.
void Recorder::fail_directly() {
  direct_failure_ = std::current_exception();
  failed_directly_ = std::exchange(direct_, nullptr);
  for (std::uint8_t& by : wanted_) by &= by_ring;
  wanted_beside_ &= by_ring;
}

// While the thread that drains is still.
void Recorder::note_direct_failure() {
  if (!direct_failure_) return;
  try {
    std::rethrow_exception(std::exchange(direct_failure_, nullptr));
  } catch (...) { failures_.note(failed_directly_); }
}

// To wake the thread that drains and to wait for it takes longer than to drain what a short run has published.
void Recorder::catch_up() {
  pause_direct();
  if (used_ > 0) next_chunk();
  for (bool drained = true; drained;) drained = drain_next();
  note_direct_failure();
}

void Recorder::wait_for_sinks() {
  pause_direct();
  if (used_ > 0) next_chunk();
  const std::uint64_t written = written_.load(std::memory_order_relaxed);
  if (read_.load(std::memory_order_acquire) < written) bell_.ring();
  wait_until_read(written);
  note_direct_failure();
}

void Recorder::wait_until_read(std::uint64_t count) {
  for (std::uint64_t read = 0; (read = read_.load(std::memory_order_acquire)) < count;)
    read_.wait(read, std::memory_order_acquire);
}

std::string Recorder::why_not_all(const RecordSink& sink) const {
  const std::string failure = failure_of(sink);
  if (!failure.empty()) return failure;
  return direct_ == &sink ? too_large_ : lost_;
}

void Recorder::append_event(const RunEvent& event) {
  if (direct_ != nullptr) {
    try {
      direct_->take_event(event);
    } catch (...) { fail_directly(); }
  }
  if ((wanted_beside_ & by_ring) == 0) return;
  std::array<std::byte, 512> room;
  std::string words(event.distributer);
  words += event.cause;
  const EventHeader header{event.activation, event.task, event.kind, event.distributer.size()};
  const std::size_t length = std::min(words.size(), room.size() - sizeof header);
  std::memcpy(room.data(), &header, sizeof header);
  std::memcpy(room.data() + sizeof header, words.data(), length);
  append_to_ring(event.instant, RecordHeader::event, room.data(), static_cast<std::uint32_t>(sizeof header + length));
}

void Recorder::close() {
  if (!thread_.joinable()) return;
  if (is_cut_off_) lost_values_.add_all(now_, used_);
  if (used_ > 0 && !is_cut_off_) publish_chunk();
  written_.fetch_or(ended_bit, std::memory_order_release);
  bell_.ring();
  thread_.join();
  failures_.rethrow_all();
  if (!lost_.empty()) throw InputError(lost_);
}

void Recorder::publish_chunk() {
  const std::uint64_t index = written_.load(std::memory_order_relaxed);
  bytes_[index % chunks] = used_;
  written_.store(index + 1, std::memory_order_release);
  used_ = 0;
}

void Recorder::next_chunk() {
  if (!waits_ && written_.load(std::memory_order_relaxed) + 1 - read_.load(std::memory_order_acquire) >= chunks)
    cut_off();
  if (is_cut_off_) {
    lost_values_.add_all(now_, used_);
    used_ = 0;
    return;
  }
  publish_chunk();
  const std::uint64_t next = written_.load(std::memory_order_relaxed);
  const std::uint64_t read = read_.load(std::memory_order_acquire);
  if (next - read >= chunks / 2) bell_.ring_if_asleep();
  if (next - read >= chunks) wait_until_read(next - chunks + 1);
  now_ = memory_.get() + (next % chunks) * chunk_bytes;
}

void Recorder::cut_off() {
  RecordHeader first;
  std::memcpy(&first, now_, sizeof first);
  if (!is_cut_off_ && lost_.empty())
    lost_ = "values could not be written as fast as they came; from " + std::to_string(first.instant.count()) +
            "ns on they are lost";
  is_cut_off_ = true;
}

// False: all that was handed on is drained, whoever did it.
bool Recorder::drain_next() {
  const std::lock_guard lock(draining_);
  const std::uint64_t read = read_.load(std::memory_order_relaxed);
  if ((written_.load(std::memory_order_acquire) & ~ended_bit) == read) return false;
  const std::size_t chunk = read % chunks, bytes = bytes_[chunk];
  others_.take(bytes > chunk_bytes ? large_.at(chunk) : memory_.get() + chunk * chunk_bytes, bytes);
  read_.store(read + 1, std::memory_order_release);
  read_.notify_one();
  return true;
}

void Recorder::run() {
  for (bool has_ended = false; !has_ended;) {
    const std::uint32_t rings = bell_.rings();
    const bool ends = (written_.load(std::memory_order_acquire) & ended_bit) != 0;
    DirectSink* const carrying = carrying_.load(std::memory_order_acquire);
    const bool has_carried = carrying != nullptr && carrying->carry();
    if (drain_next() || has_carried)
      bell_.stay_awake();
    else if (ends)
      has_ended = true;
    else
      bell_.sleep(rings);
  }
  others_.finish(lost_values_);
  note_direct_failure();
  if (direct_ == nullptr) return;
  try {
    if (const auto loss = too_large_values_.of(*direct_)) direct_->take_loss(*loss);
    direct_->finish();
  } catch (...) { failures_.note(direct_); }
}

}  // namespace jarol
