// A run as a picture: panels above each other over one axis of time, as SVG that any browser shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/values/bind.h"
#include "runtime/recorder.h"

namespace jarol::tools {

/// One panel of the picture: a line of what was reached and, where there is one, a step line of what was commanded.
/// Angles are shown in degrees, depths grow downwards, headings go from -180 to 180 degrees.
struct Panel {
  std::string title;
  std::string unit;          // that of the leaf if empty
  std::uint32_t output = 0;  // index into Plan::outputs
  Leaf leaf;
  std::optional<std::pair<std::uint32_t, Leaf>> commanded;
};

/// Keeps a bounded number of extremes per curve, however long the run; the file appears at the end, whole.
class PlotSvg : public RecordSink {
 public:
  PlotSvg(std::string path, std::string title, std::vector<Panel> panels);

  void take(Duration instant, std::uint32_t output, const void* value) override;
  /// Throws std::runtime_error if the file can't be written.
  void finish() override;

  /// The picture of all that was taken so far.
  std::string text() const;

 private:
  struct Point {
    std::int64_t instant = 0;  // ns
    double value = 0;          // in the unit shown
    std::int64_t turn = 0;     // whole turns that make a wrapped angle continuous again
  };
  // What is kept of consecutive samples.
  struct Span {
    Point low;
    Point high;
    Point last;
    void widen(const Span& next);
  };
  struct Curve {
    Leaf leaf;
    double factor = 1;     // from the value's unit to the one shown
    bool angle = false;    // in degrees
    bool heading = false;  // shown from -180 to 180
    bool held = false;     // drawn as steps
    std::vector<Span> spans;
    std::uint64_t samples_per_span = 1;
    std::uint64_t samples_in_last = 0;

    void add(std::int64_t instant, double value);
    std::vector<Point> points(std::int64_t end) const;
  };
  struct Drawing {
    Panel panel;
    std::string unit;  // shown
    bool downwards = false;
    std::vector<std::size_t> curves;  // reached, then commanded
  };
  class Pen;

  std::size_t add_curve(std::uint32_t output, const Leaf& leaf, const Drawing& drawing, bool held);
  void draw(const Drawing& drawing, double top, Pen& pen) const;

  std::string path_;
  std::string title_;
  std::vector<Drawing> drawings_;
  std::vector<Curve> curves_;
  std::vector<std::vector<std::size_t>> curves_of_;  // per output
  std::int64_t end_ = 0;                             // last instant of the run
};

}  // namespace jarol::tools
