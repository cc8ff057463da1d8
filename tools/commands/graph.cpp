// jarol graph: a graph as text, as JSON, as a picture or as a DOT drawing.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "graph/model/stages.h"
#include "graph/text/escape.h"

#include "tools/commands/commands.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/drawing/graph/graph_svg.h"
#include "tools/report/command_line.h"
#include "tools/report/json_line.h"
#include "tools/report/rest_report.h"
#include "tools/report/value_json.h"

namespace jarol::tools {
namespace {

struct GraphOptions {
  std::string file;
  Overrides overrides;
  bool dot = false;
  bool svg = false;
  bool json = false;
};

std::string timing_text(Duration period, Duration offset) {
  return "every " + duration_text(period) + (offset.count() > 0 ? " from " + duration_text(offset) : "");
}

std::string task_text(const Task& task) {
  return timing_text(task.period, task.offset) + (task.let ? ", LET " + duration_text(*task.let) : "") + ", deadline " +
         duration_text(task.deadline);
}

nlohmann::ordered_json at_end_json(const Graph& graph) {
  return {{"command", command_to_json(graph)},
          {"until", graph.at_end->until.text},
          {"longest_ns", graph.at_end->longest.count()}};
}

void print_text(const Graph& graph) {
  std::cout << "graph " << printable(graph.name) << "\n\ncommunicators\n";
  for (const Communicator& c : graph.communicators) {
    std::cout << "  " << c.name << ": " << (c.direction == Direction::in ? "in" : "out") << ", " << c.type->name << ", "
              << timing_text(c.period, c.offset);
    if (c.distributer) {
      const Distributer& d = graph.distributers[*c.distributer];
      std::cout << ", channel " << d.name << "." << d.distributer_class->channels[c.channel].name;
    }
    if (c.timeout) std::cout << ", silent after " << duration_text(*c.timeout);
    if (c.safe)
      std::cout << ", while silent "
                << to_json(*c.type, c.safe->data()).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    std::cout << "\n";
  }
  std::cout << "\ntasks, in the order in which they run when released together\n";
  for (const std::size_t i : dispatch_order(graph)) {
    const Task& t = graph.tasks[i];
    std::cout << "  " << t.name << " (" << t.task_class->name << "): " << task_text(t) << "\n";
  }
  std::cout << "\nconnections\n";
  for (const Connection& c : graph.connections)
    std::cout << "  " << end_name(graph, c.from, true) << " -> " << end_name(graph, c.to, false) << " (" << c.type->name
              << ")\n";
  if (graph.at_end)
    std::cout << "\nat the end\n  " << command_text(graph) << " until " << printable(graph.at_end->until.text)
              << ", at most " << duration_text(graph.at_end->longest) << "\n";
}

nlohmann::ordered_json communicator_json(const Graph& graph, const Communicator& c) {
  nlohmann::ordered_json json{{"name", c.name},
                              {"direction", c.direction == Direction::in ? "in" : "out"},
                              {"type", c.type->name},
                              {"period_ns", c.period.count()},
                              {"offset_ns", c.offset.count()}};
  if (c.distributer) {
    const Distributer& d = graph.distributers[*c.distributer];
    json["channel"] = d.name + "." + d.distributer_class->channels[c.channel].name;
  }
  if (c.timeout) json["timeout_ns"] = c.timeout->count();
  if (c.safe) json["safe"] = to_json(*c.type, c.safe->data());
  return json;
}

nlohmann::ordered_json task_json(const Task& t) {
  nlohmann::ordered_json json{
      {"name", t.name}, {"type", t.task_class->name}, {"period_ns", t.period.count()}, {"offset_ns", t.offset.count()}};
  if (t.let) json["let_ns"] = t.let->count();
  json["deadline_ns"] = t.deadline.count();
  if (t.wcet) json["wcet_ns"] = t.wcet->count();
  return json;
}

// The tasks in the order in which they run when released together.
void print_json(const Graph& graph) {
  auto communicators = nlohmann::ordered_json::array(), tasks = nlohmann::ordered_json::array(),
       connections = nlohmann::ordered_json::array();
  for (const Communicator& c : graph.communicators) communicators.push_back(communicator_json(graph, c));
  for (const std::size_t i : dispatch_order(graph)) tasks.push_back(task_json(graph.tasks[i]));
  for (const Connection& c : graph.connections)
    connections.push_back(
        {{"from", end_name(graph, c.from, true)}, {"to", end_name(graph, c.to, false)}, {"type", c.type->name}});
  nlohmann::ordered_json json{{"schema", "jarol.graph/1"},
                              {"graph", graph.name},
                              {"communicators", std::move(communicators)},
                              {"tasks", std::move(tasks)},
                              {"connections", std::move(connections)}};
  if (graph.at_end) json["at_end"] = at_end_json(graph);
  std::cout << json_line(json);
}

// A name may be one of DOT's own words.
std::string quoted(const std::string& name) { return '"' + dot_text(name) + '"'; }

std::string dot_name(const Graph& graph, const End& end) {
  return quoted(end.kind == End::Kind::task ? graph.tasks[end.index].name : graph.communicators[end.index].name);
}

std::string dot_label(const Graph& graph, const Connection& c) {
  std::string from, to;
  if (c.from.kind == End::Kind::task) from = graph.tasks[c.from.index].task_class->out->fields[c.from.field].name;
  if (c.to.kind == End::Kind::task) to = graph.tasks[c.to.index].task_class->in->fields[c.to.field].name;
  return from.empty() || to.empty() || from == to ? (from.empty() ? to : from) : from + " > " + to;
}

// "simulation vehicles/lauv.yaml", "udp 127.0.0.1:6002"
std::string link_text(const Distributer& distributer) {
  std::string text;
  for (const char* key : {"type", "vehicle", "file", "peer", "listen", "device"})
    if (const Yaml* value = distributer.link.find(key); value != nullptr && value->kind == Yaml::Kind::scalar)
      text += (text.empty() ? "" : " ") + value->text;
  return text;
}

void print_dot_task(const Task& t) {
  std::cout << "    " << quoted(t.name) << " [style=\"rounded,filled\", fillcolor=\"" << (t.let ? "#e8f0fe" : "white")
            << "\", label=\"" << t.name << "\\n"
            << dot_text(t.task_class->name) << "\\n"
            << timing_text(t.period, t.offset) << (t.let ? "\\nLET " + duration_text(*t.let) : "") << "\"];\n";
}

// The core within its boundary, communicators as boxes of another colour; outside it the distributers with their links.
void print_dot(const Graph& graph) {
  std::cout << "digraph \"" << dot_text(graph.name)
            << "\" {\n  rankdir=LR;\n  node [fontname=\"sans-serif\", fontsize=11, shape=box, margin=\"0.15,0.08\"];\n"
            << "  edge [fontname=\"sans-serif\", fontsize=9];\n"
            << "  subgraph cluster_core {\n    label=\"" << dot_text(graph.name)
            << "\"; fontname=\"sans-serif\"; style=rounded; margin=16;\n";
  for (const Communicator& c : graph.communicators)
    std::cout << "    " << quoted(c.name) << " [style=filled, fillcolor=\"#fff4d6\", label=\"" << c.name << "\\n"
              << (c.direction == Direction::in ? "in " : "out ") << timing_text(c.period, c.offset) << "\"];\n";
  for (const Task& t : graph.tasks) print_dot_task(t);
  for (const Connection& c : graph.connections)
    std::cout << "    " << dot_name(graph, c.from) << " -> " << dot_name(graph, c.to) << " [label=\""
              << dot_text(dot_label(graph, c)) << "\"];\n";
  std::cout << "  }\n";
  for (const Distributer& d : graph.distributers)
    std::cout << "  " << quoted("distributer " + d.name) << " [style=\"filled,dashed\", fillcolor=\"#eeeeee\", label=\""
              << d.name << "\\n"
              << dot_text(d.distributer_class->name) << (d.link.kind == Yaml::Kind::mapping ? "\\n" : "")
              << dot_text(link_text(d)) << "\"];\n";
  for (const Communicator& c : graph.communicators) {
    if (!c.distributer) continue;
    const Distributer& d = graph.distributers[*c.distributer];
    const std::string outside = quoted("distributer " + d.name), inside = quoted(c.name),
                      channel = d.distributer_class->channels[c.channel].name;
    std::cout << "  " << (c.direction == Direction::in ? outside + " -> " + inside : inside + " -> " + outside)
              << " [label=\"" << dot_text(channel) << "\", style=dashed];\n";
  }
  std::cout << "}\n";
}

}  // namespace

void add_graph(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<GraphOptions>();
  Command* command = line.add_subcommand("graph", "Print a graph as text, as a picture, or as a drawing for Graphviz");
  command->add_option("FILE", options->file, "The graph, a YAML file")->file({"yaml"})->required();
  command->add_option("--set", options->overrides.set, "Change a value: path=value, as in tasks.depth.period=100ms")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
  add_no_plugins(*command, options->overrides);
  auto* dot = command->add_flag("--dot", options->dot, "A DOT drawing: jarol graph FILE --dot | dot -Tsvg > graph.svg");
  auto* svg = command->add_flag("--svg", options->svg, "A picture: jarol graph FILE --svg > graph.svg");
  svg->excludes(dot);
  auto* json = command->add_flag("--json", options->json, "One JSON object instead of text");
  json->excludes(dot);
  json->excludes(svg);
  command->callback([options, &exit_code] {
    const Loaded loaded = load_graph(options->file, options->overrides);
    const Graph& graph = *loaded.graph;
    if (options->svg) {
      std::cout << to_svg(lay_out(graph), graph.name);
    } else {
      options->json ? print_json(graph) : options->dot ? print_dot(graph) : print_text(graph);
    }
    exit_code = exit_good;
  });
}

}  // namespace jarol::tools
