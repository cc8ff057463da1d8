#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <system_error>

#include "graph/language/problems.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "runtime/files/atomic_file.h"
#include "runtime/record/instants.h"
#include "runtime/record/message_layout.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/log_commands.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

// A table of some topics: a row for each instant at which one of them has a message.
class Table {
 public:
  explicit Table(const std::vector<const ReadTopic*>& topics) {
    struct Column {
      std::string name;
      std::uint16_t channel = 0;
      std::size_t cell = 0;
    };
    std::vector<Column> columns;
    for (const ReadTopic* topic : topics) {
      const std::uint16_t id = topic->channel.id;
      const MessageLayout& layout = layouts_.emplace(id, MessageLayout(*topic)).first->second;
      for (std::size_t i = 0; i < layout.columns().size(); ++i) {
        const std::string& path = layout.columns()[i].path;
        columns.push_back({path.empty() ? topic->channel.topic : topic->channel.topic + "." + path, id, i});
      }
    }
    std::sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.name < b.name; });
    title_ = "time";
    for (std::size_t i = 0; i < columns.size(); ++i) {
      title_ += "," + csv_text(columns[i].name);
      places_[columns[i].channel].push_back({i, columns[i].cell});
    }
    cells_.resize(columns.size());
  }

  std::string title() const { return title_ + "\n"; }

  void take(const RecordedInstants::Message& message) {
    const auto layout = layouts_.find(message.topic->channel.id);
    if (layout == layouts_.end()) return;
    const std::vector<MessageCell> cells = layout->second.read(message.data);
    for (const auto& [column, cell] : places_.at(message.topic->channel.id))
      cells_[column] = csv_text(text_of(layout->second.columns()[cell], cells[cell]));
    any_ = true;
  }

  // Of what was taken since the row before; nothing if that is nothing.
  std::string row(Duration instant) {
    if (!any_) return "";
    any_ = false;
    std::string row = seconds_text(instant);
    for (std::string& cell : cells_) {
      row += "," + cell;
      cell.clear();
    }
    return row + "\n";
  }

 private:
  std::string title_;
  std::map<std::uint16_t, MessageLayout> layouts_;                                    // per channel
  std::map<std::uint16_t, std::vector<std::pair<std::size_t, std::size_t>>> places_;  // column and cell
  std::vector<std::string> cells_;
  bool any_ = false;
};

// As in "20ms", or "20ms_at_5ms" where it is published so long after each multiple of its period.
std::string rate_of(const ReadTopic& topic) {
  const auto number = [&](const char* key) {
    const auto at = topic.channel.metadata.find(key);
    return at == topic.channel.metadata.end() ? Duration{} : Duration(std::atoll(at->second.c_str()));
  };
  const Duration period = number("period_ns"), phase = number("phase_ns");
  if (period == Duration{}) return "events";
  return duration_text(period) + (phase == Duration{} ? "" : "_at_" + duration_text(phase));
}

// Who reads all tables of a folder takes them for those of one recording.
void require_no_others(const std::string& folder, const std::map<std::string, std::vector<const ReadTopic*>>& groups) {
  std::vector<std::string> others;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().extension() == ".csv" && !groups.contains(entry.path().stem().string()))
      others.push_back(entry.path().filename().string());
  std::sort(others.begin(), others.end());
  if (!others.empty())
    throw InputError("--by-rate: the folder '" + folder + "' has tables of something else: " + list_of(others) +
                     "; choose another folder, or remove them");
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw std::system_error(error, "can't make the folder '" + path + "'");
}

}  // namespace

int log_csv(const LogOptions& options) {
  const Recording recording(options.file);
  note_break(recording, options.file);
  note_rest(recording, options.file);
  note_gaps(recording, options.file);
  const std::vector<bool> wanted =
      options.topics.empty() ? published_channels(recording) : channels_named(recording, "--topic", options.topics);
  std::map<std::string, std::vector<const ReadTopic*>> groups;
  for (const auto& [id, topic] : recording.topics())
    if (wanted[id]) groups[options.by_rate.empty() ? "" : rate_of(topic)].push_back(&topic);
  if (groups.empty())
    throw InputError("'" + options.file +
                     "' has no published values; record them by --record, or name other "
                     "topics by --topic");
  struct Out {
    Table table;
    std::unique_ptr<AtomicFile> file{};
  };
  std::vector<Out> outs;
  if (!options.by_rate.empty()) {
    require_no_others(options.by_rate, groups);
    make_folder(options.by_rate);
  }
  for (const auto& [rate, topics] : groups) {
    outs.push_back({Table(topics)});
    if (!options.by_rate.empty())
      outs.back().file =
          std::make_unique<AtomicFile>((std::filesystem::path(options.by_rate) / (rate + ".csv")).string());
  }
  const auto write = [](Out& out, const std::string& text) {
    if (out.file)
      out.file->write(text);
    else
      std::cout << text;
  };
  for (Out& out : outs) write(out, out.table.title());
  RecordedInstants instants(recording, wanted, options.from);
  while (std::cout && instants.next() && instants.instant() < options.until) {
    for (const RecordedInstants::Message& message : instants.messages())
      for (Out& out : outs) out.table.take(message);
    for (Out& out : outs) write(out, out.table.row(instants.instant()));
  }
  for (Out& out : outs)
    if (out.file) out.file->commit();
  return exit_good;
}

}  // namespace jarol::tools
