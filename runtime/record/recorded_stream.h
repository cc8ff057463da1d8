// A sink that puts what it takes into chunks of a recording, as it stands in the file: a topic for each output. Whoever
// takes fills chunks, and the recorder's thread hands them to the queue.
#pragma once

#include <array>
#include <chrono>
#include <exception>
#include <optional>
#include <vector>

#include "runtime/record/cdr.h"
#include "runtime/record/chunk_queue.h"
#include "runtime/record/chunk_ring.h"
#include "runtime/record/recording_format.h"
#include "runtime/record/sink.h"

namespace jarol {

/// A topic that is to stand in a recording.
struct RecordedTopic {
  mcap::Channel channel;
  const Type* type = nullptr;
};

class RecordedStream final : public DirectSink {
 public:
  /// What becomes of chunks where the disk is behind. What is kept is needed to replay the others, and goes out
  /// with each chunk of theirs: on the real clock however many wait already, else once there is room.
  enum class Pressure { keeps, keeps_by_waiting, waits, drops };

  /// By output the topic for it; none: it is not recorded. `beside`: the topics for events and gaps. `schemas`: of all.
  RecordedStream(ChunkQueue& queue, Pressure pressure, const std::vector<mcap::Schema>& schemas,
                 const std::vector<std::optional<RecordedTopic>>& topics, const std::vector<RecordedTopic>& beside);

  /// What is needed is not taken directly: however much of it waits, its run goes on.
  DirectSink* direct() override { return is_needed() ? nullptr : this; }
  void take_directly(Bell* bell) override { bell_ = bell; }
  bool carry() override { return carry(false); }

  bool wants(std::uint32_t output) const override { return output < lanes_.size() && lanes_[output].wanted; }
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void take_event(const RunEvent& event) override;
  void take_loss(const Loss& loss) override;
  void pause() override;
  void finish() override;

  /// A value of the i-th topic beside the outputs.
  void append_beside(std::size_t i, Duration instant, const void* value);
  /// Of a run of the instants before `covered`, after the last call by its recorder. Where that has not let it finish,
  /// as it threw something, what was not written is a gap.
  void end_unfinished(Duration covered);
  /// Names of tasks, for events.
  void name_tasks(std::vector<std::string> names) { task_names_ = std::move(names); }

  /// Values that are not in the recording, as the disk was behind.
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Lane {
    CdrEncoder encoder;
    std::uint16_t channel = 0;
    std::uint32_t next = 0;  // number of its message
    bool wanted = true;
  };
  static constexpr std::size_t chunk_bytes = std::size_t{1} << 18;
  static constexpr std::size_t small_chunk_bytes = std::size_t{1} << 16;

  bool is_needed() const { return pressure_ == Pressure::keeps || pressure_ == Pressure::keeps_by_waiting; }
  bool waits() const { return pressure_ == Pressure::keeps_by_waiting || pressure_ == Pressure::waits; }
  void append(Lane& lane, Duration instant, const void* value);
  void put(Lane& lane, Duration instant, const void* value, std::size_t size);
  void hand_on(bool last = false);
  bool make_room(bool last);
  void drop_chunk(std::uint64_t values);
  bool carry(bool all);
  void push(ChunkQueue::ChunkPointer& chunk);
  ChunkQueue::ChunkPointer make_chunk();

  ChunkQueue& queue_;
  const Pressure pressure_;
  const std::size_t reserved_;  // bytes of memory that a chunk has from the start
  std::vector<Lane> lanes_;     // per output
  std::vector<Lane> beside_;
  std::vector<std::string> task_names_;
  Bell* bell_ = nullptr;  // null: one thread fills chunks and carries them
  ChunkRing chunks_;

  // Of whoever fills chunks, and of all once nothing comes any more:
  std::chrono::steady_clock::time_point handed_on_{};
  std::uint64_t pushed_ = 0;  // chunks, by all streams of the queue, when this one handed on its newest
  std::string descriptions_;  // records that stand before the first message
  bool are_described_ = false;
  bool is_first_ = true;    // no chunk was handed on yet
  std::optional<Gap> gap_;  // since the newest chunk that was handed on
  std::uint64_t dropped_ = 0;
  std::optional<Duration> newest_;  // instant of the newest message
  bool is_finished_ = false;

  // Of whoever carries them:
  std::exception_ptr failure_;  // there was no memory to go on; nothing is carried any more
  std::optional<Gap> lost_;     // by that
};

constexpr std::array<Enumerator<RunEvent::Kind>, 4> enumerators(RunEvent::Kind) {
  return {{{"fault", RunEvent::Kind::fault},
           {"rest_begun", RunEvent::Kind::rest_begun},
           {"at_rest", RunEvent::Kind::at_rest},
           {"mishap", RunEvent::Kind::mishap}}};
}

/// What happens beside publications, as it is recorded.
struct RecordedEvent {
  RunEvent::Kind kind = RunEvent::Kind::fault;
  std::int64_t activation = 0;  // of a fault
  String task{};                // of a fault; of a mishap: the distributer whose vehicle it is
  String cause{};               // of a fault or mishap, in words

  static constexpr auto fields() {
    return describe(field<&RecordedEvent::kind>(), field<&RecordedEvent::activation>(), field<&RecordedEvent::task>(),
                    field<&RecordedEvent::cause>());
  }
};

}  // namespace jarol
