#include "graph/model/with_wcets.h"

#include <algorithm>

#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

// Where a line of the text begins.
std::size_t offset_of(const std::string& text, const Location& where) {
  std::size_t at = 0;
  for (int line = 1; line < where.line; ++line) at = text.find('\n', at) + 1;
  return at + static_cast<std::size_t>(where.column - 1);
}

struct Edit {
  std::size_t at;
  std::size_t length;  // of what is replaced
  std::string text;
};

// A scalar of a YAML file without quotes.
std::size_t scalar_length(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text.find_first_of(",}]\n#", end) != end) ++end;
  while (end > at && (text[end - 1] == ' ' || text[end - 1] == '\r')) --end;
  return end - at;
}

bool is_quote(char c) { return c == '"' || c == '\''; }

Edit edit_of(const std::string& text, const TaskSpec& task, Duration wcet) {
  if (task.wcet) {
    const std::size_t at = offset_of(text, task.wcet->where);
    if (text[at] == '>' || text[at] == '|')
      throw InputError("the 'wcet' of task '" + task.name + "' is a block of lines; write it on the line of its key");
    const std::string quote = is_quote(text[at]) ? text.substr(at, 1) : "";
    return {at, scalar_length(text, at), quote + duration_text(wcet) + quote};
  }
  const std::size_t type = offset_of(text, task.type->where);
  const std::size_t end = type + scalar_length(text, type);
  const std::size_t line = text.rfind('\n', type) + 1;
  const std::size_t key = text.rfind("type", type);
  const std::string quote = key > 0 && is_quote(text[key - 1]) ? text.substr(key - 1, 1) : "";
  const std::string entry = quote + "wcet" + quote + ": " + quote + duration_text(wcet) + quote;
  // in braces, which may go over several lines, or a line of its own
  const std::string before = text.substr(line, key - line - quote.size());
  const std::size_t next = text.find_first_not_of(" \t\r\n", end);
  const bool goes_on = next != std::string::npos && (text[next] == ',' || text[next] == '}');
  if (goes_on || before.find('{') != std::string::npos) return {end, 0, ", " + entry};
  const std::string new_line = text[end] == '\r' ? "\r\n" : "\n";
  return {end, 0, new_line + std::string(before.size(), ' ') + entry};
}

}  // namespace

std::string with_wcets(const std::string& text, const GraphSpec& spec, const Graph& graph,
                       const std::vector<std::optional<Duration>>& wcets) {
  std::vector<Edit> edits;
  for (const TaskSpec& task : spec.tasks) {
    const auto found =
        std::find_if(graph.tasks.begin(), graph.tasks.end(), [&](const Task& t) { return t.name == task.name; });
    const std::optional<Duration> wcet = wcets[static_cast<std::size_t>(found - graph.tasks.begin())];
    if (!wcet) continue;
    const Edit edit = edit_of(text, task, *wcet);
    const Location& where = task.wcet ? task.wcet->where : task.type->where;
    if (where.source == nullptr || where.source->text != text)
      throw InputError("the 'wcet' of task '" + task.name + "' does not come from the file itself");
    edits.push_back(edit);
  }
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.at > b.at; });
  for (std::size_t i = 1; i < edits.size(); ++i)
    if (edits[i].at == edits[i - 1].at)
      throw InputError("two tasks share one place of the file through an alias; write their 'wcet' yourself");
  std::string edited = text;
  for (const Edit& edit : edits) edited.replace(edit.at, edit.length, edit.text);
  return edited;
}

}  // namespace jarol
