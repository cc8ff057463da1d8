#include "tools/gantt.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/yaml/quantities.h"

namespace jarol::tools {

std::string gantt_text(const Graph& graph, const analysis::Result& result, std::size_t width) {
  if (!result.late || result.slices.empty()) return "";
  const analysis::Late& late = *result.late;
  // as much before the release as it takes to see what held it up
  std::int64_t begin = late.release;
  for (const analysis::Slice& s : result.slices)
    if (s.end > late.release && s.begin < late.finish) begin = std::min(begin, s.begin);
  const std::int64_t end = late.finish, span = std::max<std::int64_t>(1, end - begin);
  const auto column = [&](std::int64_t t) {
    const auto at = static_cast<double>(t - begin) / static_cast<double>(span) * static_cast<double>(width);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(width) - 1));
  };
  std::vector<std::size_t> tasks;
  for (const analysis::Slice& s : result.slices)
    if (s.end > begin && std::find(tasks.begin(), tasks.end(), s.task) == tasks.end()) tasks.push_back(s.task);
  std::sort(tasks.begin(), tasks.end());
  std::size_t name_width = 0;
  for (const std::size_t t : tasks) name_width = std::max(name_width, graph.tasks[t].name.size());
  std::string text;
  for (const std::size_t t : tasks) {
    std::string line(width, '.');
    for (const analysis::Slice& s : result.slices) {
      if (s.task != t || s.end <= begin) continue;
      for (std::size_t c = column(s.begin); c <= column(std::max(s.begin, s.end - 1)); ++c) line[c] = '#';
    }
    if (t == late.task) {
      for (std::size_t c = column(late.deadline); c < width; ++c)
        if (line[c] == '#') line[c] = '!';
      line[column(late.deadline)] = '|';
      if (line[column(late.release)] == '.') line[column(late.release)] = '^';
    }
    text += fmt::format("    {:<{}} {}\n", graph.tasks[t].name, name_width, line);
  }
  const std::string from = duration_text(Duration(begin)), to = duration_text(Duration(end));
  text += fmt::format("    {:<{}} {}{:>{}}\n", "", name_width, from, to, width > from.size() ? width - from.size() : 0);
  return text;
}

}  // namespace jarol::tools
