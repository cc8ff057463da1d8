#include "tools/commands/check/gantt.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/analysis/time_line.h"
#include "graph/language/quantities.h"
#include "tools/drawing/svg.h"

namespace jarol::tools {

Duration known_from(const analysis::Result& result) { return std::max(result.late->release, result.slices_from); }

namespace {

// The window that explains the late activation: from what held it up to its end.
struct Window {
  Duration begin{};
  Duration end{};
  std::vector<std::size_t> tasks;  // that ran in it
};

Window window_of(const analysis::Result& result) {
  const analysis::DeadlineMiss& late = *result.late;
  Window window{known_from(result), late.finish, {}};
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
  const analysis::DeadlineMiss& late = *result.late;
  const auto [begin, end, tasks] = window_of(result);
  const Duration first = begin, span = std::max(Duration(1), end - begin);
  const auto column = [&](Duration t) {
    const auto at =
        static_cast<double>((t - first).count()) / static_cast<double>(span.count()) * static_cast<double>(width);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(width) - 1));
  };
  std::size_t name_width = 0;
  for (const std::size_t t : tasks) name_width = std::max(name_width, graph.tasks[t].name.size());
  std::string text;
  for (const std::size_t t : tasks) {
    std::string line(width, '.');
    for (const analysis::Slice& s : result.slices) {
      if (s.task != t || s.end <= begin) continue;
      for (std::size_t c = column(s.begin); c <= column(std::max(s.begin, s.end - Duration(1))); ++c) line[c] = '#';
    }
    if (t == late.task) {
      for (std::size_t c = column(late.deadline); c < width; ++c)
        if (line[c] == '#') line[c] = '!';
      if (late.deadline >= begin) line[column(late.deadline)] = '|';
      if (late.release >= begin && line[column(late.release)] == '.') line[column(late.release)] = '^';
    }
    text += fmt::format("    {:<{}} {}\n", graph.tasks[t].name, name_width, line);
  }
  const std::string from = duration_text(begin), to = duration_text(end);
  text += fmt::format("    {:<{}} {}{:>{}}\n", "", name_width, from, to, width > from.size() ? width - from.size() : 0);
  return text;
}

namespace {

// A picture with a row for each task, over the time of a window.
class Chart {
 public:
  Chart(const Graph& graph, const Window& window, const std::string& title)
      : graph_(graph), window_(window), height_(top + row * static_cast<double>(window.tasks.size()) + below) {
    const std::string across = fixed(left + width + 20, 0), down = fixed(height_, 0);
    svg_.begin("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                       {"viewBox", "0 0 " + across + " " + down},
                       {"font-family", "sans-serif"},
                       {"font-size", "13"}});
    svg_.line_end().element("rect", {{"width", across}, {"height", down}, {"fill", "white"}}).line_end();
    svg_.element("text", {{"x", fixed(left, 0)}, {"y", "24"}}, title).line_end();
    for (std::size_t i = 0; i < window.tasks.size(); ++i) {
      svg_.element("text", {{"x", fixed(left - 8, 0)}, {"y", fixed(y(i) + 18, 1)}, {"text-anchor", "end"}},
                   graph_.tasks[window.tasks[i]].name);
      svg_.line_end();
    }
  }

  double bottom() const { return height_ - below; }

  void box(std::size_t at, Duration begin, Duration end, const char* colour) {
    if (end <= begin) return;
    svg_.element("rect", {{"x", fixed(x(begin), 2)},
                          {"y", fixed(y(at) + 4, 1)},
                          {"width", fixed(std::max(0.5, x(end) - x(begin)), 2)},
                          {"height", fixed(bar, 0)},
                          {"fill", colour}});
    svg_.line_end();
  }

  // across all rows, with a word below
  void mark(Duration at, const std::string& what, const char* colour) {
    line(x(at), top, bottom(), colour);
    svg_.element("text", {{"x", fixed(x(at), 2)}, {"y", fixed(bottom() + 16, 0)}, {"text-anchor", "middle"}}, what);
    svg_.line_end();
  }

  // within one row
  void tick(std::size_t at, Duration instant, const char* colour) {
    line(x(instant), y(at) + 1, y(at) + bar + 7, colour);
  }

  std::string text() { return svg_.end().line_end().text(); }

 private:
  double x(Duration t) const {
    const double span = static_cast<double>(std::max(Duration(1), window_.end - window_.begin).count());
    return left + width * static_cast<double>((t - window_.begin).count()) / span;
  }
  static double y(std::size_t at) { return top + row * static_cast<double>(at); }
  void line(double at, double from, double to, const char* colour) {
    svg_.element(
        "line",
        {{"x1", fixed(at, 2)}, {"y1", fixed(from, 0)}, {"x2", fixed(at, 2)}, {"y2", fixed(to, 0)}, {"stroke", colour}});
    svg_.line_end();
  }

  static constexpr double left = 120, width = 760, row = 28, top = 50, below = 40, bar = 20;

  const Graph& graph_;
  const Window& window_;
  double height_;
  Svg svg_;
};

constexpr const char *on_time = "#4477aa", *too_late = "#cc3311", *release = "#228833";

std::string late_svg(const Graph& graph, const analysis::Result& result) {
  const analysis::DeadlineMiss& late = *result.late;
  const Window window = window_of(result);
  Chart chart(
      graph, window,
      fmt::format("{}: activation {} of {} is {}{} late", graph.name, late.activation, graph.tasks[late.task].name,
                  late.ended ? "" : "more than ", duration_text(late.finish - late.deadline)));
  for (std::size_t i = 0; i < window.tasks.size(); ++i) {
    for (const analysis::Slice& s : result.slices) {
      if (s.task != window.tasks[i] || s.end <= window.begin) continue;
      const Duration cut = s.task == late.task ? std::clamp(late.deadline, s.begin, s.end) : s.end;
      chart.box(i, std::max(s.begin, window.begin), cut, on_time);
      chart.box(i, cut, s.end, too_late);
    }
  }
  if (late.release >= window.begin) chart.mark(late.release, "released " + duration_text(late.release), release);
  if (late.deadline >= window.begin) chart.mark(late.deadline, "deadline " + duration_text(late.deadline), too_late);
  return chart.text();
}

// Who runs when, with a green tick at each release and a red one at each deadline.
std::string time_line_svg(const Graph& graph, const analysis::Result& result) {
  const analysis::TimeLine line = analysis::time_line_of(analysis::system_of(graph), result);
  Window window{{}, line.until, {}};
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) window.tasks.push_back(i);
  Chart chart(graph, window,
              fmt::format("{}: the first {}, each task as long as its wcet", graph.name, duration_text(line.until)));
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    for (const analysis::Slice& s : line.slices)
      if (s.task == i) chart.box(i, s.begin, s.end, on_time);
    for (Duration at = task.offset; at < line.until; at += task.period) {
      chart.tick(i, at, release);
      if (at + task.deadline <= line.until) chart.tick(i, at + task.deadline, too_late);
    }
  }
  chart.mark({}, "0s", "#9aa5b1");
  chart.mark(line.until, duration_text(line.until), "#9aa5b1");
  return chart.text();
}

}  // namespace

std::string gantt_svg(const Graph& graph, const analysis::Result& result) {
  const bool stated = std::all_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return t.wcet; });
  if (!stated || graph.tasks.empty()) return "";
  return result.late ? late_svg(graph, result) : time_line_svg(graph, result);
}

}  // namespace jarol::tools
