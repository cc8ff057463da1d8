#include "tools/commands/run/record_options.h"

#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"
#include "tools/report/version.h"

namespace jarol::tools {
namespace {

mcap::Compression compression_of(const std::string& name) {
  if (name == "none") return mcap::Compression::none;
  return name == "zstd" ? mcap::Compression::zstd : mcap::Compression::lz4;
}

std::uint64_t split_of(const std::string& text) {
  constexpr std::int64_t min = std::int64_t{1} << 20;
  if (text.empty()) return 0;
  std::int64_t bytes = 0;
  if (const std::string wrong = parse_bytes(text, bytes); !wrong.empty())
    throw InputError("--record-split: '" + text + "' " + wrong);
  if (bytes < min) throw InputError("--record-split: '" + text + "' is below 1MiB");
  return static_cast<std::uint64_t>(bytes);
}

Duration checkpoint_period(const RecordArguments& arguments) {
  if (arguments.checkpoints.empty()) return {};
  const Duration period = length_of("--record-checkpoints", arguments.checkpoints);
  if (period < std::chrono::milliseconds(1))
    throw InputError("--record-checkpoints: '" + arguments.checkpoints + "' is below 1ms");
  return period;
}

}  // namespace

void add_record_options(Command& command, RecordArguments& arguments) {
  command
      .add_option("--record", arguments.record,
                  "Record the run in this MCAP file: every published value, what came from outside and what was late. "
                  "jarol replay\n"
                  "repeats it, jarol log looks into it; tools that read MCAP with ROS 2 messages can, too")
      ->file({"mcap"});
  command.add_option(
      "--record-what", arguments.what,
      "Which values --record takes: all (default), names with * for any part, as in depth.*,from_dune, or "
      "inputs: none\n"
      "but what came from outside, all that jarol replay needs");
  command
      .add_option("--record-compression", arguments.compression, "Of --record and --log: lz4 (default), zstd or none")
      ->one_of({"lz4", "zstd", "none"});
  command.add_option("--record-split", arguments.split,
                     "Begin a new file at so many bytes, as in 1GiB: FILE.2.mcap after FILE.mcap, and so on; whoever "
                     "reads the first\n"
                     "finds the others beside it");
  command.add_option("--record-checkpoints", arguments.checkpoints,
                     "Save the run in its recording this often in logical time, as in 10s, so that jarol replay --from "
                     "need not begin at the start");
  command.add_option("--log", arguments.log, "The same as --record with --record-what inputs")->file({"mcap"});
}

void require_effect(const Command& command, const RecordArguments& arguments) {
  for (const auto& [option, file] : {std::pair("--log", arguments.log), {"--record", arguments.record}})
    if (file == "-") throw InputError(std::string(option) + ": '-' is no file; a recording is read by its name");
  if (!arguments.log.empty() && !arguments.record.empty())
    throw InputError("--log writes what --record with --record-what inputs does; leave one of both out");
  if (arguments.record.empty())
    command.refuse({"--record-what"}, "is about --record; add --record FILE, or leave it out");
  if (arguments.file().empty())
    command.refuse({"--record-compression", "--record-split", "--record-checkpoints"},
                   "is about --record and --log; add one of them, or leave it out");
}

RecordingOptions options_of(const RecordArguments& arguments) {
  if (arguments.file().empty()) return {};
  return {.file = arguments.file(),
          .what = arguments.record.empty() ? "inputs" : arguments.what,
          .split = split_of(arguments.split),
          .checkpoints = checkpoint_period(arguments),
          .version = version_text(),
          .compression = compression_of(arguments.compression)};
}

std::string to_text(const RecordArguments& arguments) {
  if (arguments.file().empty()) return "";
  return (arguments.record.empty() ? "  log         " : "  recording   ") + printable(arguments.file()) + "\n";
}

std::string notes_of(const RecordArguments& arguments, const RecordingWriter& writer) {
  std::string notes;
  if (writer.dropped() > 0)
    notes += "note: " + std::to_string(writer.dropped()) +
             " published values came faster than the disk took them and are not in '" + printable(arguments.file()) +
             "'; a replay computes them again\n";
  if (!writer.stayed().empty()) notes += "note: " + printable(writer.stayed()) + "\n";
  return notes;
}

}  // namespace jarol::tools
