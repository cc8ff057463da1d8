// Where the parts of a graph stand in a drawing of it: layered from left to right by Graphviz. One layout serves
// pictures and pages.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "graph/model/graph.h"

namespace jarol::tools {

/// Points, 72 of them an inch; y goes down.
struct DrawnNode {
  enum class Kind { task, in, out, distributer } kind = Kind::task;
  std::string name;
  std::vector<std::string> lines;              // below the name
  double x = 0, y = 0, width = 0, height = 0;  // of the middle
};

/// "task", "in", "out", "distributer".
const char* word_of(DrawnNode::Kind kind);

struct DrawnArrow {
  std::size_t from = 0, to = 0;              // nodes
  std::vector<std::size_t> connections;      // of the graph; none: a channel
  std::string text;                          // what it carries, a line each
  std::vector<std::array<double, 2>> curve;  // a start, then three points for each Bezier curve
};

struct Drawing {
  double width = 0, height = 0;
  std::vector<DrawnNode> nodes;
  std::vector<DrawnArrow> arrows;
  double core_x = 0, core_y = 0, core_width = 0, core_height = 0;  // within are tasks and communicators; top left
};

/// As a node says it: "every 50ms from 10ms".
std::string timing_text(Duration period, Duration offset);

/// Throws Unfinished where Graphviz can't.
Drawing lay_out(const Graph& graph);
/// Of nodes and arrows that have no sizes and places yet. Throws as above.
Drawing lay_out(Drawing parts);

}  // namespace jarol::tools
