#include "tools/drawing/plot/plot_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "runtime/files/atomic_file.h"
#include "tools/drawing/plot/plot_axis.h"
#include "tools/drawing/plot/plot_names.h"

namespace jarol::tools {
namespace {

// all in px
constexpr double width = 960;
constexpr double left = 64;
constexpr double right = width - 20;
constexpr double first_panel = 52;
constexpr double heading_line = 26;  // above each panel
constexpr double panel_height = 124;
constexpr double panel_gap = 14;
constexpr double time_labels = 48;

// colours of Okabe and Ito, told apart with any kind of colour vision
constexpr Stroke reached_stroke{"#0072B2", "2"};
constexpr Stroke commanded_stroke{"#D55E00", "1.6", "6 4"};
// broad and pale, so that what lies on it is seen
constexpr Stroke true_stroke{"#B8C1CC", "5"};

// of other runs, in turn
constexpr std::array other_strokes{Stroke{"#009E73", "1.6"}, Stroke{"#CC79A7", "1.6"}, Stroke{"#E69F00", "1.6"},
                                   Stroke{"#56B4E9", "1.6"}};

// of several values of one kind, in turn
constexpr std::array strokes_of_kind{Stroke{"#0072B2", "1.6"}, Stroke{"#D55E00", "1.6"}, Stroke{"#009E73", "1.6"},
                                     Stroke{"#CC79A7", "1.6"}, Stroke{"#E69F00", "1.6"}, Stroke{"#56B4E9", "1.6"}};

constexpr double degrees = 180.0 / std::numbers::pi;

std::string_view last_name(std::string_view path) { return path.substr(path.rfind('.') + 1); }

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// What a panel's value is called: by its leaf, or by the title if the output is a plain number.
std::string name_of(const Panel& panel) {
  std::string name(panel.leaf.path.empty() ? panel.title : last_name(panel.leaf.path));
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

bool is_angle(std::string_view unit) { return unit == "rad" || unit.starts_with("rad/") || unit.starts_with("rad "); }

void begin_picture(double height, std::string_view title, Svg& svg) {
  svg.declaration().begin("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                                  {"version", "1.1"},
                                  {"width", px(width)},
                                  {"height", px(height)},
                                  {"viewBox", "0 0 " + px(width) + " " + px(height)},
                                  {"font-family", "Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif"},
                                  {"font-size", "12"},
                                  {"fill", "#52606D"}});
  svg.line_end().element("title", {}, title).line_end();
  svg.element("rect", {{"width", "100%"}, {"height", "100%"}, {"fill", "#FFFFFF"}}).line_end();
}

}  // namespace

PlotSvg::PlotSvg(std::string path, std::string title, std::vector<Panel> panels, PictureExtras extras)
    : path_(std::move(path)), title_(std::move(title)), note_(std::move(extras.note)) {
  for (Panel& panel : panels) {
    Drawing drawing;
    drawing.panel = std::move(panel);
    const Panel& its = drawing.panel;
    std::string unit = its.unit.empty() ? its.leaf.unit : its.unit;
    if (unit.empty() && its.leaf.type->kind == Kind::duration) unit = "s";
    drawing.unit = is_angle(unit) ? "deg" + unit.substr(3) : unit;
    drawing.downwards = name_of(its) == "depth" || (name_of(its) == "z" && unit == "m");
    if (its.truth) add_line(drawing, its.truth->first, its.truth->second, true_stroke, "true");
    drawing.first = curves_.size();
    const bool alone = its.more.empty();
    add_line(drawing, its.output, its.leaf, alone ? reached_stroke : strokes_of_kind[0],
             alone ? "reached" : its.leaf.path);
    for (std::size_t i = 0; i < its.more.size(); ++i)
      add_line(drawing, its.more[i].first, its.more[i].second, strokes_of_kind[(i + 1) % strokes_of_kind.size()],
               its.more[i].second.path);
    if (its.commanded)
      add_line(drawing, its.commanded->first, its.commanded->second, commanded_stroke, "commanded", true);
    drawings_.push_back(std::move(drawing));
  }
  if (extras.true_path) paths_.emplace_back(*extras.true_path, "true", true_stroke);
  if (extras.path) paths_.emplace_back(*extras.path, "reached", reached_stroke);
}

void PlotSvg::add_line(Drawing& drawing, std::uint32_t output, const Leaf& leaf, const Stroke& stroke, std::string name,
                       bool held) {
  PlotCurve curve;
  curve.leaf = leaf;
  if (is_angle(leaf.unit.empty() ? drawing.panel.unit : leaf.unit)) curve.factor = degrees;
  if (leaf.type->kind == Kind::duration) curve.factor = 1e-9;
  curve.angle = drawing.unit == "deg";
  curve.heading = curve.angle && is_any_of(name_of(drawing.panel), {"heading", "psi", "yaw", "course"});
  curve.held = held || leaf.type->kind == Kind::boolean || leaf.type->kind == Kind::enumeration;
  curves_.push_back(std::move(curve));
  if (curves_of_.size() <= output) curves_of_.resize(output + std::size_t{1});
  curves_of_[output].push_back(curves_.size() - 1);
  drawing.lines.push_back({curves_.size() - 1, stroke, std::move(name)});
}

// Adds to the curves of another run.
class PlotSvg::Beside : public RecordSink {
 public:
  explicit Beside(PlotSvg& picture) : picture_(picture) {
    for (const Drawing& drawing : picture.drawings_)
      if (drawing.panel.more.empty()) curves_.emplace_back(drawing.panel.output, drawing.lines.back().curve);
  }
  bool wants(std::uint32_t output) const override {
    return std::any_of(curves_.begin(), curves_.end(), [&](const auto& curve) { return curve.first == output; });
  }
  void take(Duration instant, std::uint32_t output, const void* value) override {
    picture_.end_ = std::max(picture_.end_, instant);
    for (const auto& [of, curve] : curves_)
      if (of == output) picture_.curves_[curve].add(instant, value);
  }
  void finish() override {}

 private:
  PlotSvg& picture_;
  std::vector<std::pair<std::uint32_t, std::size_t>> curves_;  // output and curve
};

std::unique_ptr<RecordSink> PlotSvg::beside(std::string name) {
  const Stroke& stroke = other_strokes[others_++ % other_strokes.size()];
  for (Drawing& drawing : drawings_) {
    if (!drawing.panel.more.empty()) continue;  // colours enough
    PlotCurve curve = curves_[drawing.first];
    curve.spans.clear();
    curve.samples_per_span = 1;
    curve.samples_in_last = 0;
    drawing.lines.push_back({curves_.size(), stroke, name});
    curves_.push_back(std::move(curve));
  }
  return std::make_unique<Beside>(*this);
}

void PlotSvg::take(Duration instant, std::uint32_t output, const void* value) {
  end_ = std::max(end_, instant);
  for (PlotMap::Path& path : paths_) path.take(output, value);
  if (output >= curves_of_.size()) return;
  for (const std::size_t i : curves_of_[output]) { curves_[i].add(instant, value); }
}

// From the right: what was reached, commanded, true, then what other runs reached; kinds from the left.
void PlotSvg::draw_legend(const Drawing& drawing, double top, PlotPen& pen) {
  if (drawing.lines.size() < 2) return;
  constexpr double stroke_length = 26, gap = 6, letter = 7;
  std::vector<const Line*> entries;
  for (auto line = drawing.lines.rbegin(); line != drawing.lines.rend(); ++line) entries.push_back(&*line);
  if (drawing.panel.more.empty()) {
    const auto rank = [&](const Line* line) {
      return line->curve == drawing.first       ? 0
             : line->stroke == commanded_stroke ? 1
             : line->stroke == true_stroke      ? 2
                                                : 3;
    };
    std::stable_sort(entries.begin(), entries.end(), [&](const Line* a, const Line* b) { return rank(a) < rank(b); });
  }
  double at = right;
  for (const Line* line : entries) {
    at -= std::max(84.0, 2 * stroke_length + 2 * gap + letter * static_cast<double>(line->name.size()));
    pen.line(at, at + stroke_length, top - 13, line->stroke);
    pen.text(at + stroke_length + gap, top - 9, line->name);
  }
}

void PlotSvg::draw(const Drawing& drawing, double top, PlotPen& pen) const {
  const double bottom = top + panel_height;
  const PlotCurve& first = curves_[drawing.first];
  const bool angle = first.angle;
  bool whole_numbers = true;
  bool crosses = false;
  double min = PlotCurve::max_value;
  double max = -PlotCurve::max_value;
  std::vector<std::vector<PlotCurve::Point>> lines;
  for (const Line& line : drawing.lines) {
    const PlotCurve& curve = curves_[line.curve];
    lines.push_back(curve.points(end_));
    for (const PlotCurve::Point& p : lines.back()) {
      min = std::min(min, p.value);
      max = std::max(max, p.value);
      crosses = crosses || (curve.heading && p.turn != 0);
    }
    whole_numbers = whole_numbers && curve.leaf.type->kind != Kind::floating && curve.factor == 1;
  }
  const bool no_data = min > max;
  const bool names = first.leaf.type->kind == Kind::enumeration;

  Axis y;
  y.from = drawing.downwards ? top : bottom;
  y.to = drawing.downwards ? bottom : top;
  if (!no_data) {
    // some air around the curves; not below a zero that they do not cross, nor beyond the circle
    const double greatest = std::max(std::abs(min), std::abs(max));
    const double range = max - min;
    const bool flat = range <= 1e-9 * greatest || range < 1e-290;
    const double air = !flat ? (names ? 0.2 : 0.06) * range : greatest > 1e-290 ? 0.1 * greatest : 1.0;
    y.min = min >= 0 && min < air && !flat ? 0 : min - air;
    y.max = max <= 0 && max > -air && !flat ? 0 : max + air;
    if (angle && min >= -180 && max <= 180) {
      y.min = crosses ? -180 : std::max(y.min, -180.0);
      y.max = crosses ? 180 : std::min(y.max, 180.0);
    }
  }
  y.ticks = find_ticks(y.max - y.min, 5, angle);
  if (whole_numbers && y.ticks.exponent < 0) y.ticks = {1, 0};
  const Axis x = time_axis(end_, left, right);
  const std::vector<NamedValue> named = names ? names_in(lines, *first.leaf.type) : std::vector<NamedValue>{};

  std::string grid;
  x.for_each_tick([&](double at, const std::string&) { grid += "M" + px(at) + "," + px(top) + "V" + px(bottom); });
  const auto across = [&](double at) { grid += "M" + px(left) + "," + px(at) + "H" + px(right); };
  for (const NamedValue& each : named) across(y.place(each.value));
  if (!no_data && !names) y.for_each_tick([&](double at, const std::string&) { across(at); });
  pen.grid(grid);
  pen.frame(left, right, top, panel_height);

  pen.heading(left, top - 9, drawing.panel.title, drawing.unit.empty() ? "" : " [" + drawing.unit + "]");
  if (no_data) {
    pen.text((left + right) / 2, top + panel_height / 2 + 5, "no data",
             {{"font-size", "14"}, {"text-anchor", "middle"}});
    return;
  }
  if (!names) {
    pen.svg.begin("g", {{"text-anchor", "end"}}).line_end();
    y.for_each_tick([&](double at, const std::string& label) { pen.text(left - 8, at + 4, label); });
    pen.svg.end().line_end();
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!lines[i].empty()) pen.curve(curves_[drawing.lines[i].curve], lines[i], x, y, drawing.lines[i].stroke, right);
  // within the panel, as they are longer than numbers
  for (const NamedValue& each : named)
    pen.text(left + 6, y.place(each.value) - 4, each.name,
             {{"paint-order", "stroke"}, {"stroke", "#FFFFFF"}, {"stroke-width", "3"}});
  draw_legend(drawing, top, pen);
}

std::string PlotSvg::text() const {
  constexpr double pitch = heading_line + panel_height + panel_gap;
  const double bottom = first_panel + pitch * static_cast<double>(drawings_.size()) - panel_gap;
  const PlotMap map(paths_);
  const double map_top = bottom + time_labels + heading_line;
  const double height = drawings_.empty() ? first_panel + 40
                        : map.is_empty()  ? bottom + time_labels
                                          : map_top + PlotMap::height + time_labels;
  PlotPen pen;
  begin_picture(height, title_, pen.svg);
  pen.text(left, 32, title_, {{"font-size", "18"}, {"font-weight", "bold"}, {"fill", "#1F2933"}});
  if (!note_.empty()) pen.text(right, 32, note_, {{"text-anchor", "end"}});
  if (drawings_.empty()) {
    pen.text(left, first_panel + 16, "no data");
    return pen.svg.end().line_end().text();
  }
  for (std::size_t i = 0; i < drawings_.size(); ++i) {
    pen.svg.begin("g", {{"stroke-linejoin", "round"}, {"stroke-linecap", "round"}}).line_end();
    draw(drawings_[i], first_panel + heading_line + pitch * static_cast<double>(i), pen);
    pen.svg.end().line_end();
  }
  pen.svg.begin("g", {{"text-anchor", "middle"}}).line_end();
  time_axis(end_, left, right).for_each_tick([&](double at, const std::string& label) {
    pen.text(at, bottom + 18, label);
  });
  pen.text((left + right) / 2, bottom + 37, "time [s]");
  pen.svg.end().line_end();
  if (!map.is_empty()) map.draw(left, right, map_top, pen);
  return pen.svg.end().line_end().text();
}

void PlotSvg::finish() {
  AtomicFile file(path_);
  file.write(text());
  file.commit();
}

}  // namespace jarol::tools
