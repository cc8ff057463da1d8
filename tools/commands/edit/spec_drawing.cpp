#include "tools/commands/edit/spec_drawing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace jarol::tools::edit {
namespace {

using Kind = DrawnNode::Kind;

template <class S>
std::vector<const S*> by_name(const std::vector<S>& specs) {
  std::vector<const S*> sorted;
  for (const S& spec : specs) sorted.push_back(&spec);
  std::stable_sort(sorted.begin(), sorted.end(), [](const S* a, const S* b) { return a->name < b->name; });
  return sorted;
}

template <class S>
const S* find(const std::vector<S>& specs, const std::string& name) {
  const auto found = std::find_if(specs.begin(), specs.end(), [&](const S& spec) { return spec.name == name; });
  return found == specs.end() ? nullptr : &*found;
}

// The channel that "distributer.channel" names.
struct FoundChannel {
  const DistributerSpec* distributer = nullptr;
  const ChannelClass* channel = nullptr;
};

FoundChannel find_channel(const CommunicatorSpec& communicator, const GraphSpec& spec, const Registry& known) {
  if (!communicator.channel) return {};
  const std::string& text = communicator.channel->value;
  const std::size_t dot = text.find('.');
  FoundChannel found{find(spec.distributers, text.substr(0, dot))};
  if (found.distributer == nullptr || dot == std::string::npos || !found.distributer->type) return found;
  if (const DistributerClass* of = known.find_distributer(found.distributer->type->value))
    for (const ChannelClass& channel : of->channels)
      if (channel.name == text.substr(dot + 1)) found.channel = &channel;
  return found;
}

class SpecDrawing {
 public:
  SpecDrawing(const GraphSpec& spec, const Registry& known) : spec_(spec), known_(known) {}

  Drawing draw() {
    for (const TaskSpec* task : by_name(spec_.tasks)) add_task(*task);
    for (const CommunicatorSpec* communicator : by_name(spec_.communicators))
      add({is_in(*communicator, spec_, known_) ? Kind::in : Kind::out, communicator->name, {timing(*communicator)}});
    add_distributers();
    add_connections();
    for (const CommunicatorSpec* communicator : by_name(spec_.communicators)) add_channel(*communicator);
    drop_idle_sides();
    return std::move(drawing_);
  }

 private:
  template <class S>
  std::string timing(const S& part) const {
    const auto& period = part.period ? part.period : spec_.timing.period;
    const Duration offset = part.offset ? part.offset->value : Duration{};
    return period ? timing_text(period->value, offset) : "no period";
  }

  void add(DrawnNode node) {
    ends_.try_emplace(node.name, drawing_.nodes.size());
    drawing_.nodes.push_back(std::move(node));
  }

  void add_task(const TaskSpec& task) {
    DrawnNode node{Kind::task, task.name, {task.type ? task.type->value : "no type", timing(task)}};
    if (task.let) node.lines.push_back("LET " + duration_text(task.let->value));
    add(std::move(node));
  }

  // On the left for what comes from them, on the right for what goes to them.
  void add_distributers() {
    for (auto* side : {&left_, &right_})
      for (const DistributerSpec* distributer : by_name(spec_.distributers)) {
        side->try_emplace(distributer->name, drawing_.nodes.size());
        drawing_.nodes.push_back(
            {Kind::distributer, distributer->name, {distributer->type ? distributer->type->value : "no type"}});
      }
  }

  // Type of an end, null: it is not known; and the place of the field among its like.
  std::pair<const Type*, std::size_t> field_of(const EndSpec& end, bool output) const {
    const TaskSpec* task = find(spec_.tasks, end.name);
    const TaskClass* task_class = task != nullptr && task->type ? known_.find_task(task->type->value) : nullptr;
    if (task_class == nullptr) return {communicator_type(end), 0};
    const std::vector<TypeField>& fields = (output ? task_class->out : task_class->in)->fields;
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (fields[i].name == end.field) return {fields[i].type, i};
    return {nullptr, fields.size()};
  }

  const Type* communicator_type(const EndSpec& end) const {
    const CommunicatorSpec* communicator = find(spec_.communicators, end.name);
    if (communicator == nullptr) return nullptr;
    if (const ChannelClass* channel = find_channel(*communicator, spec_, known_).channel) return channel->type;
    return communicator->type ? known_.find_type(communicator->type->value) : nullptr;
  }

  static std::string text_of(const EndSpec& end) { return end.name + (end.field.empty() ? "" : "." + end.field); }

  // In the order in which a graph has them: by reader, tasks first.
  void add_connections() {
    std::vector<std::size_t> order(spec_.connections.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto place = [&](std::size_t i) {
      const EndSpec& to = spec_.connections[i].to;
      const auto node = ends_.find(to.name);
      return std::tuple(node == ends_.end() ? drawing_.nodes.size() : node->second, field_of(to, false).second);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> arrows;
    for (const std::size_t i : order) {
      const ConnectionSpec& c = spec_.connections[i];
      const auto from = ends_.find(c.from.name), to = ends_.find(c.to.name);
      if (from == ends_.end() || to == ends_.end()) continue;
      const auto [at, is_new] = arrows.try_emplace({from->second, to->second}, drawing_.arrows.size());
      if (is_new) drawing_.arrows.push_back({from->second, to->second, {}, "", {}});
      DrawnArrow& arrow = drawing_.arrows[at->second];
      arrow.connections.push_back(i);
      const Type* type = field_of(c.from, true).first;
      arrow.text += (arrow.text.empty() ? "" : "\n") + text_of(c.from) + " -> " + text_of(c.to) +
                    (type != nullptr ? " (" + type->name + ")" : "");
    }
  }

  void add_channel(const CommunicatorSpec& communicator) {
    const FoundChannel found = find_channel(communicator, spec_, known_);
    if (found.distributer == nullptr) return;
    const std::string text =
        communicator.channel->value + (found.channel != nullptr ? " (" + found.channel->type->name + ")" : "");
    const std::size_t inside = ends_.at(communicator.name);
    if (is_in(communicator, spec_, known_)) {
      drawing_.arrows.push_back({left_.at(found.distributer->name), inside, {}, text, {}});
    } else {
      drawing_.arrows.push_back({inside, right_.at(found.distributer->name), {}, text, {}});
    }
  }

  // Of a distributer the side is drawn that has an arrow; of one that has none the left.
  void drop_idle_sides() {
    std::vector<bool> used(drawing_.nodes.size());
    for (const DrawnArrow& arrow : drawing_.arrows) used[arrow.from] = used[arrow.to] = true;
    std::vector<std::size_t> now(drawing_.nodes.size());
    std::vector<DrawnNode> kept;
    for (std::size_t i = 0; i < drawing_.nodes.size(); ++i) {
      now[i] = kept.size();
      const std::string& name = drawing_.nodes[i].name;
      const bool is_side = drawing_.nodes[i].kind == Kind::distributer;
      const bool alone = is_side && left_.at(name) == i && !used[right_.at(name)];
      if (!is_side || used[i] || alone) kept.push_back(std::move(drawing_.nodes[i]));
    }
    drawing_.nodes = std::move(kept);
    for (DrawnArrow& arrow : drawing_.arrows) {
      arrow.from = now[arrow.from];
      arrow.to = now[arrow.to];
    }
  }

  const GraphSpec& spec_;
  const Registry& known_;
  Drawing drawing_;
  std::map<std::string, std::size_t> ends_, left_, right_;  // nodes by name
};

}  // namespace

bool is_in(const CommunicatorSpec& communicator, const GraphSpec& spec, const Registry& known) {
  if (const ChannelClass* channel = find_channel(communicator, spec, known).channel)
    return channel->direction == Direction::in;
  if (communicator.direction) return communicator.direction->value == Direction::in;
  return std::none_of(spec.connections.begin(), spec.connections.end(),
                      [&](const ConnectionSpec& c) { return c.to.name == communicator.name; });
}

Drawing lay_out(const GraphSpec& spec, const Registry& known) {
  return tools::lay_out(SpecDrawing(spec, known).draw());
}

}  // namespace jarol::tools::edit
