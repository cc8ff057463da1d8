#include <iostream>
#include <map>
#include <optional>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "runtime/record/instants.h"
#include "runtime/record/message_layout.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/log_commands.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

// A miss has its task's index.
std::string cell_text(const Recording& recording, const RecordedInstants::Message& message, const MessageColumn& column,
                      const MessageCell& cell) {
  const std::vector<std::string>& tasks = recording.header().tasks;
  const bool names_task = message.topic->channel.topic == topics::misses && column.path == "task";
  return names_task && cell.bits < tasks.size() ? tasks[cell.bits] : text_of(column, cell);
}

}  // namespace

int log_cat(const LogOptions& options) {
  const Recording recording(options.file);
  note_break(recording, options.file);
  note_rest(recording, options.file);
  std::vector<bool> wanted = channels_named(recording, "--topic", options.topics.empty() ? "*" : options.topics);
  // whole runs, which are not for people
  if (const ReadTopic* saved = recording.find(topics::checkpoints); saved != nullptr && options.topics.empty())
    wanted[saved->channel.id] = false;
  RecordedInstants instants(recording, wanted, options.from);
  std::map<std::uint16_t, MessageLayout> layouts;
  for (const auto& [id, topic] : recording.topics()) layouts.emplace(id, MessageLayout(topic));
  while (std::cout && instants.next() && instants.instant() < options.until) {
    for (const RecordedInstants::Message& message : instants.messages()) {
      const MessageLayout& layout = layouts.at(message.topic->channel.id);
      std::cout << seconds_text(instants.instant()) << " " << printable(message.topic->channel.topic);
      const std::vector<MessageCell> cells = layout.read(message.data);
      for (std::size_t i = 0; i < cells.size(); ++i)
        std::cout << (layout.columns()[i].path.empty() ? "" : " ") << layout.columns()[i].path << "="
                  << printable(cell_text(recording, message, layout.columns()[i], cells[i]));
      std::cout << "\n";
    }
  }
  return exit_good;
}

}  // namespace jarol::tools
