#include "tools/check/gantt.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"

namespace jarol::tools {

namespace {

// The window that explains the late activation: from what held it up to its end.
struct Window {
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::vector<std::size_t> tasks;  // that ran in it
};

Window window_of(const analysis::Result& result) {
  const analysis::Late& late = *result.late;
  Window window{late.release, late.finish, {}};
  for (const analysis::Slice& s : result.slices)
    if (s.end > late.release && s.begin < late.finish) window.begin = std::min(window.begin, s.begin);
  for (const analysis::Slice& s : result.slices)
    if (s.end > window.begin && std::find(window.tasks.begin(), window.tasks.end(), s.task) == window.tasks.end())
      window.tasks.push_back(s.task);
  std::sort(window.tasks.begin(), window.tasks.end());
  return window;
}

}  // namespace

std::string gantt_text(const Graph& graph, const analysis::Result& result, std::size_t width) {
  if (!result.late || result.slices.empty()) return "";
  const analysis::Late& late = *result.late;
  const auto [begin, end, tasks] = window_of(result);
  const std::int64_t first = begin, span = std::max<std::int64_t>(1, end - begin);
  const auto column = [&](std::int64_t t) {
    const auto at = static_cast<double>(t - first) / static_cast<double>(span) * static_cast<double>(width);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(width) - 1));
  };
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

std::string gantt_svg(const Graph& graph, const analysis::Result& result) {
  if (!result.late) return "";
  const analysis::Late& late = *result.late;
  const Window window = window_of(result);
  constexpr double left = 120, width = 760, row = 28, top = 50;
  const double span = static_cast<double>(std::max<std::int64_t>(1, window.end - window.begin));
  const auto x = [&](std::int64_t t) { return left + width * static_cast<double>(t - window.begin) / span; };
  const double height = top + row * static_cast<double>(window.tasks.size()) + 40;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n"
      "<text x=\"{2:.0f}\" y=\"24\">{3}: activation {4} of {5} is {6} late</text>\n",
      left + width + 20, height, left, xml_text(graph.name), late.activation, xml_text(graph.tasks[late.task].name),
      duration_text(Duration(late.finish - late.deadline)));
  for (std::size_t i = 0; i < window.tasks.size(); ++i) {
    const double y = top + row * static_cast<double>(i);
    const std::size_t task = window.tasks[i];
    text += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", left - 8, y + 18,
                        xml_text(graph.tasks[task].name));
    for (const analysis::Slice& s : result.slices) {
      if (s.task != task || s.end <= window.begin) continue;
      const auto box = [&](std::int64_t begin, std::int64_t end, const char* colour) {
        if (end > begin)
          text += fmt::format("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"20\" fill=\"{}\"/>\n",
                              x(begin), y + 4, std::max(0.5, x(end) - x(begin)), colour);
      };
      const std::int64_t cut = task == late.task ? std::clamp(late.deadline, s.begin, s.end) : s.end;
      box(std::max(s.begin, window.begin), cut, "#4477aa");
      box(cut, s.end, "#cc3311");
    }
  }
  const double bottom = height - 40;
  const auto mark = [&](std::int64_t at, const std::string& what, const char* colour) {
    text += fmt::format(
        "<line x1=\"{0:.2f}\" y1=\"{1:.0f}\" x2=\"{0:.2f}\" y2=\"{2:.0f}\" stroke=\"{3}\"/>\n"
        "<text x=\"{0:.2f}\" y=\"{4:.0f}\" text-anchor=\"middle\">{5} {6}</text>\n",
        x(at), top, bottom, colour, bottom + 16, what, duration_text(Duration(at)));
  };
  mark(late.release, "released", "#228833");
  mark(late.deadline, "deadline", "#cc3311");
  return text + "</svg>\n";
}

}  // namespace jarol::tools
