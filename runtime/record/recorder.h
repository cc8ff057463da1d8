// Recording of every publication: the thread that runs tasks only appends to memory, another one hands it on.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "graph/values/value.h"
#include "runtime/machine/copy_fresh.h"
#include "runtime/machine/large_pages.h"
#include "runtime/machine/prefetch.h"
#include "runtime/plan/output.h"
#include "runtime/record/large_values.h"
#include "runtime/record/lost_values.h"
#include "runtime/record/record_header.h"
#include "runtime/record/sink.h"

namespace jarol {

class Recorder {
 public:
  /// The sinks outlive the recorder.
  explicit Recorder(std::vector<RecordSink*> sinks, Duration hand_on_period = std::chrono::seconds(1));

  /// What will be recorded, before the first of it.
  void expect(const std::vector<Output>& outputs);

  /// Sinks get values in order of instants though they may be appended out of order, up to that long after a later one.
  /// Before the first value.
  void put_in_order(Duration longest) { disorder_ = longest; }

  /// Values up to this size can be recorded, a mebibyte less than a chunk of a recording may have. A larger one is
  /// lost, and `lost` says so.
  static constexpr std::size_t max_bytes = (std::size_t{1} << 30) - (std::size_t{1} << 20);

  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Appends one value. Calls the system only where the sinks are half a ring behind, and waits if they are a whole
  /// one.
  void append(Duration instant, std::uint32_t output, const void* value, std::uint32_t size) {
    const std::size_t padded = (size + 7U) & ~std::size_t{7};
    if (chunk_bytes - used_ < sizeof(RecordHeader) + padded) {
      if (sizeof(RecordHeader) + padded > chunk_bytes) return append_large(instant, output, value, size);
      next_chunk();
    }
    prefetch_for_write(now_, chunk_bytes, used_);
    const RecordHeader header{instant, output, size};
    std::memcpy(now_ + used_, &header, sizeof header);
    if (size == 64)
      copy_fresh<64>(now_ + used_ + sizeof header, value);
    else
      std::memcpy(now_ + used_ + sizeof header, value, size);
    used_ += sizeof header + padded;
  }

  /// The same for a deep value.
  void append_deep(Duration instant, std::uint32_t output, const void* value);

  /// Some sink wants publications of that output.
  bool wants(std::uint32_t output) const { return wanted_[output] != 0; }

  /// Appends what happened beside publications.
  [[gnu::cold]] void append_event(const RunEvent& event);

  /// What is appended while the sinks are a whole ring behind is lost, rather than waited for, and all that follows;
  /// each learns what it lacks.
  void never_wait() { waits_ = false; }
  /// Hands on what was appended so far, if the sinks have all that was handed on before.
  void hand_on() {
    if (used_ > 0 && read_.load(std::memory_order_acquire) == written_.load(std::memory_order_relaxed)) next_chunk();
  }
  /// How much time may go by until what little there is, is handed on.
  Duration hand_on_period() const { return hand_on_period_; }
  /// Hands on what was appended so far and waits until the sinks have it, but for what is held for its order.
  void catch_up();
  /// Throws the first that a sink has thrown by then. After `catch_up`.
  void rethrow_failure() const;
  /// The first that was not recorded, and why, which `close` throws; empty: all was.
  const std::string& lost() const { return lost_; }

  /// Hands on all that was appended, ends the thread and lets the sinks finish; throws what a sink threw, or, of
  /// several, std::runtime_error with all of it. One that has thrown gets nothing more and does not finish; the others
  /// get all.
  void close();
  /// What that sink has thrown; empty: nothing. After `catch_up` or `close`.
  std::string failure_of(const RecordSink& sink) const;
  /// Why that sink has not got all; empty: it has. After `close`.
  std::string why_not_all(const RecordSink& sink) const;

 private:
  static constexpr std::size_t chunk_bytes = std::size_t{256} << 10;
  static constexpr std::size_t chunks = 8;

  [[gnu::cold]] void append_large(Duration instant, std::uint32_t output, const void* value, std::size_t size);
  void lose(Duration instant, std::uint32_t output, std::size_t size, const std::string& why);
  void next_chunk();
  [[gnu::cold]] void cut_off();
  void publish_chunk();
  [[gnu::cold]] void wake();
  void sleep(std::uint32_t bell, std::chrono::microseconds longest);
  void run();
  void drain(const std::byte* chunk, std::size_t bytes);
  void hold(const RecordHeader& header, const std::byte* packed);
  void hand_on_held(Duration until);
  void hand_on(const RecordHeader& header, const std::byte* packed);
  void hand_on_event(const RecordHeader& header, const std::byte* packed);
  template <class Call>
  void each_taking(const Call& call);
  [[gnu::cold]] void note_failure(const RecordSink* sink);
  const void* value_of(const RecordHeader& header, const std::byte* packed);

  std::vector<RecordSink*> sinks_;
  std::vector<RecordSink*> taking_;  // those of them that have not failed
  const Duration hand_on_period_;
  std::vector<Output> outputs_;
  std::vector<std::uint8_t> wanted_;  // per output
  std::vector<Value> deep_values_;    // per output: what the sinks see, empty for flat ones
  std::string lost_;                  // the first value, and why
  LostValues lost_values_;            // that and all others
  struct Held {
    RecordHeader header;
    std::vector<std::byte> packed;
  };
  std::optional<Duration> disorder_;    // none: all comes in order
  std::multimap<Duration, Held> held_;  // by instant, then as they came
  Duration newest_{};                   // instant of a value held
  LargeMemory memory_;
  std::size_t bytes_[chunks] = {};  // filled part of each chunk; more than it has: a large value in its place
  LargeValues<chunks> large_;
  std::byte* now_ = nullptr;
  std::size_t used_ = 0;
  bool waits_ = true;
  bool is_cut_off_ = false;                // nothing is handed on any more
  std::atomic<std::uint64_t> written_{0};  // chunks handed on; the top bit says that no more will come
  std::atomic<std::uint64_t> read_{0};     // chunks drained
  std::atomic<std::uint32_t> bell_{0};     // changes where the thread that drains is to be woken
  std::atomic<bool> is_asleep_{false};     // that thread
  struct Failed {
    const RecordSink* sink;  // null: all of them
    std::string why;
  };
  std::exception_ptr failure_;  // the first; read when all is drained
  std::vector<Failed> failed_;
  std::thread thread_;
};

}  // namespace jarol
