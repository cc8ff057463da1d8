// Recording of every publication: the thread that runs tasks only appends to memory, another one hands it on. A sink
// that takes directly gets it on the way.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "runtime/machine/bell.h"
#include "runtime/machine/copy_fresh.h"
#include "runtime/machine/large_pages.h"
#include "runtime/machine/prefetch.h"
#include "runtime/plan/output.h"
#include "runtime/record/fed_sinks.h"
#include "runtime/record/large_values.h"
#include "runtime/record/lost_values.h"
#include "runtime/record/record_header.h"
#include "runtime/record/sink.h"
#include "runtime/record/sink_failures.h"

namespace jarol {

class Recorder {
 public:
  /// The sinks outlive the recorder. The first that can takes directly.
  explicit Recorder(std::vector<RecordSink*> sinks, Duration hand_on_period = std::chrono::seconds(1));

  /// What will be recorded, before the first of it.
  void expect(const std::vector<Output>& outputs);

  /// Sinks get values in order of instants though they may be appended out of order, up to that long after a later one.
  /// Before the first value, and before or after `expect`.
  void put_in_order(Duration longest);

  /// Values up to this size can be recorded, a mebibyte less than a chunk of a recording may have. A larger one is
  /// lost, and `lost` says so.
  static constexpr std::size_t max_bytes = (std::size_t{1} << 30) - (std::size_t{1} << 20);

  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Appends one value, if a sink wants it. Calls the system only where the sinks are half a ring behind, and waits if
  /// they are a whole one.
  void append(Duration instant, std::uint32_t output, const void* value, std::uint32_t size) {
    const std::uint8_t by = wanted_by(output);
    if ((by & directly) != 0) give(instant, output, value);
    if ((by & by_ring) != 0) append_to_ring(instant, output, value, size);
  }

  /// The same for a deep value.
  void append_deep(Duration instant, std::uint32_t output, const void* value);

  /// Appends what happened beside publications.
  [[gnu::cold]] void append_event(const RunEvent& event);

  /// What is appended while the sinks are a whole ring behind is lost, rather than waited for, and all that follows;
  /// each learns what it lacks.
  void never_wait() { waits_ = false; }
  /// Hands on what was appended so far, if the sinks have all that was handed on before.
  void hand_on() {
    pause_direct();
    if (used_ > 0 && read_.load(std::memory_order_acquire) == written_.load(std::memory_order_relaxed)) next_chunk();
  }
  /// How much time may go by until what little there is, is handed on.
  Duration hand_on_period() const { return hand_on_period_; }
  /// The sinks have what was appended so far, but for what is held for its order. The calling thread calls them, unless
  /// the recorder's is about to.
  void catch_up();
  /// The same, but the recorder's thread calls them: where the calling one may have no memory, as in an instant.
  void wait_for_sinks();
  /// Throws the first that a sink has thrown by then. After `catch_up`.
  void rethrow_failure() const { failures_.rethrow_first(); }
  /// The first that was not recorded, and why, which `close` throws; empty: all was.
  const std::string& lost() const { return lost_; }

  /// Hands on all that was appended, ends the thread and lets the sinks finish; throws what a sink threw, or, of
  /// several, Unfinished with all of it. One that has thrown gets nothing more and does not finish; the others
  /// get all.
  void close();
  /// What that sink has thrown; empty: nothing. After `catch_up` or `close`.
  std::string failure_of(const RecordSink& sink) const { return failures_.of(sink); }
  /// Why that sink has not got all; empty: it has. After `close`.
  std::string why_not_all(const RecordSink& sink) const;

 private:
  static constexpr std::size_t chunk_bytes = std::size_t{256} << 10;
  static constexpr std::size_t chunks = 8;

  // Who wants an output.
  enum By : std::uint8_t { directly = 1, by_ring = 2 };
  std::uint8_t wanted_by(std::uint32_t output) const {
    return output < wanted_.size() ? wanted_[output] : wanted_beside_;
  }
  void find_wanted();

  void give(Duration instant, std::uint32_t output, const void* value) {
    try {
      direct_->take(instant, output, value);
    } catch (...) { fail_directly(); }
  }
  void pause_direct();
  [[gnu::cold]] void fail_directly();
  void note_direct_failure();

  void append_to_ring(Duration instant, std::uint32_t output, const void* value, std::uint32_t size) {
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
  [[gnu::cold]] void append_large(Duration instant, std::uint32_t output, const void* value, std::size_t size);
  void lose(Duration instant, std::uint32_t output, std::size_t size, const std::string& why);
  std::string loss_text(Duration instant, std::uint32_t output, std::size_t size, const std::string& why) const;
  void lose_too_large(Duration instant, std::uint32_t output, std::size_t size);
  void next_chunk();
  [[gnu::cold]] void cut_off();
  void publish_chunk();
  void wait_until_read(std::uint64_t count);
  void run();
  bool drain_next();
  static DirectSink* take_direct(std::vector<RecordSink*>& sinks);

  SinkFailures failures_;
  std::atomic<DirectSink*> carrying_;  // what it takes directly the thread that drains carries on
  DirectSink* direct_;                 // the same until it fails
  const DirectSink* failed_directly_ = nullptr;
  FedSinks others_;
  const Duration hand_on_period_;
  std::vector<Output> outputs_;
  std::vector<std::uint8_t> wanted_;  // per output: by whom
  std::uint8_t wanted_beside_ = 0;    // the same of those that follow them, and of events
  std::string lost_, too_large_;      // the first value, and why; the first that no sink can take
  LostValues lost_values_;            // that and all others of the ring
  LostValues too_large_values_;
  LargeMemory memory_;
  std::size_t bytes_[chunks] = {};  // filled part of each chunk; more than it has: a large value in its place
  LargeValues<chunks> large_;
  std::byte* now_ = nullptr;
  std::size_t used_ = 0;
  bool waits_ = true;
  bool is_cut_off_ = false;                // nothing is handed on any more
  std::atomic<std::uint64_t> written_{0};  // chunks handed on; the top bit says that no more will come
  std::mutex draining_;                    // whoever drains a chunk has it
  std::atomic<std::uint64_t> read_{0};     // chunks drained
  Bell bell_;                              // of the thread that drains
  std::exception_ptr direct_failure_;      // of the one that takes directly, until it is noted with the others
  std::thread thread_;
};

}  // namespace jarol
