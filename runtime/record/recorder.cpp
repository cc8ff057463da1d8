#include "runtime/record/recorder.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "graph/values/pack.h"
#include "runtime/machine/futex.h"

namespace jarol {
namespace {
constexpr std::uint64_t ended = std::uint64_t{1} << 63;

// So long the thread that drains sleeps between two looks where nobody wakes it: at first, and where nothing comes.
constexpr std::chrono::microseconds shortest_sleep{50}, longest_sleep{1000};

// So many bytes are read after those at hand.
constexpr std::size_t ahead = 1024;

// What stands before the cause of an event.
struct EventHeader {
  std::int64_t activation = 0;
  std::uint32_t task = 0;
  RunEvent::Kind kind{};
  std::uint64_t name = 0;  // so many bytes of the cause are the distributer's name
};
}  // namespace

Recorder::Recorder(std::vector<RecordSink*> sinks, Duration hand_on_period)
    : sinks_(std::move(sinks)),
      taking_(sinks_),
      hand_on_period_(hand_on_period),
      memory_(make_large_zeros(chunk_bytes * chunks)),
      now_(memory_.get()) {
  thread_ = std::thread([this] { run(); });
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
  deep_values_.clear();
  for (const Output& output : outputs) deep_values_.push_back(output.type->is_deep() ? Value(*output.type) : Value());
  wanted_.clear();
  for (std::uint32_t i = 0; i < outputs.size(); ++i)
    wanted_.push_back(
        std::any_of(sinks_.begin(), sinks_.end(), [&](const RecordSink* sink) { return sink->wants(i); }) ? 1 : 0);
}

void Recorder::append_deep(Duration instant, std::uint32_t output, const void* value) {
  const Type& type = *outputs_[output].type;
  const std::size_t size = packed_size(type, value);
  const std::size_t padded = (size + 7U) & ~std::size_t{7};
  if (sizeof(RecordHeader) + padded > chunk_bytes) return append_large(instant, output, value, size);
  if (chunk_bytes - used_ < sizeof(RecordHeader) + padded) next_chunk();
  const RecordHeader header{instant, output, static_cast<std::uint32_t>(size)};
  std::memcpy(now_ + used_, &header, sizeof header);
  pack(type, value, now_ + used_ + sizeof header);
  used_ += sizeof header + padded;
}

void Recorder::append_large(Duration instant, std::uint32_t output, const void* value, std::size_t size) {
  if (size > max_bytes)
    return lose(instant, output, size, "values of up to " + std::to_string(max_bytes) + " can be recorded");
  if (used_ > 0) next_chunk();
  if (is_cut_off_) return lost_values_.add(instant, output);
  const std::size_t bytes = sizeof(RecordHeader) + ((size + 7U) & ~std::size_t{7});
  std::byte* const room = large_.room(written_.load(std::memory_order_relaxed) % chunks, bytes, [this] {
    if (waits_) catch_up();
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

void Recorder::lose(Duration instant, std::uint32_t output, std::size_t size, const std::string& why) {
  lost_values_.add(instant, output);
  if (!lost_.empty()) return;
  lost_ = "output '" + outputs_[output].name + "' had " + std::to_string(size) + " bytes at " +
          std::to_string(instant.count()) + "ns; " + why;
}

void Recorder::catch_up() {
  if (used_ > 0) next_chunk();
  const std::uint64_t written = written_.load(std::memory_order_relaxed);
  if (read_.load(std::memory_order_acquire) < written) wake();
  for (std::uint64_t read = read_.load(std::memory_order_acquire); read < written;
       read = read_.load(std::memory_order_acquire))
    read_.wait(read, std::memory_order_acquire);
}

void Recorder::rethrow_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

std::string Recorder::failure_of(const RecordSink& sink) const {
  for (const Failed& failed : failed_)
    if (failed.sink == &sink || failed.sink == nullptr) return failed.why;
  return "";
}

std::string Recorder::why_not_all(const RecordSink& sink) const {
  const std::string failure = failure_of(sink);
  return failure.empty() ? lost_ : failure;
}

void Recorder::append_event(const RunEvent& event) {
  std::array<std::byte, 512> room;
  std::string words(event.distributer);
  words += event.cause;
  const EventHeader header{event.activation, event.task, event.kind, event.distributer.size()};
  const std::size_t length = std::min(words.size(), room.size() - sizeof header);
  std::memcpy(room.data(), &header, sizeof header);
  std::memcpy(room.data() + sizeof header, words.data(), length);
  append(event.instant, RecordHeader::event, room.data(), static_cast<std::uint32_t>(sizeof header + length));
}

void Recorder::close() {
  if (!thread_.joinable()) return;
  if (is_cut_off_) lost_values_.add_all(now_, used_);
  if (used_ > 0 && !is_cut_off_) publish_chunk();
  written_.fetch_or(ended, std::memory_order_release);
  wake();
  thread_.join();
  if (failed_.size() > 1) {
    std::string all;
    for (const Failed& failed : failed_) all += (all.empty() ? "" : "; ") + failed.why;
    throw std::runtime_error(all);
  }
  rethrow_failure();
  if (!lost_.empty()) throw std::length_error(lost_);
}

void Recorder::publish_chunk() {
  const std::uint64_t index = written_.load(std::memory_order_relaxed);
  bytes_[index % chunks] = used_;
  written_.store(index + 1, std::memory_order_release);
  used_ = 0;
}

void Recorder::wake() {
  bell_.fetch_add(1, std::memory_order_release);
  Futex::wake_all(bell_);
}

// Until the bell has another value than that; nobody has to ring it for what can wait.
void Recorder::sleep(std::uint32_t bell, std::chrono::microseconds longest) {
  is_asleep_.store(true, std::memory_order_relaxed);
  Futex::wait(bell_, bell, Futex::now() + longest);
  is_asleep_.store(false, std::memory_order_relaxed);
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
  std::uint64_t read = read_.load(std::memory_order_acquire);
  if (next - read >= chunks / 2 && is_asleep_.load(std::memory_order_relaxed)) wake();
  for (; next - read >= chunks; read = read_.load(std::memory_order_acquire))
    read_.wait(read, std::memory_order_acquire);
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

void Recorder::run() {
  std::uint64_t read = 0;
  std::chrono::microseconds pause = shortest_sleep;
  while (true) {
    const std::uint32_t bell = bell_.load(std::memory_order_acquire);
    const std::uint64_t written = written_.load(std::memory_order_acquire);
    if ((written & ~ended) == read) {
      if ((written & ended) != 0) break;
      sleep(bell, pause);
      pause = std::min(2 * pause, longest_sleep);
      continue;
    }
    pause = shortest_sleep;
    const std::size_t chunk = read % chunks, bytes = bytes_[chunk];
    drain(bytes > chunk_bytes ? large_.at(chunk) : memory_.get() + chunk * chunk_bytes, bytes);
    read_.store(++read, std::memory_order_release);
    read_.notify_one();
  }
  try {
    if (!taking_.empty()) hand_on_held(newest_);
  } catch (...) {
    note_failure(nullptr);
    taking_.clear();
  }
  for (RecordSink* sink : taking_) {
    try {
      if (const auto loss = lost_values_.of(*sink)) sink->take_loss(*loss);
      sink->finish();
    } catch (...) { note_failure(sink); }
  }
}

// While it is caught.
void Recorder::note_failure(const RecordSink* sink) {
  if (!failure_) failure_ = std::current_exception();
  std::string why = "what was to take it has failed";
  try {
    throw;
  } catch (const std::exception& error) { why = error.what(); } catch (...) {
  }
  failed_.push_back({sink, std::move(why)});
}

// One that fails takes no other with it.
template <class Call>
void Recorder::each_taking(const Call& call) {
  for (std::size_t i = 0; i < taking_.size();) {
    try {
      for (; i < taking_.size(); ++i) call(*taking_[i]);
    } catch (...) {
      note_failure(taking_[i]);
      taking_.erase(taking_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

void Recorder::drain(const std::byte* chunk, std::size_t bytes) {
  if (taking_.empty()) return;  // go on emptying the ring, so that the run itself is not held up
  try {
    for (std::size_t at = 0; at < bytes;) {
      // on its way from another core's cache, two lines for each value
      for (const std::size_t line : {ahead, ahead + 64}) __builtin_prefetch(chunk + std::min(at + line, bytes));
      RecordHeader header;
      std::memcpy(&header, chunk + at, sizeof header);
      const std::byte* packed = chunk + at + sizeof header;
      disorder_ ? hold(header, packed) : hand_on(header, packed);
      at += sizeof header + ((header.size + 7U) & ~std::size_t{7});
    }
    each_taking([](RecordSink& sink) { sink.pause(); });
  } catch (...) {
    note_failure(nullptr);
    taking_.clear();
  }
}

void Recorder::hold(const RecordHeader& header, const std::byte* packed) {
  held_.emplace(header.instant, Held{header, {packed, packed + header.size}});
  newest_ = std::max(newest_, header.instant);
  hand_on_held(newest_ - *disorder_);
}

void Recorder::hand_on_held(Duration until) {
  for (auto first = held_.begin(); first != held_.end() && first->first <= until; first = held_.erase(first))
    hand_on(first->second.header, first->second.packed.data());
}

void Recorder::hand_on_event(const RecordHeader& header, const std::byte* packed) {
  EventHeader event;
  std::memcpy(&event, packed, sizeof event);
  const std::string_view words(reinterpret_cast<const char*>(packed) + sizeof event, header.size - sizeof event);
  const std::size_t name = std::min<std::size_t>(event.name, words.size());
  each_taking([&](RecordSink& sink) {
    sink.take_event(
        {event.kind, header.instant, event.task, event.activation, words.substr(name), words.substr(0, name)});
  });
}

void Recorder::hand_on(const RecordHeader& header, const std::byte* packed) {
  if (header.output == RecordHeader::event) return hand_on_event(header, packed);
  const void* value = value_of(header, packed);
  each_taking([&](RecordSink& sink) { sink.take(header.instant, header.output, value); });
}

const void* Recorder::value_of(const RecordHeader& header, const std::byte* packed) {
  if (header.output >= deep_values_.size() || deep_values_[header.output].type() == nullptr) return packed;
  Value& value = deep_values_[header.output];
  unpack(*value.type(), packed, value.data());
  return value.data();
}

}  // namespace jarol
