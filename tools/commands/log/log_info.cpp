#include <fmt/format.h>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "runtime/mcap/verify.h"
#include "runtime/record/recorded_run.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/log_commands.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/report/exit_code.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

// By its index, or where it has none gone through as a whole.
struct Looked {
  std::unique_ptr<Recording> by_index;
  std::unique_ptr<RecordedRun> gone_through;  // or null
  std::optional<LogEnd> end;                  // none: it breaks off
  Duration covered{};

  const Recording& recording() const { return gone_through ? gone_through->recording() : *by_index; }
};

Looked look_into(const std::string& path) {
  Looked looked;
  looked.by_index = std::make_unique<Recording>(path);
  looked.end = find_end(*looked.by_index);
  if (looked.end) {
    looked.covered = Duration(looked.end->covered);
    return looked;
  }
  looked.gone_through = std::make_unique<RecordedRun>(path);
  looked.end = looked.gone_through->end();
  looked.covered = looked.gone_through->covered();
  return looked;
}

nlohmann::ordered_json json_of(const Looked& run) {
  const Recording& recording = run.recording();
  auto json = nlohmann::ordered_json::parse(to_json(recording.header()));
  json["schema"] = "jarol.log_info/1";
  json["whole"] = recording.is_whole();
  if (recording.parts().size() > 1) json["parts"] = recording.parts();
  json["bytes"] = recording.size();
  json["chunks"] = recording.chunks().size();
  json["covered_ns"] = run.covered.count();
  json["digest"] =
      run.end ? nlohmann::ordered_json(fmt::format("0x{:016x}", run.end->digest)) : nlohmann::ordered_json();
  const std::string ended_by = read_ended_by(recording);
  json["ended_by"] = ended_by.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(ended_by);
  if (const auto rest = read_rest(recording))
    json["rest"] = {{"begun_ns", rest->begun.count()}, {"reached", rest->reached}};
  json["mishaps"] = nlohmann::ordered_json::array();
  for (const auto& mishap : read_mishaps(recording))
    json["mishaps"].push_back({{"distributer", mishap.distributer}, {"text", mishap.text}});
  json["gaps"] = nlohmann::ordered_json::array();
  for (const Gap& gap : read_gaps(recording))
    json["gaps"].push_back({{"from_ns", gap.from}, {"to_ns", gap.to}, {"values", gap.values}});
  json["files"] = nlohmann::ordered_json::array();
  for (const RecordedFile& file : recording.files()) json["files"].push_back(file.path);
  json["topics"] = nlohmann::ordered_json::array();
  for (const auto& [id, topic] : recording.topics())
    json["topics"].push_back(
        {{"name", topic.channel.topic}, {"schema", topic.schema_name}, {"messages", topic.messages}});
  return json;
}

}  // namespace

int log_info(const LogOptions& options) {
  const Looked run = look_into(options.file);
  const Recording& recording = run.recording();
  note_rest(recording, options.file);
  note_gaps(recording, options.file);
  if (options.json) {
    std::cout << json_line(json_of(run));
    return exit_good;
  }
  const RecordingHeader& header = recording.header();
  const std::size_t parts = recording.parts().size();
  std::cout << fmt::format("{}: {} s on the {} clock, {} bytes in {} chunks{}\n", printable(header.graph),
                           seconds_text(run.covered), printable(header.clock), recording.size(),
                           recording.chunks().size(), parts > 1 ? fmt::format(" of {} files", parts) : "");
  std::cout << "  graph       " << printable(header.file) << "\n";
  if (header.begin > Duration{})
    std::cout << "  from        " << seconds_text(header.begin)
              << " s on: the run went on there from what was saved, maybe with other parameters\n";
  if (!header.overrides.profile.empty()) std::cout << "  profile     " << printable(header.overrides.profile) << "\n";
  for (const std::string& set : header.overrides.set) std::cout << "  set         " << printable(set) << "\n";
  if (!header.execution.empty()) std::cout << "  execution   " << printable(header.execution) << "\n";
  std::cout << "  seed        " << header.seed << "\n";
  for (const RecordedFile& file : recording.files())
    if (file.path != header.file) std::cout << "  file        " << printable(file.path) << "\n";
  std::cout << "  made by     " << printable(header.version.substr(0, header.version.find('\n'))) << "\n  on          "
            << printable(header.platform) << "\n";
  if (run.end) std::cout << fmt::format("  digest      0x{:016x}\n", run.end->digest);
  if (const std::string by = read_ended_by(recording); !by.empty())
    std::cout << "  ended       as " << printable(by) << "\n";
  if (const auto rest = read_rest(recording))
    std::cout << "  at end      from " << seconds_text(rest->begun)
              << " s on the vehicle was to come to rest: " << words_of(rest, run.end.has_value()) << "\n";
  if (!run.end)
    std::cout << "  breaks off " << printable(recording.text_of_break()) << "; how the run ended is not known\n";
  for (const auto& mishap : read_mishaps(recording))
    std::cout << "  mishap      " << printable(to_text(mishap)) << "\n";
  std::size_t width = 0;
  for (const auto& [id, topic] : recording.topics()) width = std::max(width, topic.channel.topic.size());
  for (const auto& [id, topic] : recording.topics())
    std::cout << fmt::format("  {:<{}}  {:>10}  {}\n", printable(topic.channel.topic), width, topic.messages,
                             topic.schema_name);
  return exit_good;
}

int log_verify(const LogOptions& options) {
  std::vector<std::string> problems;
  try {
    const Recording recording(options.file);
    for (const std::string& part : recording.parts())
      for (const std::string& problem : mcap::verify(part)) problems.push_back("'" + part + "' " + problem);
    if (problems.empty() && !recording.is_whole())
      problems.push_back("'" + options.file + "' breaks off " + recording.text_of_break());
  } catch (const DamagedLog& damaged) { problems.emplace_back(damaged.what()); }
  if (options.json)
    std::cout << json_line(
        {{"schema", "jarol.log_verify/1"}, {"verdict", problems.empty() ? "good" : "damaged"}, {"problems", problems}});
  for (const std::string& problem : problems) std::cerr << "error: " << printable(problem) << "\n";
  if (problems.empty() && !options.json) std::cout << printable(options.file) << ": every byte is as it was written\n";
  return problems.empty() ? exit_good : exit_negative;
}

}  // namespace jarol::tools
