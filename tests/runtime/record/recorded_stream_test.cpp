// A stream of a recording whose writer is held up: what becomes of its chunks then, and what is said of it.
#include "runtime/record/recorded_stream.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <span>
#include <thread>

#include "graph/values/type_of.h"
#include "runtime/mcap/reader.h"

namespace {
using namespace jarol;
using Pressure = RecordedStream::Pressure;

constexpr std::uint16_t value_topic = 1, event_topic = 2, gap_topic = 3;

// What came to the file, by a writer that writes nothing until it is let go.
struct Written {
  std::size_t chunks = 0;
  std::vector<std::int64_t> values;  // their instants
  std::vector<std::string> events;
  std::vector<Gap> gaps;
  std::vector<std::uint16_t> channels;  // in the order in which they were described
  std::string wrong;                    // a message of a channel that was not described yet

  void add(const mcap::Chunk& chunk) {
    ++chunks;
    if (chunk.crc() != mcap::crc32(chunk.records())) wrong = "another check sum";
    mcap::for_each_record(chunk.records(), [&](mcap::Opcode opcode, std::string_view content, std::size_t) {
      if (opcode == mcap::Opcode::channel) channels.push_back(mcap::read_channel(content).id);
      if (opcode == mcap::Opcode::message) add(mcap::read_message(content));
    });
  }

 private:
  void add(const mcap::Message& message) {
    if (std::find(channels.begin(), channels.end(), message.channel) == channels.end()) wrong = "not described";
    const std::span bytes(reinterpret_cast<const std::byte*>(message.data.data()), message.data.size());
    if (message.channel == value_topic) {
      double value = 0;
      if (!decode_cdr(type_of<double>(), bytes, &value).empty() || value != static_cast<double>(message.time.count()))
        wrong = "another value";
      values.push_back(message.time.count());
    } else if (message.channel == event_topic) {
      RecordedEvent event;
      wrong += decode_cdr(type_of<RecordedEvent>(), bytes, &event);
      events.push_back(std::string(event.task) + ": " + std::string(event.cause));
    } else {
      Gap gap;
      wrong += decode_cdr(type_of<Gap>(), bytes, &gap);
      gaps.push_back(gap);
    }
  }
};

// A stream of one double and, beside it, events and gaps.
class HeldUp {
 public:
  explicit HeldUp(Pressure pressure)
      : stream_(queue_, pressure, schemas(), {topic("value", value_topic, type_of<double>())},
                {topic("jarol/events", event_topic, type_of<RecordedEvent>()),
                 topic("jarol/gaps", gap_topic, type_of<Gap>())}) {
    stream_.name_tasks({"a"});
    queue_.start([this](const mcap::Chunk& chunk) {
      is_free_.wait(false);
      written_.add(chunk);
      ++done_;
      done_.notify_all();
    });
  }
  ~HeldUp() { let_go(); }

  // So many values, one a nanosecond.
  void take(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i, ++next_) {
      const auto value = static_cast<double>(next_);
      stream_.take(Duration(next_), 0, &value);
    }
  }
  RecordedStream& stream() { return stream_; }
  void let_go() {
    is_free_ = true;
    is_free_.notify_all();
  }
  // Until so many chunks are written; from then on the writer is held up again.
  void hold_up_after(std::size_t chunks) {
    let_go();
    for (std::size_t done = done_; done < chunks; done = done_) done_.wait(done);
    is_free_ = false;
  }
  // Others have filled the queue.
  void fill_queue() {
    for (std::size_t i = 0; i < ChunkQueue::room; ++i) queue_.push(queue_.empty_chunk());
  }
  const Written& end() {
    let_go();
    stream_.finish();
    return close();
  }
  const Written& close() {
    let_go();
    queue_.close();
    return written_;
  }
  std::int64_t taken() const { return next_; }

 private:
  static RecordedTopic topic(const std::string& name, std::uint16_t id, const Type& type) {
    return {{id, id, name, "cdr"}, &type};
  }
  static std::vector<mcap::Schema> schemas() {
    return {{value_topic, "v", "ros2msg", ""}, {event_topic, "e", "ros2msg", ""}, {gap_topic, "g", "ros2msg", ""}};
  }

  std::atomic<bool> is_free_{false};
  std::atomic<std::size_t> done_{0};
  Written written_;
  ChunkQueue queue_;
  RecordedStream stream_;
  std::int64_t next_ = 0;
};

// Of a chunk of 256 KiB, beside the descriptions in the first one.
constexpr std::int64_t in_a_chunk = (1 << 18) / (static_cast<std::int64_t>(mcap::message_head) + 12);
// So many of them wait in the queue and before it.
constexpr std::int64_t room = ChunkQueue::room + ChunkRing::chunks - 1;
}  // namespace

TEST_SUITE("runtime/recorded_stream") {
  TEST_CASE(
      "while the writer is held up what is published is left out beyond what there is room for, counted and reported") {
    HeldUp run(Pressure::drops);
    run.take((room + 4) * in_a_chunk);
    const std::uint64_t dropped = run.stream().dropped();
    CHECK(dropped > 2 * in_a_chunk);
    CHECK(dropped < 4 * in_a_chunk);
    const Written& written = run.end();
    CHECK(written.wrong == "");
    REQUIRE(written.gaps.size() == 1);
    const Gap gap = written.gaps[0];
    CHECK(gap.values == dropped);
    CHECK(gap.to - gap.from + 1 == static_cast<std::int64_t>(dropped));
    CHECK(written.values.size() + dropped == static_cast<std::size_t>(run.taken()));
    // there are all others, each once and in order
    std::int64_t next = 0;
    for (const std::int64_t instant : written.values) {
      if (next == gap.from) next = gap.to + 1;
      REQUIRE(instant == next);
      ++next;
    }
    CHECK(next == run.taken());
  }

  TEST_CASE("each time that the writer is held up is a gap of its own, and what is published between is there") {
    HeldUp run(Pressure::drops);
    run.take((room + 2) * in_a_chunk);
    const std::uint64_t first = run.stream().dropped();
    REQUIRE(first > 0);
    run.hold_up_after(ChunkQueue::room);
    const std::int64_t again = run.taken();
    run.take((room + 3) * in_a_chunk);
    const Written& written = run.end();
    CHECK(written.wrong == "");
    REQUIRE(written.gaps.size() == 2);
    CHECK(written.gaps[0].values == first);
    CHECK(written.gaps[0].to < again);
    CHECK(written.gaps[1].from > again);
    CHECK(written.gaps[0].values + written.gaps[1].values == run.stream().dropped());
    CHECK(written.values.size() + run.stream().dropped() == static_cast<std::size_t>(run.taken()));
    CHECK(std::find(written.values.begin(), written.values.end(), again) != written.values.end());
  }

  TEST_CASE("a gap that lasts until the end is reported in a piece of its own") {
    HeldUp run(Pressure::drops);
    run.take(room * in_a_chunk);
    while (run.stream().dropped() == 0) run.take(1);
    const std::uint64_t dropped = run.stream().dropped();
    const Written& written = run.end();  // after it only the value that did not fit any more
    REQUIRE(written.gaps.size() == 1);
    CHECK(written.gaps[0].values == dropped);
    CHECK(written.values.back() == run.taken() - 1);
  }

  TEST_CASE("where even the first piece is left out the topics are described in the next") {
    HeldUp run(Pressure::drops);
    run.take(3);
    run.stream().end_unfinished(Duration(9));
    const Written& written = run.close();
    CHECK(written.wrong == "");
    CHECK(written.channels == std::vector<std::uint16_t>{value_topic, event_topic, gap_topic});
    REQUIRE(written.gaps.size() == 1);
    CHECK(written.gaps[0].from == 0);
    CHECK(written.gaps[0].to == 9);
    CHECK(written.gaps[0].values == 3);
    CHECK(written.values.empty());
  }

  TEST_CASE("what is taken directly comes whole and in order where it may wait, and calls for whoever carries it") {
    HeldUp run(Pressure::waits);
    Bell bell;
    run.stream().take_directly(&bell);
    std::atomic<bool> is_over{false};
    std::thread carrying([&] {
      while (!is_over) {
        const std::uint32_t rings = bell.rings();
        if (!run.stream().carry()) bell.sleep(rings);
      }
    });
    run.let_go();
    run.take((room + 24) * in_a_chunk);
    is_over = true;
    carrying.join();
    const Written& written = run.end();
    CHECK(written.wrong == "");
    CHECK(written.gaps.empty());
    REQUIRE(written.values.size() == static_cast<std::size_t>(run.taken()));
    for (std::size_t i = 0; i < written.values.size(); ++i) REQUIRE(written.values[i] == static_cast<std::int64_t>(i));
  }

  TEST_CASE("what is taken directly while nobody carries it waits in the stream, and beyond that is left out") {
    HeldUp run(Pressure::drops);
    Bell bell;
    run.stream().take_directly(&bell);
    run.take((ChunkRing::chunks - 1) * in_a_chunk);
    CHECK(run.stream().dropped() == 0);
    CHECK(bell.rings() == 0);  // nobody sleeps
    run.take(2 * in_a_chunk);
    CHECK(run.stream().dropped() > 0);
    while (run.stream().carry()) {}
    run.take(1);
    const Written& written = run.end();
    CHECK(written.wrong == "");
    REQUIRE(written.gaps.size() == 1);
    CHECK(written.gaps[0].values == run.stream().dropped());
    CHECK(written.values.size() + run.stream().dropped() == static_cast<std::size_t>(run.taken()));
  }

  TEST_CASE("what a replay needs goes out as soon as a piece of what is published does") {
    HeldUp run(Pressure::keeps);
    run.take(1);
    run.stream().pause();
    run.take(1);
    run.fill_queue();
    run.stream().pause();
    run.take(1);
    const Written& written = run.end();
    CHECK(written.chunks == 3 + ChunkQueue::room);
    CHECK(written.values == std::vector<std::int64_t>{0, 1, 2});
  }

  TEST_CASE(
      "what a replay needs waits for the writer where the run may wait, and goes out with the other pieces, too") {
    HeldUp run(Pressure::keeps_by_waiting);
    run.take(1);
    run.stream().pause();
    run.take(1);
    run.fill_queue();
    std::atomic<bool> went_on{false};
    std::thread waiting([&] {
      run.stream().pause();
      went_on = true;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK_FALSE(went_on);
    run.let_go();
    waiting.join();
    const Written& written = run.end();
    CHECK(written.chunks == 2 + ChunkQueue::room);
    CHECK(written.values == std::vector<std::int64_t>{0, 1});
  }

  TEST_CASE("what a replay needs is never left out, however long the writer is held up") {
    HeldUp run(Pressure::keeps);
    run.take((room + 24) * in_a_chunk);
    run.stream().take_event({RunEvent::Kind::fault, Duration(run.taken()), 0, 3, "late"});
    CHECK(run.stream().dropped() == 0);
    const Written& written = run.end();
    CHECK(written.wrong == "");
    CHECK(written.chunks > 16);
    CHECK(written.gaps.empty());
    CHECK(written.events == std::vector<std::string>{"a: late"});
    REQUIRE(written.values.size() == static_cast<std::size_t>(run.taken()));
    for (std::size_t i = 0; i < written.values.size(); ++i) REQUIRE(written.values[i] == static_cast<std::int64_t>(i));
  }
}
