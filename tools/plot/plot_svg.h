// A run as a picture: panels above each other over one axis of time, as SVG that any browser shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/values/bind.h"
#include "runtime/record/recorder.h"
#include "tools/plot/plot_curve.h"

namespace jarol::tools {

class PlotPen;

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

  /// What another run reached, as lines beside this one's; before `finish`. The picture outlives it.
  std::unique_ptr<RecordSink> beside(std::string name);

  void take(Duration instant, std::uint32_t output, const void* value) override;
  /// Throws std::runtime_error if the file can't be written.
  void finish() override;

  /// The picture of all that was taken so far.
  std::string text() const;

 private:
  struct Drawing {
    Panel panel;
    std::string unit;  // shown
    bool downwards = false;
    std::vector<std::size_t> curves;  // reached, then commanded
    std::vector<std::size_t> others;  // what other runs reached
  };
  class Beside;

  std::size_t add_curve(std::uint32_t output, const Leaf& leaf, const Drawing& drawing, bool held);
  void draw(const Drawing& drawing, double top, PlotPen& pen) const;

  std::string path_;
  std::string title_;
  std::vector<Drawing> drawings_;
  std::vector<PlotCurve> curves_;
  std::vector<std::vector<std::size_t>> curves_of_;  // per output
  std::vector<std::string> others_;                  // other runs
  std::int64_t end_ = 0;                             // last instant of the run
};

}  // namespace jarol::tools
