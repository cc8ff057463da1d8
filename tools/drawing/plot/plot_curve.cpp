#include "tools/drawing/plot/plot_curve.h"

#include <algorithm>
#include <cmath>

namespace jarol::tools {
namespace {

constexpr std::size_t max_spans = std::size_t{1} << 14;
constexpr std::size_t max_points = 2000;

double read_number(const Leaf& leaf, const void* value) {
  const void* at = static_cast<const std::byte*>(value) + leaf.offset;
  if (leaf.type->kind == Kind::floating) return read_floating(*leaf.type, at);
  const std::int64_t integer = read_integer(*leaf.type, at);
  if (leaf.type->kind == Kind::unsigned_integer) return static_cast<double>(static_cast<std::uint64_t>(integer));
  return static_cast<double>(integer);
}

}  // namespace

void PlotCurve::Span::widen(const Span& next) {
  const auto straight = [](const Point& p) { return p.value + 360.0 * static_cast<double>(p.turn); };
  if (straight(next.low) < straight(low)) low = next.low;
  if (straight(next.high) > straight(high)) high = next.high;
  last = next.last;
}

void PlotCurve::add(Duration instant, const void* output) {
  double value = read_number(leaf, output) * factor;
  if (!(std::abs(value) < max_value)) return;  // nor what is no number
  if (heading && std::abs(value) > 180) value -= 360 * std::ceil((value - 180) / 360);
  Point point{instant, value, 0};
  if (!spans.empty()) {
    const Point& before = spans.back().last;
    point.turn = before.turn;
    if (angle && std::abs(value - before.value) > 180) point.turn += value < before.value ? 1 : -1;
    if (held && value == before.value) return;
  }
  const Span span{point, point, point};
  if (!spans.empty() && samples_in_last < samples_per_span) {
    spans.back().widen(span);
    ++samples_in_last;
    return;
  }
  // full: pairs become one, and from now on a span takes twice as many samples
  if (spans.size() == max_spans) {
    for (std::size_t i = 0; i < max_spans / 2; ++i) {
      Span pair = spans[2 * i];
      pair.widen(spans[2 * i + 1]);
      spans[i] = pair;
    }
    spans.resize(max_spans / 2);
    samples_per_span *= 2;
  }
  spans.push_back(span);
  samples_in_last = 1;
}

std::vector<PlotCurve::Point> PlotCurve::points(Duration end) const {
  std::vector<Span> drawn;
  const bool all = samples_per_span == 1 && spans.size() <= max_points;
  // else one span for each column of the picture, up to three points of each
  constexpr std::size_t columns = max_points / 3;
  std::size_t column_before = columns;
  for (const Span& span : spans) {
    const double part =
        static_cast<double>(span.last.instant.count()) / static_cast<double>(std::max(end, Duration(1)).count());
    const std::size_t column = std::min(columns - 1, static_cast<std::size_t>(part * columns));
    if (all || drawn.empty() || column != column_before) {
      drawn.push_back(span);
    } else {
      drawn.back().widen(span);
    }
    column_before = column;
  }
  std::vector<Point> points;
  for (const Span& span : drawn) {
    const bool rises = span.low.instant < span.high.instant;
    for (const Point& p : {rises ? span.low : span.high, rises ? span.high : span.low, span.last})
      if (points.empty() || points.back().instant < p.instant) points.push_back(p);
  }
  return points;
}

}  // namespace jarol::tools
