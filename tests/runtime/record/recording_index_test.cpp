// A recording that is looked into by the index at its end is the one that is gone through from its begin.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "runtime/execute/log_end.h"
#include "runtime/record/instants.h"
#include "runtime/record/message_cursor.h"
#include "runtime/record/recording_writer.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

class IndexedFile {
 public:
  IndexedFile() : path_(fs::temp_directory_path() / ("recording_index_" + std::to_string(::getpid()))) {}
  ~IndexedFile() { fs::remove(path_); }
  std::string path() const { return path_.string(); }
  std::string content() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

 private:
  fs::path path_;
};

void record(
    const std::string& path, mcap::Compression compression = mcap::Compression::lz4,
    const std::function<void()>& meanwhile = [] {}, std::uint64_t split = 0) {
  const Graph graph = tests::graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 1ms}
  b: {type: Relay, period: 2ms, let: 1ms}
connections: [a.out -> b.in]
)");
  RecordingHeader header{.graph = "t", .file = "", .overrides = {}, .clock = "virtual", .what = "all"};
  header.split = split;
  RecordingWriter writer(path, header, {{"/t.yaml", "a text"}}, graph, compression);
  writer.open();
  meanwhile();
  Recorder recorder({writer.publications()});
  Executor executor(graph, {}, {.recorder = &recorder, .log = writer.recorder()});
  executor.run_until(60s);
  recorder.close();
  writer.close(log_end_of(executor.report()));
}

// All that is known of it.
std::string text_of(const Recording& recording) {
  std::string text = recording.header().graph + " " + std::to_string(recording.is_whole()) + " " +
                     std::to_string(recording.good_until()) + " " + recording.files().at(0).text;
  for (const auto& [id, topic] : recording.topics())
    text += "\n" + std::to_string(id) + " " + topic.channel.topic + " " + topic.schema_name + " " + topic.schema + " " +
            std::to_string(topic.messages);
  for (const ReadPlace& chunk : recording.chunks())
    text += "\n" + std::to_string(chunk.offset) + " " + std::to_string(chunk.start.count()) + " " +
            std::to_string(chunk.end.count()) + " " + std::to_string(chunk.min_channel) + " " +
            std::to_string(chunk.max_channel);
  return text;
}

const Recording::Visit nobody = [](const mcap::Message&, const ReadTopic&, const ChunkSpot&) {};

std::vector<bool> topic_of(const Recording& recording, const std::string& name) {
  std::vector<bool> wanted(65536);
  wanted[recording.find(name)->channel.id] = true;
  return wanted;
}
}  // namespace

TEST_SUITE("runtime/recording_index") {
  TEST_CASE("of a recording that was removed, moved or replaced while it was written it is said that it is not there") {
    const IndexedFile file;
    const std::string other = file.path() + ".moved";
    const std::string lost =
        "'" + file.path() + "' is not there any more: it was moved, removed or replaced while it was written";
    CHECK_THROWS_WITH_AS(record(file.path(), mcap::Compression::lz4, [&] { fs::remove(file.path()); }), lost.c_str(),
                         std::runtime_error);
    CHECK_THROWS_WITH_AS(record(file.path(), mcap::Compression::lz4, [&] { fs::rename(file.path(), other); }),
                         lost.c_str(), std::runtime_error);
    CHECK_THROWS_WITH_AS(record(file.path(), mcap::Compression::lz4,
                                [&] {
                                  fs::remove(file.path());
                                  file.write("");
                                }),
                         lost.c_str(), std::runtime_error);
    fs::remove(file.path());
    fs::remove(other);
    CHECK_NOTHROW(record(file.path()));
  }

  TEST_CASE("a part of a recording that was moved does not cost the next ones") {
    const IndexedFile file;
    const std::string other = file.path() + ".moved", second = file.path() + ".2";
    const std::string moved =
        "'" + file.path() + "' is not there any more: it was moved, removed or replaced while it was written";
    CHECK_THROWS_WITH_AS(record(
                             file.path(), mcap::Compression::none, [&] { fs::rename(file.path(), other); }, 1'000'000),
                         moved.c_str(), std::runtime_error);
    fs::rename(other, file.path());
    const Recording whole(file.path());
    CHECK(whole.is_whole());
    CHECK(whole.parts().size() > 2);
    for (const auto& part : whole.parts()) fs::remove(part);
  }

  TEST_CASE("what the index says is what the whole file says") {
    const IndexedFile file;
    record(file.path());
    const Recording by_index(file.path());
    CHECK(by_index.is_whole());
    CHECK(by_index.chunks().size() > 2);
    CHECK(text_of(by_index) == text_of(Recording(file.path(), nobody)));
  }

  TEST_CASE("an instant of more bytes than a run has is refused") {
    const IndexedFile file;
    record(file.path());
    const Recording recording(file.path());
    const std::vector<bool> published = published_channels(recording);
    RecordedInstants enough(recording, published, {}, 2 * (sizeof(RecordedInstants::Message) + 12));
    while (enough.next()) CHECK(enough.messages().size() <= 2);
    RecordedInstants too_few(recording, published, {}, sizeof(RecordedInstants::Message) + 12);
    const std::uint16_t channel = recording.find("a.out")->channel.id;
    const auto first = std::find_if(recording.chunks().begin(), recording.chunks().end(), [&](const ReadPlace& chunk) {
      return chunk.min_channel <= channel && channel <= chunk.max_channel;
    });
    const auto read_all = [&] {
      while (too_few.next()) {}
    };
    CHECK_THROWS_WITH_AS(
        read_all(),
        ("'" + file.path() + "' has in the chunk at byte " + std::to_string(first->offset) +
         " an instant, 0.001 s, of more than " + std::to_string(sizeof(RecordedInstants::Message) + 12) +
         " bytes; it is no recording that jarol run has written")
            .c_str(),
        LogError);
  }

  TEST_CASE("an instant is found by the index, and only the chunks that have it are read") {
    const IndexedFile file;
    record(file.path());
    std::string bytes = file.content();
    const Recording whole(file.path());
    // what is damaged in front is not seen by who looks behind
    const std::uint16_t channel = whole.find("a.out")->channel.id;
    const auto first = std::find_if(whole.chunks().begin(), whole.chunks().end(), [&](const ReadPlace& chunk) {
      return chunk.min_channel <= channel && channel <= chunk.max_channel;
    });
    bytes[first->offset + 100] ^= 1;
    file.write(bytes);
    const Recording recording(file.path());
    MessageCursor cursor(recording, topic_of(recording, "a.out"), 59s);
    REQUIRE(cursor.message() != nullptr);
    CHECK(cursor.message()->time == 59s);
    CHECK_THROWS_WITH_AS(MessageCursor(recording, topic_of(recording, "a.out")),
                         ("'" + file.path() + "' is damaged: at byte " + std::to_string(first->offset) +
                          " there is a chunk whose check sum is another")
                             .c_str(),
                         LogError);
    CHECK(!Recording(file.path(), nobody).is_whole());
  }

  TEST_CASE("an index that is damaged anywhere, or lacks, is not believed") {
    const IndexedFile file;
    record(file.path());
    const std::string bytes = file.content(), should = text_of(Recording(file.path()));
    const std::size_t data_end = Recording(file.path(), nobody).chunks().back().offset;
    std::size_t whole = 0;
    for (std::size_t at = bytes.size() - 1; at > data_end; at -= std::min<std::size_t>(at, 13)) {
      std::string damaged = bytes;
      damaged[at] ^= 0x10;
      file.write(damaged);
      // either it is not in the index, or the file is gone through, which finds the same
      const Recording recording(file.path());
      if (recording.is_whole()) {
        REQUIRE(text_of(recording) == should);
        ++whole;
      }
    }
    CHECK(whole > 10);
    // that the index, its footer or the end of the data can't be read any more is no loss
    std::uint64_t summary = 0;
    std::memcpy(&summary, bytes.data() + bytes.size() - mcap::magic.size() - 20, sizeof summary);
    for (std::size_t at = summary - mcap::record_head - 4; at < bytes.size() - mcap::magic.size(); at += 5) {
      CAPTURE(at);
      for (const char bits : {'\x01', '\x80'}) {
        std::string damaged = bytes;
        damaged[at] ^= bits;
        file.write(damaged);
        const Recording recording(file.path());
        REQUIRE(recording.is_whole());
        REQUIRE(text_of(recording) == should);
        const Recording gone_through(file.path(), nobody);
        REQUIRE(gone_through.is_whole());
        REQUIRE(text_of(gone_through) == should);
      }
    }
    file.write(bytes.substr(0, bytes.size() - 1));
    CHECK(!Recording(file.path()).is_whole());
    CHECK(Recording(file.path()).topics().size() == Recording(file.path(), nobody).topics().size());
  }

  TEST_CASE("a chunk that was made with a right check sum, and breaks off within, is refused") {
    const IndexedFile file;
    std::FILE* const out = std::fopen(file.path().c_str(), "wb");
    mcap::Writer writer(out, mcap::Compression::none, "jarol");
    writer.write(
        {RecordingHeader::attachment, "", to_json({.graph = "t", .file = "", .overrides = {}, .clock = "virtual"})});
    const mcap::Schema schema{1, "s", "ros2msg", "float64 value\n"};
    const mcap::Channel channel{1, 1, "a", "cdr"};
    mcap::Chunk chunk;
    chunk.add(record_of(schema));
    chunk.add(record_of(channel));
    chunk.add_message(1, 0, Duration(5), 12);
    chunk.add("\x05half");
    writer.write(chunk);
    writer.end({schema}, {channel});
    std::fclose(out);
    const Recording recording(file.path());
    CHECK(recording.is_whole());
    CHECK_THROWS_WITH_AS(MessageCursor(recording, topic_of(recording, "a")),
                         ("'" + file.path() + "' is damaged: at byte " + std::to_string(recording.chunks()[0].offset) +
                          " there is a record that breaks off")
                             .c_str(),
                         LogError);
  }
}
