#include "tools/drawing/graph/layout.h"

#include <graphviz/gvc.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "graph/build_options.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol::tools {
namespace {

constexpr double line_height = 13, margin_x = 10, margin_y = 8, points_per_inch = 72, border = 12, core_margin = 14;

constexpr std::size_t max_drawn_best = 60;

// As wide as its letters are in a common sans-serif font of 11 points; no font is asked, so that every machine draws
// the same.
double text_width(const std::string& text) {
  double width = 0;
  for (const char c : text) width += (std::string_view("ijlt.,:;|!' f").find(c) != std::string_view::npos) ? 3.6 : 6.3;
  return width;
}

void give_size(DrawnNode& node) {
  double width = text_width(node.name) * 1.2;
  for (const std::string& line : node.lines) width = std::max(width, text_width(line));
  node.width = width + 2 * margin_x;
  node.height = line_height * static_cast<double>(1 + node.lines.size()) + 2 * margin_y;
}

struct Ends {
  std::size_t tasks = 0, communicators = 0, distributers = 0;  // where they begin among the nodes
  std::size_t of(const End& end) const { return (end.kind == End::Kind::task ? tasks : communicators) + end.index; }
};

// A distributer stands on the left for what comes from it, and on the right for what goes to it.
Ends add_nodes(const Graph& graph, Drawing& drawing) {
  using Kind = DrawnNode::Kind;
  for (const Task& t : graph.tasks) {
    DrawnNode node{Kind::task, t.name, {t.task_class->name, timing_text(t.period, t.offset)}};
    if (t.let) node.lines.push_back("LET " + duration_text(*t.let));
    drawing.nodes.push_back(std::move(node));
  }
  for (const Communicator& c : graph.communicators)
    drawing.nodes.push_back(
        {c.direction == Direction::in ? Kind::in : Kind::out, c.name, {timing_text(c.period, c.offset)}});
  const Ends ends{0, graph.tasks.size(), drawing.nodes.size()};
  for (int side = 0; side < 2; ++side)
    for (const Distributer& d : graph.distributers)
      drawing.nodes.push_back({Kind::distributer, d.name, {d.distributer_class->name}});
  return ends;
}

// One arrow between two nodes, whatever it carries.
void add_arrows(const Graph& graph, const Ends& ends, Drawing& drawing) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  for (std::size_t i = 0; i < graph.connections.size(); ++i) {
    const Connection& c = graph.connections[i];
    const auto [from, to] = std::pair(ends.of(c.from), ends.of(c.to));
    const auto [at, is_new] = known.try_emplace({from, to}, drawing.arrows.size());
    if (is_new) drawing.arrows.push_back({from, to, {}, "", {}});
    DrawnArrow& arrow = drawing.arrows[at->second];
    arrow.connections.push_back(i);
    arrow.text += (arrow.text.empty() ? "" : "\n") + end_name(graph, c.from, true) + " -> " +
                  end_name(graph, c.to, false) + " (" + c.type->name + ")";
  }
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& c = graph.communicators[i];
    if (!c.distributer) continue;
    const Distributer& d = graph.distributers[*c.distributer];
    const std::string text = d.name + "." + d.distributer_class->channels[c.channel].name + " (" + c.type->name + ")";
    const std::size_t inside = ends.communicators + i, outside = ends.distributers + *c.distributer;
    if (c.direction == Direction::in) {
      drawing.arrows.push_back({outside, inside, {}, text, {}});
    } else {
      drawing.arrows.push_back({inside, outside + graph.distributers.size(), {}, text, {}});
    }
  }
}

void drop_nodes_without_arrows(Drawing& drawing) {
  std::vector<std::size_t> now(drawing.nodes.size());
  std::vector<DrawnNode> kept;
  for (std::size_t i = 0; i < drawing.nodes.size(); ++i) {
    const bool used = drawing.nodes[i].kind != DrawnNode::Kind::distributer ||
                      std::any_of(drawing.arrows.begin(), drawing.arrows.end(),
                                  [&](const DrawnArrow& a) { return a.from == i || a.to == i; });
    now[i] = kept.size();
    if (used) kept.push_back(std::move(drawing.nodes[i]));
  }
  drawing.nodes = std::move(kept);
  for (DrawnArrow& arrow : drawing.arrows) {
    arrow.from = now[arrow.from];
    arrow.to = now[arrow.to];
  }
}

// Graphviz takes texts that it may write to.
void set(void* object, const char* name, std::string value, const char* otherwise = "") {
  std::string key = name, empty = otherwise;
  agsafeset(object, key.data(), value.data(), empty.data());
}

struct Graphviz {
  std::unique_ptr<Agraph_t, int (*)(Agraph_t*)> graph{nullptr, agclose};
  std::vector<Agnode_t*> nodes;
  std::vector<Agedge_t*> edges;
};

void build(Graphviz& to, const Drawing& drawing) {
  std::string name = "jarol", empty;
  to.graph.reset(agopen(name.data(), Agdirected, nullptr));
  set(to.graph.get(), "rankdir", "LR");
  set(to.graph.get(), "ranksep", "0.5");
  set(to.graph.get(), "nodesep", "0.22");
  // a graph of many tasks need not be drawn in the best of all ways, which takes long
  if (drawing.nodes.size() > max_drawn_best)
    for (const char* limit : {"nslimit", "nslimit1"}) set(to.graph.get(), limit, "2");
  for (std::size_t i = 0; i < drawing.nodes.size(); ++i) {
    const DrawnNode& node = drawing.nodes[i];
    std::string id = std::to_string(i);
    to.nodes.push_back(agnode(to.graph.get(), id.data(), 1));
    set(to.nodes.back(), "shape", "box");
    set(to.nodes.back(), "label", "", "\\N");
    set(to.nodes.back(), "fixedsize", "true");
    set(to.nodes.back(), "width", std::to_string(node.width / points_per_inch));
    set(to.nodes.back(), "height", std::to_string(node.height / points_per_inch));
  }
  for (const DrawnArrow& arrow : drawing.arrows) {
    to.edges.push_back(agedge(to.graph.get(), to.nodes[arrow.from], to.nodes[arrow.to], empty.data(), 1));
    set(to.edges.back(), "headport", "w");
    set(to.edges.back(), "tailport", "e");
  }
  // what comes from outside stands first, what goes there last
  const auto keep_together = [&](const char* rank, DrawnNode::Kind kind, bool sends) {
    std::string group = rank;
    Agraph_t* const together = agsubg(to.graph.get(), group.data(), 1);
    set(together, "rank", rank);
    for (std::size_t i = 0; i < drawing.nodes.size(); ++i) {
      if (drawing.nodes[i].kind != kind) continue;
      const bool does =
          std::any_of(drawing.arrows.begin(), drawing.arrows.end(), [&](const DrawnArrow& a) { return a.from == i; });
      if (does == sends) agsubnode(together, to.nodes[i], 1);
    }
  };
  keep_together("source", DrawnNode::Kind::distributer, true);
  keep_together("sink", DrawnNode::Kind::distributer, false);
}

void read_places(const Graphviz& from, Drawing& drawing) {
  const boxf box = GD_bb(from.graph.get());
  drawing.width = box.UR.x + 2 * border;
  drawing.height = box.UR.y + 2 * border;
  const auto x = [&](double its) { return its + border; };
  const auto y = [&](double its) { return box.UR.y - its + border; };
  for (std::size_t i = 0; i < drawing.nodes.size(); ++i) {
    drawing.nodes[i].x = x(ND_coord(from.nodes[i]).x);
    drawing.nodes[i].y = y(ND_coord(from.nodes[i]).y);
  }
  for (std::size_t i = 0; i < drawing.arrows.size(); ++i) {
    const splines* const all = ED_spl(from.edges[i]);
    if (all == nullptr || all->size == 0) continue;
    const bezier& curve = all->list[0];
    for (int at = 0; at < curve.size; ++at)
      drawing.arrows[i].curve.push_back({x(curve.list[at].x), y(curve.list[at].y)});
    if (curve.eflag != 0)
      drawing.arrows[i].curve.insert(drawing.arrows[i].curve.end(), 3, {x(curve.ep.x), y(curve.ep.y)});
  }
}

void find_core(Drawing& drawing) {
  const auto is_outside = [](const DrawnNode& node) { return node.kind == DrawnNode::Kind::distributer; };
  if (std::all_of(drawing.nodes.begin(), drawing.nodes.end(), is_outside)) return;
  double left = drawing.width, top = drawing.height, right = 0, bottom = 0;
  for (const DrawnNode& node : drawing.nodes) {
    if (is_outside(node)) continue;
    left = std::min(left, node.x - node.width / 2);
    right = std::max(right, node.x + node.width / 2);
    top = std::min(top, node.y - node.height / 2);
    bottom = std::max(bottom, node.y + node.height / 2);
  }
  // arrows that turn around stay within
  for (const DrawnArrow& arrow : drawing.arrows)
    for (const auto& point : arrow.curve) {
      top = std::min(top, point[1]);
      bottom = std::max(bottom, point[1]);
    }
  drawing.core_x = left - core_margin;
  drawing.core_y = top - core_margin;
  drawing.core_width = right - left + 2 * core_margin;
  drawing.core_height = bottom - top + 2 * core_margin;
}

// So that nothing lies beyond the edge.
void move_in(Drawing& drawing) {
  const double dx = std::max(0.0, border - drawing.core_x), dy = std::max(0.0, border - drawing.core_y);
  for (DrawnNode& node : drawing.nodes) node.x += dx, node.y += dy;
  for (DrawnArrow& arrow : drawing.arrows)
    for (auto& point : arrow.curve) point[0] += dx, point[1] += dy;
  drawing.core_x += dx;
  drawing.core_y += dy;
  drawing.width = std::max(drawing.width + dx, drawing.core_x + drawing.core_width + border);
  drawing.height = std::max(drawing.height + dy, drawing.core_y + drawing.core_height + border);
}

// The library loses some hundred bytes of each drawing, which is not for our sanitizers; by their lsan_interface.h.
extern "C" void __lsan_disable();
extern "C" void __lsan_enable();
struct UnseenLeaks {
  static constexpr bool looked_for = options_of_this_file().address_sanitizer != 0;
  UnseenLeaks() {
    if constexpr (looked_for) __lsan_disable();
  }
  ~UnseenLeaks() {
    if constexpr (looked_for) __lsan_enable();
  }
  UnseenLeaks(const UnseenLeaks&) = delete;
  UnseenLeaks& operator=(const UnseenLeaks&) = delete;
};

}  // namespace

const char* word_of(DrawnNode::Kind kind) {
  switch (kind) {
    case DrawnNode::Kind::task: return "task";
    case DrawnNode::Kind::in: return "in";
    case DrawnNode::Kind::out: return "out";
    case DrawnNode::Kind::distributer: return "distributer";
  }
  return "";
}

std::string timing_text(Duration period, Duration offset) {
  return "every " + duration_text(period) + (offset > Duration{} ? " from " + duration_text(offset) : "");
}

Drawing lay_out(const Graph& graph) {
  Drawing drawing;
  const Ends ends = add_nodes(graph, drawing);
  add_arrows(graph, ends, drawing);
  drop_nodes_without_arrows(drawing);
  return lay_out(std::move(drawing));
}

Drawing lay_out(Drawing drawing) {
  // Graphviz keeps state of its own between calls, and a second context in a process reads what the first has freed
  static std::mutex one_at_a_time;
  static GVC_t* const context = gvContext();
  const std::lock_guard lock(one_at_a_time);
  for (DrawnNode& node : drawing.nodes) give_size(node);
  Graphviz graphviz;
  build(graphviz, drawing);
  [[maybe_unused]] const UnseenLeaks unseen{};
  if (gvLayout(context, graphviz.graph.get(), "dot") != 0) throw Unfinished("Graphviz could not lay out the graph");
  read_places(graphviz, drawing);
  gvFreeLayout(context, graphviz.graph.get());
  find_core(drawing);
  move_in(drawing);
  return drawing;
}

}  // namespace jarol::tools
