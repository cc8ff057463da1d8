// Logs that somebody has changed and whose sums he has mended: they are refused, or replayed as they stand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "graph/values/pack.h"
#include "graph/values/seed.h"
#include "graph/values/type_of.h"
#include "runtime/execute/log_end.h"
#include "runtime/record/log_reader.h"
#include "runtime/record/log_writer.h"
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
  static const Graph graph = tests::graph_of(registry, R"(graph: t
timing: {period: 3ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.sensor, period: 1ms}
  w: {channel: p.window}
  o: {channel: p.actuator, period: 1ms}
  mean: {type: double, direction: out}
tasks: {r: {type: Accumulate, period: 1ms, on_fault: hold}, m: {type: Mean}}
connections: [i -> r.in, r.out -> o, w -> m.in, m.out -> mean]
)");
  return graph;
}

void write_log(const std::string& path) {
  LogWriter log(path, {.graph = "t", .file = "/t.yaml", .file_sum = "", .overrides = {}, .clock = "virtual"},
                the_graph());
  const std::vector<Miss> misses{{.activation = 12, .ended_after = 1'200'000, .task = 1, .left_out = 0}};
  log.open();
  Executor executor(the_graph(), tests::outside(), {.log = log.recorder(), .misses = misses});
  executor.run_until(1500ms);
  log.close(log_end_of(executor.report()));
}

struct Record {
  LogRecord head;
  std::string bytes;
};

struct Log {
  std::string line;
  std::vector<Record> records;  // but for the one of the line
};

Log read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Log log;
  std::getline(file, log.line);
  log.line += '\n';
  Record record;
  file.read(reinterpret_cast<char*>(&record.head), sizeof record.head);
  while (file.read(reinterpret_cast<char*>(&record.head), sizeof record.head)) {
    record.bytes.resize(record.head.size);
    file.read(record.bytes.data(), record.head.size);
    log.records.push_back(record);
  }
  return log;
}

// With the sums that belong to it.
void write(const Log& log, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](LogRecord head, const std::string& bytes, const std::string& line) {
    head.sum = LogRecord::sum_of(head, head.output == LogRecord::header ? line : bytes);
    file.write(reinterpret_cast<const char*>(&head), sizeof head);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  file << log.line;
  put({0, LogRecord::header, 0, 0}, "", log.line);
  for (const Record& record : log.records) put(record.head, record.bytes, "");
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
                                         0xfffffff0,
                                         0xfffffff1,
                                         0xfffffff2,
                                         0xfffffff3,
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
      if (log.records[i].head.output >= LogRecord::header) others.push_back(i);
    if (!others.empty() && random.below(2) == 0) return log.records[others[random.below(others.size())]];
    return log.records[random.below(log.records.size())];
  };
  const auto set_word = [&](std::string& bytes) {
    if (bytes.size() < 8) return;
    const std::uint64_t word = odd();
    std::memcpy(bytes.data() + random.below(bytes.size() / 8) * 8, &word, sizeof word);
  };
  for (std::uint64_t changes = 1 + random.below(3); changes > 0; --changes) {
    Record& record = any();
    switch (random.below(9)) {
      case 0: log.line[random.below(log.line.size() - 1)] = static_cast<char>(random.below(256)); break;
      case 1: record.head.instant = static_cast<std::int64_t>(odd()); break;
      case 2: record.head.instant += static_cast<std::int64_t>(random.below(5)) - 2; break;
      case 3: record.head.output = static_cast<std::uint32_t>(random.below(2) == 0 ? odd() : random.below(4)); break;
      case 4: record.bytes.resize(random.below(record.bytes.size() + 20)); break;
      case 5: set_word(record.bytes); break;
      case 6:
        if (!record.bytes.empty())
          record.bytes[random.below(record.bytes.size())] ^= static_cast<char>(1 + random.below(255));
        break;
      case 7: std::swap(record, any()); break;
      default:
        record.head.size = static_cast<std::uint32_t>(record.bytes.size());
        log.records.insert(log.records.begin() + static_cast<std::ptrdiff_t>(random.below(log.records.size())),
                           Record(record));
        continue;  // the record may be elsewhere now
    }
    record.head.size = static_cast<std::uint32_t>(record.bytes.size());
  }
  if (random.below(20) == 0) any().head.size = static_cast<std::uint32_t>(odd());
}

// What is said of it, or nothing: it was replayed.
std::string report_on(const std::string& path) {
  try {
    LogReader log(path);
    const std::vector<Miss> misses = log.begin(the_graph());
    Executor executor(the_graph(), replayed_channels(the_graph(), log), {.misses = misses});
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
    Log part{whole.line, {}};
    for (const Record& record : whole.records)
      if (record.head.instant < 30'000'000 || record.head.output >= LogRecord::header) part.records.push_back(record);
    write(whole, path);
    REQUIRE(report_on(path) == "");
    const std::uint64_t count = std::getenv("JAROL_FULL") != nullptr ? 200'000 : 20'000;
    std::uint64_t replayed = 0, refused = 0, in_record = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      CAPTURE(seed);
      Log log = part;
      mutate(log, seed);
      write(log, path);
      const std::string report = report_on(path);
      ++(report.empty() ? replayed : refused);
      in_record += report.find("; it is no log that jarol run --log has written") != std::string::npos;
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
    const auto first = [&](std::uint32_t output) {
      return static_cast<std::size_t>(std::find_if(whole.records.begin(), whole.records.end(),
                                                   [&](const Record& r) { return r.head.output == output; }) -
                                      whole.records.begin());
    };
    const auto report = [&](std::uint32_t output, auto change, std::size_t after = 0) {
      Log log = whole;
      const std::size_t at = first(output) + after;
      change(log.records.at(at));
      log.records[at].head.size = static_cast<std::uint32_t>(log.records[at].bytes.size());
      write(log, path);
      std::size_t byte = log.line.size() + sizeof(LogRecord);
      for (std::size_t i = 0; i < at; ++i) byte += sizeof(LogRecord) + whole.records[i].bytes.size();
      const std::string begin = "'" + path + "' has at byte " + std::to_string(byte) + " ",
                        end = "; it is no log that jarol run --log has written", text = report_on(path);
      CAPTURE(text);
      REQUIRE(text.starts_with(begin));
      REQUIRE(text.ends_with(end));
      return text.substr(begin.size(), text.size() - begin.size() - end.size());
    };
    const auto word = [](std::size_t at, std::uint64_t value) {
      return [=](Record& record) { std::memcpy(record.bytes.data() + 8 * at, &value, sizeof value); };
    };
    CHECK(report(0, [](Record& r) { r.bytes += "x"; }) == "a value of 'i' that ends 1 bytes before they do");
    CHECK(report(0, [](Record& r) { r.bytes.pop_back(); }) == "a value of 'i' that ends before its bytes do");
    CHECK(report(1, [](Record& r) { r.bytes.resize(7); }) == "a value of 'w' that ends before its length");
    CHECK(report(1, word(0, 1'000'000)) == "a value of 'w' that has a length of 1000000 and fewer bytes");
    CHECK(report(1, word(0, 0x2000000000000001)) ==
          "a value of 'w' that has a length of 2305843009213693953 and fewer bytes");
    CHECK(report(0, [](Record& r) { r.head.output = 2; }) == "what is of no known kind");
    CHECK(report(0, [](Record& r) { r.head.instant = -1; }) == "a value of 'i' before the one before it");
    CHECK(report(LogRecord::miss, word(2, 9)) == "a miss of task 9, and there are 2");
    CHECK(report(LogRecord::miss, word(2, 0x0000000200000001)) == "a miss that is neither late nor left out");
    CHECK(report(LogRecord::miss, word(0, ~std::uint64_t{0})) == "a miss at a time below zero");
    CHECK(report(LogRecord::miss, [](Record& r) { r.bytes += "x"; }) == "25 bytes where there are 24");
    CHECK(report(LogRecord::checkpoint, word(2, 2)) == "a checkpoint that is neither exact nor not");
    CHECK(report(LogRecord::checkpoint, word(0, ~std::uint64_t{0})) == "a checkpoint at no time of a run");
    const auto rest = [](std::int64_t begun) {
      return [=](Record& r) {
        r.head.output = LogRecord::rest;
        r.bytes.assign(reinterpret_cast<const char*>(&begun), sizeof begun);
      };
    };
    CHECK(report(LogRecord::miss, rest(-1)) == "a way to rest from no time of a run on");
    CHECK(report(LogRecord::end, word(0, 1)) == "an end before its last checkpoint");
    CHECK(report(LogRecord::end, word(1, 0x7fffffffffffffff)) == "an end at no time of a run");
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
