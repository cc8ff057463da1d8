#include "graph/model/heaps.h"

#include <memory>

#include "graph/values/heap.h"

namespace jarol {
namespace {

// A task's values in a heap of its own, which takes them with it.
class Trial {
 public:
  explicit Trial(std::size_t size)
      : region_(std::make_unique_for_overwrite<std::byte[]>(size)), heap_(region_.get(), size) {}

  std::size_t size() const { return heap_.size(); }

  void add(const Type& type, const void* value) {
    if (!type.is_deep()) return;
    values_.push_back(std::make_unique<std::byte[]>(type.size));
    type.construct(values_.back().get());
    type.adopt(values_.back().get(), heap_.values());
    if (value != nullptr) copy_value(type, values_.back().get(), value);
  }

 private:
  std::unique_ptr<std::byte[]> region_;
  PrivateHeap heap_;
  std::vector<std::unique_ptr<std::byte[]>> values_;
};

}  // namespace

const void* initial_value(const Graph& graph, const End& end) {
  if (end.kind == End::Kind::communicator) return graph.communicators[end.index].init.data();
  const Task& task = graph.tasks[end.index];
  return static_cast<const std::byte*>(task.out.data()) + task.task_class->out->fields[end.field].offset;
}

void check_heaps(const Graph& graph, Problems& problems) {
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    if (!task.task_class->is_deep()) continue;
    Trial trial(task.heap);
    try {
      trial.add(*task.task_class->out, task.out.data());
      trial.add(*task.task_class->state, nullptr);
      for (const Connection& c : graph.connections)
        if (c.to.kind == End::Kind::task && c.to.index == i) trial.add(*c.type, initial_value(graph, c.from));
    } catch (const HeapExhausted& error) {
      problems.add(task.where, "task '" + task.name + "' (" + task.task_class->name +
                                   ") can't hold the values that it begins with: " + error.what());
    }
  }
}

}  // namespace jarol
