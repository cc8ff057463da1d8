#include "runtime/plan/layout.h"

#include <algorithm>
#include <map>

#include "graph/values/heap.h"

namespace jarol {

Layout::Layout(const Graph& graph, const std::vector<std::uint32_t>& order, Spacing of)
    : spacing(of), tasks(graph.tasks.size()), communicators(graph.communicators.size()) {
  const std::size_t nothing = spacing == Spacing::lines ? place(1, 1) : 0;  // of all tasks without parameters
  for (const std::uint32_t i : order) {
    if (spacing == Spacing::pages) {
      place_apart(graph, i);
      continue;
    }
    const TaskClass& c = *graph.tasks[i].task_class;
    place(0, line);
    tasks[i].in = place(*c.in);
    tasks[i].state = place(*c.state);
    if (!has_let_doubles(graph.tasks[i])) tasks[i].out = place(*c.out);
    // last: values of whole cache lines stay in line
    const bool empty = c.parameters->fields.empty() && c.parameters->size == 1;
    tasks[i].parameters = empty ? nothing : place(*c.parameters);
  }
  place_let_doubles(graph, order);
  for (std::size_t i = 0; i < communicators.size(); ++i) {
    const Type& type = *graph.communicators[i].type;
    place(0, line);
    communicators[i].value = place(type);
    communicators[i].input = place(type);
    communicators[i].taken = place(type);
  }
  place(0, line);
  if (spacing == Spacing::pages) return;
  // apart from what every activation touches
  for (const std::uint32_t i : order) place_heap(graph, i);
  for (const std::uint32_t i : order) place_kept(graph, i);
  place(0, line);
}

void Layout::place_apart(const Graph& graph, std::uint32_t i) {
  const TaskClass& c = *graph.tasks[i].task_class;
  const bool heap = has_heap(graph.tasks[i]);
  const std::size_t alignment = std::max({c.in->alignment, c.state->alignment, c.out->alignment, heap ? line : 1});
  // they are read, never written
  place(0, page);
  tasks[i].parameters = place(*c.parameters);
  tasks[i].begin = place(0, page);
  const auto place_from = [&](std::size_t begin) {
    size = begin;
    tasks[i].in = place(*c.in);
    tasks[i].state = place(*c.state);
    tasks[i].out = place(*c.out);
    place_heap(graph, i);
  };
  place_from(tasks[i].begin);  // to see how much has to be kept
  size = tasks[i].begin;
  place_kept(graph, i);
  // up to the end of a page: what is written behind it is seen
  const std::size_t begin = place(0, alignment);
  place_from(begin);
  place_from(begin + (page - 1 - (size + page - 1) % page) / alignment * alignment);
  tasks[i].end = place(0, page);
}

void Layout::place_heap(const Graph& graph, std::uint32_t i) {
  if (!has_heap(graph.tasks[i])) return;
  tasks[i].book = place(sizeof(PrivateHeap), line);
  tasks[i].heap = place(graph.tasks[i].heap, line);
}

void Layout::place_kept(const Graph& graph, std::uint32_t i) {
  if (is_recoverable(graph.tasks[i])) tasks[i].kept = place(recoverable_size(graph, i) + graph.tasks[i].heap, line);
}

std::size_t Layout::recoverable_size(const Graph& graph, std::size_t task) const {
  return tasks[task].out + graph.tasks[task].task_class->out->size - tasks[task].state;
}

void Layout::place_let_doubles(const Graph& graph, const std::vector<std::uint32_t>& order) {
  std::map<std::pair<Duration, Duration>, std::vector<std::uint32_t>> at_end;  // by period and first end
  for (const std::uint32_t i : order) {
    const Task& task = graph.tasks[i];
    if (spacing == Spacing::lines && has_let_doubles(task)) at_end[{task.period, task.offset + *task.let}].push_back(i);
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
