#include "tools/drawing/plot/plot_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/drawing/plot/plot_axis.h"

namespace jarol::tools {
namespace {

constexpr std::size_t max_places = 2048;
constexpr double smallest = 1;  // m: of one that stands still it shows so much

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void widen(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double length() const { return high - low; }
  double middle() const { return low + length() / 2; }
};

// Around the middle of the range, as many metres as there are px for.
Axis axis_of(const Range& range, double pixels_per_metre, double from, double to) {
  const double half = std::abs(to - from) / pixels_per_metre / 2;
  return {range.middle() - half, range.middle() + half, from, to, {}};
}

}  // namespace

PlotMap::Path::Path(PathSource source, std::string name, const Stroke& stroke)
    : source_(std::move(source)), name_(std::move(name)), stroke_(stroke) {}

void PlotMap::Path::take(std::uint32_t output, const void* value) {
  if (output != source_.output) return;
  const auto number = [&](const Leaf& leaf) {
    return read_floating(*leaf.type, static_cast<const std::byte*>(value) + leaf.offset);
  };
  const Place place{number(source_.north), number(source_.east)};
  if (!std::isfinite(place.north) || !std::isfinite(place.east)) return;
  last_ = place;
  if (taken_++ % step_ != 0) return;
  if (places_.size() == max_places) {
    for (std::size_t i = 0; i < max_places / 2; ++i) places_[i] = places_[2 * i];
    places_.resize(max_places / 2);
    step_ *= 2;
    if ((taken_ - 1) % step_ != 0) return;
  }
  places_.push_back(place);
}

PlotMap::PlotMap(const std::vector<Path>& paths) : paths_(paths) {}

bool PlotMap::is_empty() const {
  return std::all_of(paths_.begin(), paths_.end(), [](const Path& path) { return path.places_.empty(); });
}

void PlotMap::draw(double left, double right, double top, PlotPen& pen) const {
  constexpr double air = 1.1;
  const double bottom = top + height;
  Range north, east;
  for (const Path& path : paths_)
    for (const Path::Place& place : path.places_) {
      north.widen(place.north);
      east.widen(place.east);
    }
  const double scale = std::min((right - left) / std::max(smallest, air * east.length()),
                                height / std::max(smallest, air * north.length()));
  Axis x = axis_of(east, scale, left, right), y = axis_of(north, scale, bottom, top);
  x.ticks = y.ticks = find_ticks(y.max - y.min, 6, false);

  pen.svg.begin("g", {{"stroke-linejoin", "round"}, {"stroke-linecap", "round"}}).line_end();
  std::string grid;
  x.for_each_tick([&](double at, const std::string&) { grid += "M" + px(at) + "," + px(top) + "V" + px(bottom); });
  y.for_each_tick([&](double at, const std::string&) { grid += "M" + px(left) + "," + px(at) + "H" + px(right); });
  pen.grid(grid);
  pen.frame(left, right, top, height);
  pen.heading(left, top - 9, "path", " [m] seen from above");
  pen.svg.begin("g", {{"text-anchor", "end"}}).line_end();
  y.for_each_tick([&](double at, const std::string& label) { pen.text(left - 8, at + 4, label); });
  pen.svg.end().line_end().begin("g", {{"text-anchor", "middle"}}).line_end();
  x.for_each_tick([&](double at, const std::string& label) { pen.text(at, bottom + 18, label); });
  pen.text((left + right) / 2, bottom + 37, "east [m], north is up");
  pen.svg.end().line_end();

  constexpr double legend_width = 96;
  double legend = right - legend_width * static_cast<double>(paths_.size() + 1);
  for (const Path& path : paths_) {
    legend += legend_width;
    if (path.places_.empty()) continue;
    std::string line;
    double across = 0, up = 0;  // of the pen
    const auto add = [&](const Path::Place& place, double shortest) {
      const double next_across = x.place(place.east), next_up = y.place(place.north);
      if (!line.empty() && std::hypot(next_across - across, next_up - up) < shortest) return;
      line += (line.empty() ? "M" : "L") + px(next_across) + "," + px(next_up);
      across = next_across;
      up = next_up;
    };
    for (const Path::Place& place : path.places_) add(place, 1);
    add(path.last_, 0);
    pen.path(line, path.stroke_);
    pen.line(legend, legend + 26, top - 13, path.stroke_);
    pen.text(legend + 32, top - 9, path.name_);
  }
  const Path& newest = paths_.back().places_.empty() ? paths_.front() : paths_.back();
  for (const auto& [place, word] : {std::pair(newest.places_.front(), "start"), std::pair(newest.last_, "end")}) {
    pen.svg.element(
        "circle", {{"cx", px(x.place(place.east))}, {"cy", px(y.place(place.north))}, {"r", "4"}, {"fill", "#1F2933"}});
    pen.svg.line_end();
    pen.text(x.place(place.east) + 7, y.place(place.north) - 7, word);
  }
  pen.svg.end().line_end();
}

}  // namespace jarol::tools
