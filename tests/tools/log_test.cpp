// Recordings as the command makes them, compares them and looks into them.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::has;
using command::TemporaryFolder;

const std::string counting = "run specs/counting.yaml --for 2s --record ";
}  // namespace

TEST_SUITE("tools/log") {
  TEST_CASE("a recorded run is the same again in every value, by any workers, and on the real clock") {
    const TemporaryFolder folder;
    for (const std::string how : {"--for 2s", "--for 2s --workers 2", "--for 2s --record-compression none",
                                  "--for 300ms --clock real --force --record-compression zstd"}) {
      CAPTURE(how);
      const std::string file = folder / "r.mcap";
      const auto run = command::run_jarol("run specs/counting.yaml --record " + file + " " + how);
      REQUIRE((run.exit_code == 0 || run.exit_code == 3));  // 3: the machine was late
      CHECK(has(run.output, "  recording   " + file + "\n"));
      const auto replay = command::run_jarol("replay " + file);
      CHECK(replay.exit_code == 0);
      CHECK(has(replay.output, "  same        as the run on the "));
      CHECK(has(replay.output, " values compared\n"));
      CHECK(command::run_jarol("log verify " + file).output == file + ": every byte is as it was written\n");
    }
  }

  TEST_CASE("the first difference is named with output, field, both values and their bits, and each signal's largest") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 100ms}
  sum: {type: Accumulate, period: 100ms}
connections: [count.out -> sum.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 5s --record " + file).exit_code == 0);
    CHECK(has(command::run_jarol("replay " + file).output,
              "  same        as the run on the virtual clock, 100 values compared\n"));
    const auto other =
        command::run_jarol("replay " + file + " --set tasks.sum.init.out=0 --set tasks.sum.period=200ms");
    CAPTURE(other.output);
    CHECK(other.exit_code == 1);
    CHECK(has(other.output, "  first       sum.out at 0.1 s: was published, is nothing\n"));
    const auto json = nlohmann::json::parse(
        command::run_jarol("replay " + file + " --json --set tasks.sum.period=200ms", "2>/dev/null").output);
    CHECK(json["first_difference"]["instant_ns"] == 100'000'000);
    CHECK(json["first_difference"]["output"] == "sum.out");
    CHECK(json["compared_values"] == 75);  // that both have
    CHECK(json["signals"][0]["name"] == "sum.out");
  }

  TEST_CASE(
      "some tasks by themselves are the same on what they read then, and show what they alone would do otherwise") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 100ms, let: 100ms}
  sum: {type: Accumulate, period: 50ms, let: 20ms}
  flow: {type: Accumulate, period: 100ms, offset: 10ms}
connections: [count.out -> sum.in, sum.out -> flow.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 5s --record " + file).exit_code == 0);
    for (const auto& [names, values] :
         {std::pair<std::string, std::string>("sum", "100"), {"flow", "50"}, {"sum flow", "150"}, {"count", "49"}}) {
      const std::string tasks = names;
      CAPTURE(tasks);
      const auto replay = command::run_jarol("replay " + file + " --only " + tasks);
      CAPTURE(replay.output);
      CHECK(replay.exit_code == 0);
      CHECK(has(replay.output, "  same        as the run on the virtual clock, " + values + " values compared\n"));
    }
    // what feeds it is as it was, whatever is changed there
    CHECK(command::run_jarol("replay " + file + " --only flow --set tasks.count.init.out=5").exit_code == 0);
    CHECK(command::run_jarol("replay " + file + " --set tasks.count.init.out=5").exit_code == 1);
    const auto changed = command::run_jarol("replay " + file + " --only sum --set tasks.count.init.out=5");
    CAPTURE(changed.output);
    CHECK(changed.exit_code == 1);
    CHECK(has(changed.output,
              "  first       sum.out at 0.02 s: was 0 (0x0000000000000000), is 5 (0x4014000000000000)\n"));
    CHECK(!has(changed.output, "  signal      flow.out"));
    CHECK(has(command::run_jarol("replay " + file + " --only smu").output,
              "error: --only: the graph has no task 'smu'; did you mean 'sum'?; it has: count, flow, sum\n"));
    const std::string part = folder / "part.mcap";
    REQUIRE(command::run_jarol("run " + graph + " --for 1s --record-what sum.out --record " + part).exit_code == 0);
    CHECK(command::run_jarol("replay " + part + " --only sum").output ==
          "error: --only: the recording has no values of 'count.out', which they read; record all that is published: "
          "jarol run --record\n");
  }

  TEST_CASE("two recordings with the same values differ where a fault stands in one alone") {
    const TemporaryFolder folder;
    const std::string graph = folder.write("g.yaml", R"(graph: g
timing: {period: 12ms}
tasks:
  c: {type: Counter, period: 2ms, wcet: 10us, on_fault: hold}
  w: {type: Work, period: 4ms, wcet: 4ms, on_fault: hold}
platform: {cores: 1, policy: fixed_priority}
fault_limit: 100%
)");
    const std::string times = folder.write("times.yaml", "c: 10us\nw: 6ms\n"), a = folder / "a", b = folder / "b";
    const std::string run = "run " + graph + " --for 60ms --record ";
    REQUIRE(command::run_jarol(run + a).exit_code == 0);
    REQUIRE(command::run_jarol(run + b + " --execution " + times).exit_code == 0);
    const auto diff = command::run_jarol("log diff " + a + " " + b);
    CHECK(diff.exit_code == 1);
    CHECK(has(diff.output, "DIFFERENT, 30 values compared\n  apart       at "));
    CHECK(has(diff.output, ": a fault of '"));
    CHECK(has(diff.output, " only in B\n"));
    CHECK(command::run_jarol("log diff " + b + " " + b).exit_code == 0);
  }

  TEST_CASE("two recordings of runs that came to other ends differ, whatever values they have") {
    const TemporaryFolder folder;
    const auto record = [&](const std::string& name, const std::string& more) {
      REQUIRE(command::run_jarol("run specs/counting.yaml --for 1s " + more + " " + (folder / name)).exit_code == 0);
      return folder / name;
    };
    const std::string a = record("a", "--log"), b = record("b", "--set tasks.loop.init.out=5 --log");
    const auto inputs = command::run_jarol("log diff " + a + " " + b);
    CHECK(inputs.exit_code == 1);
    CHECK(inputs.output.starts_with("DIFFERENT, 0 values compared\n  apart       at the end: digest 0x"));
    CHECK(has(command::run_jarol("log diff --json " + a + " " + b).output, R"("verdict":"different")"));
    CHECK(command::run_jarol("log diff " + a + " " + a).output == "the same, 0 values\n");
    const std::string c = record("c", "--record-what 'count.*' --record"),
                      d = record("d", "--set tasks.loop.init.out=5 --record-what 'count.*' --record");
    const auto part = command::run_jarol("log diff " + c + " " + d);
    CHECK(part.exit_code == 1);
    CHECK(has(part.output, "  apart       at the end: digest 0x"));
    const auto late = command::run_jarol("log diff " + c + " " + d + " --from 5s");
    CHECK(late.exit_code == 2);
    CHECK(late.output == "NOTHING TO COMPARE: both have no values in that time\n");
    CHECK(
        has(command::run_jarol("log diff --json --from 5s " + a + " " + b).output, R"("verdict":"nothing_compared")"));
  }

  TEST_CASE("one bit of one input is found by instant and field") {
    const TemporaryFolder folder;
    const std::string a = folder / "a.mcap", b = folder / "b.mcap";
    const std::string run = "run specs/counting.yaml --for 1s --record-compression none --record ";
    REQUIRE(command::run_jarol(run + a).exit_code == 0);
    REQUIRE(command::run_jarol(run + b + " --set tasks.loop.init.out=1").exit_code == 0);
    CHECK(command::run_jarol("log diff " + a + " " + a).exit_code == 0);
    const auto diff = command::run_jarol("log diff " + a + " " + b);
    CAPTURE(diff.output);
    CHECK(diff.exit_code == 1);
    CHECK(diff.output.starts_with("DIFFERENT, "));
    CHECK(has(diff.output, "  first       add.out at 0.01 s: was 0 (0x0000000000000000), is 1 (0x3ff0000000000000)\n"));
    CHECK(has(diff.output, "  signal      sum.out from 0.01 s on, by at most 2 at 0.03 s\n"));
    const auto json = nlohmann::json::parse(command::run_jarol("log diff --json " + a + " " + b, "2>/dev/null").output);
    CHECK(json["verdict"] == "different");
    // of one that breaks off it is said where
    const std::string broken = folder / "broken.mcap";
    std::filesystem::copy_file(a, broken);
    std::filesystem::resize_file(broken, std::filesystem::file_size(broken) / 2);
    const auto cut = command::run_jarol("log diff " + a + " " + broken);
    CHECK(has(cut.output, "  breaks off  B at byte "));
    CHECK(cut.output.ends_with("; what it lacks after that counts as different\n"));
    // and what else of it is the same is no more than that
    const std::string shorter = folder / "shorter.mcap";
    std::filesystem::copy_file(a, shorter);
    std::filesystem::resize_file(shorter, std::filesystem::file_size(shorter) - 1);
    const auto so_far = command::run_jarol("log diff " + a + " " + shorter);
    CHECK(so_far.exit_code == 1);
    CHECK(so_far.output.starts_with("the same, "));
    CHECK(has(so_far.output, " values, as far as both go\n  breaks off  B at byte "));
    CHECK(nlohmann::json::parse(command::run_jarol("log diff --json " + a + " " + shorter).output)["verdict"] ==
          "same_so_far");
    // what else was published shows in the digests
    const std::string few = folder / "few.mcap", others = folder / "others.mcap";
    const std::string counted = "run specs/counting.yaml --for 3s --record-what 'count.*' --record ";
    REQUIRE(command::run_jarol(counted + few).exit_code == 0);
    REQUIRE(command::run_jarol(counted + others + " --set tasks.loop.init.out=1").exit_code == 0);
    const auto early = command::run_jarol("log diff --until 2s " + few + " " + others);
    CHECK(early.exit_code == 1);
    CHECK(has(early.output, "  apart       at 1 s: digest 0x"));
    CHECK(command::run_jarol("log diff --until 2s " + few + " " + few).exit_code == 0);
    // with --record-what only what is chosen
    const std::string part = folder / "part.mcap";
    REQUIRE(command::run_jarol(run + part + " --record-what 'count.*'").exit_code == 0);
    CHECK(has(command::run_jarol("log diff " + a + " " + part).output, "  apart       'add.out' is only in A\n"));
    const auto nothing = command::run_jarol(run + part + " --record-what cuont.out");
    CHECK(nothing.exit_code == 2);
    CHECK(has(nothing.output,
              "error: --record-what: nothing that is published has the name 'cuont.out'; did you mean 'count.out'?"));
  }

  TEST_CASE("the table of a recording is the trace of the run") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", trace = folder / "r.csv", rates = folder / "rates";
    REQUIRE(command::run_jarol(counting + file + " --trace " + trace).exit_code == 0);
    CHECK(command::run_jarol("log csv " + file).output == content(trace));
    CHECK(command::run_jarol("log csv " + file + " --by-rate " + rates).exit_code == 0);
    std::size_t files = 0, rows = 0;
    for (const auto& entry : std::filesystem::directory_iterator(rates)) {
      const std::string text = content(entry.path());
      CAPTURE(text);
      ++files;
      rows += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;
      CHECK(!has(text, ",,"));
      CHECK(!has(text, ",\n"));
    }
    CHECK(files > 1);
    CHECK(rows > 0);
    // whoever reads all of them is not to get those of another recording
    const std::string other = rates + "/3h.csv";
    std::ofstream(other) << "time\n";
    const auto mixed = command::run_jarol("log csv " + file + " --by-rate " + rates);
    CHECK(mixed.exit_code == 2);
    CHECK(mixed.output == "error: --by-rate: the folder '" + rates +
                              "' has tables of something else: 3h.csv; choose another folder, or remove them\n");
    std::filesystem::remove(other);
    CHECK(command::run_jarol("log csv " + file + " --by-rate " + rates).exit_code == 0);
    const auto cat = command::run_jarol("log cat " + file + " --topic count.out --from 500ms --until 520ms");
    CHECK(has(cat.output, "0.5 count.out="));
    CHECK(!has(cat.output, "0.52 "));
    CHECK(!has(cat.output, "loop"));
    const auto info = command::run_jarol("log info " + file);
    CHECK(info.exit_code == 0);
    CHECK(info.output.starts_with("counting: 2 s on the virtual clock, "));
    CHECK(has(info.output, "  count.out "));
  }

  TEST_CASE("log info looks at the index alone; of a recording that breaks off it goes through what there is") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: g
tasks: {count: {type: Counter, period: 1ms}}
)");
    REQUIRE(
        command::run_jarol("run " + graph + " --for 20s --record " + file + " --record-compression none").exit_code ==
        0);
    const std::string bytes = content(file), reported = command::run_jarol("log info --json " + file).output;
    CHECK(has(reported, R"("messages":20000)"));
    // published values in the middle of the file are not read for it
    std::string damaged = bytes;
    damaged[bytes.size() / 2] = static_cast<char>(damaged[bytes.size() / 2] ^ 1);
    CHECK(command::run_jarol("log info --json " + folder.write("damaged", damaged)).output == reported);
    CHECK(command::run_jarol("log verify " + (folder / "damaged")).exit_code == 1);
    const auto part = command::run_jarol("log info " + folder.write("part", bytes.substr(0, bytes.size() - 1)));
    CHECK(part.exit_code == 0);
    CHECK(has(part.output, "  breaks off at byte "));
    for (const std::string command : {"cat", "csv", "trace", "report"}) {
      CAPTURE(command);
      const std::string shown = " --out " + (folder / "shown");
      const auto note = [&](const std::string& of) {
        const bool prints = command == "cat" || command == "csv";
        return command::run_jarol("log " + command + " " + of + (prints ? "" : shown), "2>&1 >/dev/null");
      };
      const auto cut = note(folder / "part");
      CHECK(cut.exit_code == 0);
      CHECK(cut.output.starts_with("note: '" + (folder / "part") + "' breaks off at byte "));
      CHECK(cut.output.ends_with(": this is what there is before\n"));
      CHECK(note(file).output == "");
    }
  }

  TEST_CASE("log verify finds each changed byte of a small recording") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: g
tasks: {count: {type: Counter, period: 100ms}}
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 1s --record " + file).exit_code == 0);
    std::string bytes = content(file);
    // by the command here and there; byte by byte in tests/runtime/record/mcap_test.cpp
    for (std::size_t i = 0; i < bytes.size(); i += 211) {
      CAPTURE(i);
      bytes[i] = static_cast<char>(bytes[i] ^ 4);
      folder.write("damaged", bytes);
      bytes[i] = static_cast<char>(bytes[i] ^ 4);
      const int code = command::run_jarol("log verify " + (folder / "damaged")).exit_code;
      CHECK(code == (i < 8 ? 2 : 1));  // with another beginning it is no recording
    }
  }

  TEST_CASE("options that would have no effect are refused") {
    const auto error = [](const std::string& words) { return command::run_jarol(words).output; };
    const std::string run = "run specs/counting.yaml --for 1s ";
    CHECK(error(run + "--record x --log y") ==
          "error: --log writes what --record with --record-what inputs does; leave one of both out\n");
    CHECK(error(run + "--record-what inputs") ==
          "error: --record-what is about --record; add --record FILE, or leave it out\n");
    CHECK(error(run + "--record-compression zstd") ==
          "error: --record-compression is about --record and --log; add one of them, or leave it out\n");
    CHECK(error(run + "--record -") == "error: --record: '-' is no file; a recording is read by its name\n");
    CHECK(error("log diff a") == "error: jarol log diff compares two recordings; name both\n");
    CHECK(error("log cat a b") == "error: jarol log cat looks at one recording; leave 'b' out\n");
    CHECK(error("log info a --topic x") == "error: --topic belongs to cat, csv and diff\n");
    CHECK(error("log cat a --from 5s --until 3s") == "error: --until: '3s' is not after --from, '5s'\n");
    CHECK(error("log diff a b --until 0s") == "error: --until: '0s' is not after the begin\n");
    CHECK(error("log cat specs/counting.yaml") ==
          "error: 'specs/counting.yaml' is no recording; one comes from jarol run --record or --log\n");
  }
}
