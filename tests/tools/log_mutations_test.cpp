// Logs that somebody has changed and whose sums he has mended: they are refused, or replayed as they stand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "graph/values/pack.h"
#include "graph/values/seed.h"
#include "graph/values/type_of.h"
#include "runtime/execute/log_end.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/how_many.h"
#include "tests/runtime/outside.h"
#include "tests/runtime/trace_of.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

const Graph& the_graph() {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(tests::plant());
    return made;
  }();
  static const Graph graph = tests::graph_of(registry, tests::plant_graph);
  return graph;
}

void write_log(const std::string& path) {
  RecordingWriter log(path, {.graph = "t", .file = "/t.yaml", .overrides = {}, .clock = "virtual"}, {}, the_graph());
  const std::vector<Miss> misses{{.activation = 12, .ended_after = 1'200'000, .task = 1, .left_out = 0}};
  log.open();
  Executor executor(the_graph(), tests::outside(), {.log = log.recorder(), .misses = misses});
  executor.run_until(1500ms);
  log.close(log_end_of(executor.report()));
}

struct Record {
  std::uint16_t channel = 0;
  std::int64_t time = 0;
  std::string bytes;
};

struct Log {
  std::string header;
  std::string descriptions;  // records of schemas and channels
  std::map<std::string, std::uint16_t> channels{};
  std::vector<Record> records{};

  bool is_value(const Record& record) const {
    return record.channel == channels.at("jarol/taken/i") || record.channel == channels.at("jarol/taken/w");
  }
};

Log read(const std::string& path) {
  Log log;
  const Recording recording(path, [&](const mcap::Message& message, const ReadTopic&, const ChunkSpot&) {
    log.records.push_back({message.channel, message.time.count(), std::string(message.data)});
  });
  log.header = to_json(recording.header());
  for (const auto& [id, topic] : recording.topics()) {
    log.channels[topic.channel.topic] = id;
    log.descriptions += record_of(mcap::Schema{topic.channel.schema, topic.schema_name, "ros2msg", topic.schema}) +
                        record_of(topic.channel);
  }
  return log;
}

// With the sums that belong to it, all in one chunk.
void write(const Log& log, const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  mcap::Writer writer(file, mcap::Compression::none, "jarol");
  writer.write({RecordingHeader::attachment, "", log.header});
  mcap::Chunk chunk;
  chunk.add(log.descriptions);
  for (const Record& record : log.records)
    std::memcpy(chunk.add_message(record.channel, 0, Duration(record.time), record.bytes.size()), record.bytes.data(),
                record.bytes.size());
  writer.write(chunk);
  writer.end({}, {});
  std::fclose(file);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t below(std::uint64_t count) { return spread_seed(seed_, std::to_string(next_++)) % count; }

 private:
  std::uint64_t seed_;
  int next_ = 0;
};

constexpr std::uint64_t odd_numbers[] = {0,
                                         1,
                                         2,
                                         7,
                                         8,
                                         255,
                                         65536,
                                         0x7fffffff,
                                         0x80000000,
                                         0xffffffff,
                                         0x7fffffffffffffff,
                                         0x8000000000000000,
                                         0xffffffffffffffff};

void mutate(Log& log, std::uint64_t seed) {
  Random random(seed);
  const auto odd = [&] { return odd_numbers[random.below(std::size(odd_numbers))]; };
  const auto any = [&]() -> Record& {
    // the few that are no values, as often as these
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < log.records.size(); ++i)
      if (!log.is_value(log.records[i])) others.push_back(i);
    if (!others.empty() && random.below(2) == 0) return log.records[others[random.below(others.size())]];
    return log.records[random.below(log.records.size())];
  };
  const auto set_word = [&](std::string& bytes) {
    constexpr std::size_t head = 4;  // of CDR
    if (bytes.size() < head + 8) return;
    const std::uint64_t word = odd();
    std::memcpy(bytes.data() + head + random.below((bytes.size() - head) / 8) * 8, &word, sizeof word);
  };
  for (std::uint64_t changes = 1 + random.below(3); changes > 0; --changes) {
    Record& record = any();
    switch (random.below(10)) {
      case 0: log.header[random.below(log.header.size())] = static_cast<char>(random.below(256)); break;
      case 1: record.time = static_cast<std::int64_t>(odd()); break;
      case 2:
        record.time = static_cast<std::int64_t>(static_cast<std::uint64_t>(record.time) + random.below(5) - 2);
        break;
      case 3: record.channel = static_cast<std::uint16_t>(random.below(2) == 0 ? odd() : random.below(8)); break;
      case 4: record.bytes.resize(random.below(record.bytes.size() + 20)); break;
      case 5: set_word(record.bytes); break;
      case 6:
        if (!record.bytes.empty())
          record.bytes[random.below(record.bytes.size())] ^= static_cast<char>(1 + random.below(255));
        break;
      case 7: std::swap(record, any()); break;
      case 8:
        log.descriptions[random.below(log.descriptions.size())] ^= static_cast<char>(1 + random.below(255));
        break;
      default:
        log.records.insert(log.records.begin() + static_cast<std::ptrdiff_t>(random.below(log.records.size())),
                           Record(record));
    }
  }
}

// What is said of it, or nothing: it was replayed.
std::string refusal_of(const std::string& path) {
  try {
    RecordedRun log(path);
    const std::vector<Miss> misses = log.begin(the_graph());
    Executor executor(the_graph(), replayed_systems(the_graph(), log), {.misses = misses});
    executor.run_until(std::min<Duration>(log.covered(), 1500ms));
    log.require_all_taken();
  } catch (const LogError& error) { return error.what(); }
  return "";
}

struct Switch {
  bool on = false;
  double level = 0;
  Sequence<bool> bits{};
  static constexpr auto fields() {
    return describe(field<&Switch::on>(), field<&Switch::level>(), field<&Switch::bits>());
  }
};
}  // namespace

TEST_SUITE("tools/log_mutations") {
  TEST_CASE("twenty thousand damaged logs with mended sums: each is refused with a reason, or replayed") {
    const command::TemporaryFolder folder;
    const std::string path = folder / "log";
    write_log(path);
    const Log whole = read(path);
    REQUIRE(whole.records.size() > 1000);
    // so few that each can be hit
    Log part = whole;
    std::erase_if(part.records, [&](const Record& r) { return whole.is_value(r) && r.time >= 30'000'000; });
    write(whole, path);
    REQUIRE(refusal_of(path) == "");
    const std::uint64_t count = tests::how_many(20'000, 200'000, 5'000);
    std::uint64_t replayed = 0, refused = 0, in_record = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      CAPTURE(seed);
      Log log = part;
      mutate(log, seed);
      write(log, path);
      const std::string report = refusal_of(path);
      ++(report.empty() ? replayed : refused);
      in_record += report.find("; it is no recording that jarol run has written") != std::string::npos;
      if (!report.empty()) REQUIRE(report.starts_with("'" + path + "' "));
    }
    MESSAGE(replayed << " replayed, " << refused << " refused, " << in_record << " of these for a record");
    CHECK(replayed > count / 100);
    CHECK(in_record > count / 4);
  }

  TEST_CASE("what no run writes is refused by what is wrong with it") {
    const command::TemporaryFolder folder;
    const std::string path = folder / "log";
    write_log(path);
    const Log whole = read(path);
    write(whole, path);
    const std::uint64_t first_chunk = Recording(path).chunks().at(0).offset;
    REQUIRE(refusal_of(path) == "");
    const auto report = [&](const std::string& topic, auto change) {
      Log log = whole;
      change(*std::find_if(log.records.begin(), log.records.end(),
                           [&](const Record& r) { return r.channel == log.channels.at(topic); }));
      write(log, path);
      const std::string begin = "'" + path + "' has in the chunk at byte " + std::to_string(first_chunk) + " ",
                        end = "; it is no recording that jarol run has written", text = refusal_of(path);
      CAPTURE(text);
      REQUIRE(text.starts_with(begin));
      REQUIRE(text.ends_with(end));
      return text.substr(begin.size(), text.size() - begin.size() - end.size());
    };
    const auto word = [](std::size_t byte, auto value) {
      return [=](Record& record) { std::memcpy(record.bytes.data() + 4 + byte, &value, sizeof value); };
    };
    const std::string i = "jarol/taken/i", w = "jarol/taken/w", miss = "jarol/misses", digest = "jarol/digests";
    CHECK(report(i, [](Record& r) { r.bytes += "x"; }) == "a value of 'i' that ends 1 bytes before they do");
    CHECK(report(i, [](Record& r) { r.bytes.pop_back(); }) == "a value of 'i' that ends before its bytes do");
    CHECK(report(i, [](Record& r) { r.bytes[1] = 0; }) == "a value of 'i' that does not begin as little-endian CDR");
    CHECK(report(w, [](Record& r) { r.bytes.resize(7); }) == "a value of 'w' that ends before its length");
    CHECK(report(w, word(0, 1'000'000)) == "a value of 'w' that has a length of 1000000 and fewer bytes");
    CHECK(report(w, word(0, 0x20000001)) == "a value of 'w' that has a length of 536870913 and fewer bytes");
    CHECK(report(i, [](Record& r) { r.time = -1; }) == "a value of 'i' before the one before it");
    CHECK(report(miss, word(20, 2)) == "a miss that is neither late nor left out");
    CHECK(report(miss, word(0, std::int64_t{-1})) == "a miss at a time below zero");
    CHECK(report(miss, [](Record& r) { r.bytes += "x"; }) ==
          "a message of 'jarol/misses' that ends 1 bytes before they do");
    CHECK(report(digest, word(16, std::int64_t{2})) == "a digest that is neither exact nor not");
    CHECK(report(digest, word(0, std::int64_t{-1})) == "a digest at no time of a run");
    const auto rest = [&](std::int64_t begun) {
      return [&whole, begun](Record& r) {
        r.channel = whole.channels.at("jarol/rest");
        r.bytes = std::string("\0\1\0\0", 4) + std::string(reinterpret_cast<const char*>(&begun), sizeof begun);
      };
    };
    CHECK(report(miss, rest(-1)) == "a way to rest from no time of a run on");
    CHECK(report("jarol/end", word(0, std::int64_t{1})) == "an end before its last digest");
    CHECK(report("jarol/end", word(8, 0x7fffffffffffffff)) == "an end at no time of a run");
    Log log = whole;
    for (Record& r : log.records)
      if (r.channel == log.channels.at(miss)) word(16, 9)(r);
    write(log, path);
    CHECK(refusal_of(path) == "'" + path + "' has a miss of task 9, and there are 2");
  }

  TEST_CASE("truth values are 0 or 1, in flat values and in sequences") {
    const Type& type = type_of<Switch>();
    Switch value;
    value.bits.push_back(true);
    value.bits.push_back(false);
    std::vector<std::byte> packed(packed_size(type, &value));
    pack(type, &value, packed.data());
    CHECK(wrong_packed(type, packed) == "");
    for (std::size_t i = 0; i < packed.size(); ++i) {
      CAPTURE(i);
      std::vector<std::byte> changed = packed;
      changed[i] = std::byte{7};
      const bool is_truth = i == 0 || i + 2 >= packed.size(), is_length = !is_truth && i >= packed.size() - 10;
      const std::string wrong = wrong_packed(type, changed);
      if (is_truth) CHECK(wrong == "has 7 where true or false stand");
      if (is_length) CHECK(wrong.find("has a length of ") == 0);
      if (!is_truth && !is_length) CHECK(wrong == "");
      CHECK(wrong_packed(type, std::span(packed).first(i)) != "");
    }
  }
}
