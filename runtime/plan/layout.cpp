#include "runtime/plan/layout.h"

#include <map>

namespace jarol {

Layout::Layout(const Graph& graph, const std::vector<std::uint32_t>& order)
    : tasks(graph.tasks.size()), communicators(graph.communicators.size()) {
  for (const std::uint32_t i : order) {
    const TaskClass& c = *graph.tasks[i].task_class;
    place(0, line);
    tasks[i].in = place(*c.in);
    tasks[i].parameters = place(*c.parameters);
    tasks[i].state = place(*c.state);
    if (!has_let_doubles(graph.tasks[i])) tasks[i].out = place(*c.out);
  }
  place_let_doubles(graph, order);
  for (std::size_t i = 0; i < communicators.size(); ++i) {
    const Type& type = *graph.communicators[i].type;
    place(0, line);
    communicators[i].value = place(type);
    communicators[i].input = place(type);
    communicators[i].taken = place(type);
  }
  // apart from what every activation touches
  for (const std::uint32_t i : order) tasks[i].heap = place(graph.tasks[i].heap, line);
  for (const std::uint32_t i : order)
    if (is_undoable(graph.tasks[i])) tasks[i].kept = place(undoable_size(graph, i) + graph.tasks[i].heap, line);
  place(0, line);
}

std::size_t Layout::undoable_size(const Graph& graph, std::size_t task) const {
  return tasks[task].out + graph.tasks[task].task_class->out->size - tasks[task].state;
}

void Layout::place_let_doubles(const Graph& graph, const std::vector<std::uint32_t>& order) {
  std::map<std::pair<Duration, Duration>, std::vector<std::uint32_t>> at_end;  // by period and first end
  for (const std::uint32_t i : order) {
    const Task& task = graph.tasks[i];
    if (has_let_doubles(task)) at_end[{task.period, task.offset + *task.let}].push_back(i);
  }
  for (const auto& [end, members] : at_end)
    for (const std::uint32_t i : members) tasks[i].out = place(graph.tasks[i].task_class->out->size, line);
}

std::size_t Layout::place(std::size_t bytes, std::size_t alignment) {
  const std::size_t at = (size + alignment - 1) / alignment * alignment;
  size = at + bytes;
  return at;
}

}  // namespace jarol
