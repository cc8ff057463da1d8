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
#include "tools/drawing/plot/plot_curve.h"
#include "tools/drawing/plot/plot_map.h"
#include "tools/drawing/plot/plot_pen.h"

namespace jarol::tools {

/// One panel of the picture: a line of what was reached and, where there are such, a step line of what was commanded
/// and a broad one of what is true. Angles are shown in degrees, depths grow downwards, headings go from -180 to 180
/// degrees, enumerators have their names.
struct Panel {
  std::string title;
  std::string unit;          // that of the leaf if empty
  std::uint32_t output = 0;  // index into Plan::outputs; true values follow these, by distributer
  Leaf leaf;
  std::optional<std::pair<std::uint32_t, Leaf>> commanded;
  std::optional<std::pair<std::uint32_t, Leaf>> truth{};
  std::vector<std::pair<std::uint32_t, Leaf>> more{};  // beside the first, of the same unit, each named by its leaf
};

/// What a picture has beside its panels.
struct PictureExtras {
  std::string note{};  // small, at the right of the title
  std::optional<PathSource> path{}, true_path{};
};

/// Keeps a bounded number of extremes per curve, however long the run; the file appears at the end, whole.
class PlotSvg : public RecordSink {
 public:
  PlotSvg(std::string path, std::string title, std::vector<Panel> panels, PictureExtras extras = {});

  /// What another run reached, as lines beside this one's; before `finish`. The picture outlives it.
  std::unique_ptr<RecordSink> beside(std::string name);

  void take(Duration instant, std::uint32_t output, const void* value) override;
  /// Throws std::runtime_error if the file can't be written.
  void finish() override;

  /// The picture of all that was taken so far.
  std::string text() const;

 private:
  struct Line {
    std::size_t curve = 0;
    Stroke stroke{};
    std::string name{};  // in the legend
  };
  struct Drawing {
    Panel panel;
    std::string unit;  // shown
    bool downwards = false;
    std::vector<Line> lines{};  // from below; what other runs reached comes last
    std::size_t first = 0;      // curve of the panel's own leaf
  };
  class Beside;

  void add_line(Drawing& drawing, std::uint32_t output, const Leaf& leaf, const Stroke& stroke, std::string name,
                bool held = false);
  void draw(const Drawing& drawing, double top, PlotPen& pen) const;
  static void draw_legend(const Drawing& drawing, double top, PlotPen& pen);

  std::string path_;
  std::string title_;
  std::string note_;
  std::vector<Drawing> drawings_;
  std::vector<PlotCurve> curves_;
  std::vector<std::vector<std::size_t>> curves_of_;  // per output
  std::size_t others_ = 0;                           // other runs
  std::vector<PlotMap::Path> paths_;
  Duration end_{};  // last instant of the run
};

}  // namespace jarol::tools
