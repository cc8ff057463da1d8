// Recordings are read to the bit by the npm packages that tools of the field read MCAP with.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "graph/values/value.h"
#include "runtime/execute/log_end.h"
#include "runtime/record/recording_writer.h"
#include "runtime/record/ros2msg.h"
#include "runtime/record/trace_csv.h"
#include "tests/graph/graph_of.h"
#include "tests/runtime/random_model.h"
#include "tests/runtime/record/every_kind.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using command::TemporaryFolder;

// Else the test says so and is left out.
bool are_fetched() {
  const bool there = std::filesystem::exists(JAROL_NODE_MODULES "/node_modules");
  if (!there) MESSAGE("left out: the readers were not fetched");
  return there;
}

std::string read(const std::string& arguments) {
  const std::string line =
      "JAROL_NODE_MODULES=" JAROL_NODE_MODULES " " JAROL_NODE " tests/recordings/read.mjs " + arguments + " 2>&1";
  std::FILE* const pipe = popen(line.c_str(), "r");
  std::string output;
  std::array<char, 65536> piece;
  for (std::size_t n; (n = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;) output.append(piece.data(), n);
  return pclose(pipe) == 0 ? output : "failed: " + output;
}

// "path bits" of each number, as the reader prints them.
void add_lines(const Type& type, const std::byte* value, const std::string& path, const std::string& before,
               std::string& to) {
  const auto line = [&](const std::string& at, std::uint64_t bits) {
    char hex[20];
    std::snprintf(hex, sizeof hex, "%lx", bits);
    to += before + at + " " + hex + "\n";
  };
  const auto in = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  if (type.kind == Kind::structure) {
    for (const TypeField& f : type.fields) add_lines(*f.type, value + f.offset, in(f.name), before, to);
    return;
  }
  const bool listed = type.length != nullptr;
  if (type.kind != Kind::array && !listed) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, value, type.size);
    return line(path, bits);
  }
  const std::size_t count = listed ? type.length(value) : type.count;
  const auto* const elements = listed ? static_cast<const std::byte*>(type.elements(value)) : value;
  if (listed) line(in("length"), count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string at = in(std::to_string(i));
    if (type.kind == Kind::string) {
      line(at, std::to_integer<std::uint64_t>(elements[i]));
      continue;
    }
    // what ROS has no arrays of stands in a struct
    const Type& element = *type.element;
    const bool is_list = element.kind == Kind::array || element.kind == Kind::sequence;
    add_lines(element, elements + i * element.size,
              at + (is_list                        ? ".values"
                    : element.kind == Kind::string ? ".value"
                                                   : ""),
              before, to);
  }
}
}  // namespace

TEST_SUITE("recordings") {
  TEST_CASE("the shipped specs are read as their traces say") {
    if (!are_fetched()) return;
    const TemporaryFolder folder;
    std::string files;
    for (const std::string spec : {"counting", "window",
#ifdef JAROL_VEHICLES
                                   "exolauv", "exolauv_bare", "javiator", "passthrough"
#endif
         })
      for (const std::string compression : {"lz4", "zstd", "none"}) {
        const std::string file = folder / (spec + compression);
        const auto run = command::run_jarol("run specs/" + spec + ".yaml --for 3s --record " + file + " --trace " +
                                            file + ".csv --record-compression " + compression);
        CAPTURE(run.output);
        REQUIRE(run.exit_code == 0);
        files += " " + file + " " + file + ".csv";
      }
    const std::string output = read("compare" + files);
    CAPTURE(output);
    CHECK(output.ends_with(" numbers are the same\n"));
  }

  TEST_CASE("two hundred random graphs are read as their traces say") {
    if (!are_fetched()) return;
    const TemporaryFolder folder;
    std::string files;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const std::string file = folder / std::to_string(seed);
      const Graph graph = tests::graph_of(to_yaml(oracle::random_model(seed), 0));
      RecordingWriter writer(
          file, {.graph = graph.name, .file = "", .overrides = {}, .clock = "virtual", .what = "all"},
          {{"/g.yaml", "graph"}}, graph,
          std::array{mcap::Compression::none, mcap::Compression::lz4, mcap::Compression::zstd}[seed % 3]);
      TraceCsv trace(file + ".csv", outputs_of(graph));
      writer.open();
      Recorder recorder({writer.publications(), &trace});
      Executor executor(graph, {}, {.recorder = &recorder, .workers = 1 + seed % 2, .log = writer.recorder()});
      executor.run_until(std::chrono::milliseconds(30));
      recorder.close();
      writer.close(log_end_of(executor.report()));
      files += " " + file + " " + file + ".csv";
    }
    const std::string output = read("compare" + files);
    CAPTURE(output.substr(0, 2000));
    CHECK(output.ends_with(" numbers are the same\n"));
    CHECK(output != "0 numbers are the same\n");
  }

  TEST_CASE("each part of a split recording is read as a file of its own, and all hold what one file does") {
    if (!are_fetched()) return;
    const TemporaryFolder folder;
    const std::string run = "run " + folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 10ms}
  sum: {type: Accumulate, period: 10ms}
  window: {type: Window, period: 30ms, heap: 64KiB, parameters: {length: 500}}
  mean: {type: Mean, period: 30ms}
connections: [count.out -> sum.in, sum.out -> window.in, window.out -> mean.in]
)") + " --for 20s --record-checkpoints 7s --record-compression none --record ";
    REQUIRE(command::run_jarol(run + (folder / "one.mcap")).exit_code == 0);
    REQUIRE(command::run_jarol(run + (folder / "r.mcap") + " --record-split 1MiB").exit_code == 0);
    const auto lines_of = [](const std::string& file) {
      std::vector<std::string> lines;
      std::istringstream dump(read("dump " + file));
      for (std::string line; std::getline(dump, line);) lines.push_back(line);
      return lines;
    };
    std::vector<std::string> parts = lines_of(folder / "r.mcap"), one = lines_of(folder / "one.mcap");
    int part = 2;
    for (; std::filesystem::exists(folder / ("r." + std::to_string(part) + ".mcap")); ++part) {
      const std::vector<std::string> more = lines_of(folder / ("r." + std::to_string(part) + ".mcap"));
      CHECK(more.size() > 10);
      parts.insert(parts.end(), more.begin(), more.end());
    }
    CHECK(part > 3);
    CHECK(std::count_if(one.begin(), one.end(),
                        [](const std::string& line) { return line.starts_with("mean.out "); }) == 20'000 / 30 + 1);
    // a part may hold messages from before the end of the one that it follows
    for (auto* lines : {&parts, &one}) std::sort(lines->begin(), lines->end());
    CHECK((parts == one));
  }

  TEST_CASE("values of every kind are read to the bit") {
    if (!are_fetched()) return;
    const TemporaryFolder folder;
    const Type& type = type_of<tests::EveryKind>();
    for (const mcap::Compression compression :
         {mcap::Compression::none, mcap::Compression::lz4, mcap::Compression::zstd}) {
      const std::string file = folder / "every";
      const MessageSchema schema = schema_of(type);
      const mcap::Schema described{1, schema.name, "ros2msg", schema.text};
      const mcap::Channel channel{1, 1, "every", "cdr"};
      std::FILE* const out = std::fopen(file.c_str(), "wb");
      mcap::Writer writer(out, compression, "jarol");
      mcap::Chunk chunk;
      chunk.add(record_of(described));
      chunk.add(record_of(channel));
      const CdrEncoder encoder(type);
      std::string expected;
      for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const tests::EveryKind value = tests::random_every_kind(seed);
        const auto instant = static_cast<std::int64_t>(seed * seed);
        encoder.encode(&value, chunk.add_message(1, 0, Duration(instant), encoder.size(&value)));
        add_lines(type, reinterpret_cast<const std::byte*>(&value), "", "every " + std::to_string(instant) + " ",
                  expected);
      }
      writer.write(chunk);
      writer.end({described}, {channel});
      std::fclose(out);
      const std::string output = read("dump " + file);
      CHECK(output.size() == expected.size());
      CHECK((output == expected));
    }
  }
}
