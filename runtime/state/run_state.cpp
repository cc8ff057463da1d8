// The memory of a run, and its values before the first instant.
#include "runtime/state/run_state.h"

#include <algorithm>
#include <cstring>

namespace jarol {

RunState::RunState(const Plan& of, std::span<const expect::Signal> tapped)
    : plan(of),
      status(of.graph.tasks.size()),
      outcomes(of.graph.tasks.size(), Outcome::good),
      heaps(of.graph.tasks.size()),
      last(of.graph.communicators.size()),
      recent_faults(of.graph.tasks.size()),
      releases(of.groups.size()),
      tapped_(tapped),
      arena_(make_large_zeros(of.layout.size, of.layout.spacing == Spacing::pages ? Layout::page : Layout::line)) {
  first_states_.reserve(of.graph.tasks.size());
  for (std::size_t i = 0; i < of.graph.tasks.size(); ++i) make_task(i);
  for (std::size_t i = 0; i < of.graph.communicators.size(); ++i) make_communicator(i);
  // each input begins with what its source reads as until first published
  for (const Connection& c : of.graph.connections) copy_value(*c.type, target_of(c.to), source_of(c.from));
  make_deep_inputs();
  make_taps();
  reserve_actions();
  for (const Plan::Group& group : of.groups) make_group(group);
}

const std::byte* RunState::source_of(const End& end) const {
  if (end.kind == End::Kind::communicator) return at(plan.layout.communicators[end.index].value);
  return at(plan.layout.tasks[end.index].out) + plan.graph.tasks[end.index].task_class->out->fields[end.field].offset;
}

std::byte* RunState::target_of(const End& end) const {
  if (end.kind == End::Kind::communicator) return at(plan.layout.communicators[end.index].input);
  return at(plan.layout.tasks[end.index].in) + plan.graph.tasks[end.index].task_class->in->fields[end.field].offset;
}

void RunState::make_task(std::size_t i) {
  const Task& task = plan.graph.tasks[i];
  const TaskClass& c = *task.task_class;
  const Layout::OfTask& place = plan.layout.tasks[i];
  TaskStatus& of_task = status[i];
  if (has_heap(task)) { of_task.heap = heaps[i] = new (at(place.book)) PrivateHeap(at(place.heap), task.heap); }
  make_owned(*c.parameters, place.parameters, std::pmr::new_delete_resource());
  make_private(*c.out, place.out, of_task.heap);
  copy_value(*c.parameters, at(place.parameters), task.parameters.data());
  copy_value(*c.out, at(place.out), task.out.data());
  make_private(*c.state, place.state, of_task.heap);
  make_private(*c.in, place.in, of_task.heap);
  of_task.task = static_cast<std::uint32_t>(i);
  of_task.recoverable = is_recoverable(task);
  of_task.run = c.run;
  if (!of_task.recoverable) return;
  of_task.kept = at(place.kept);
  of_task.size = plan.layout.recoverable_size(plan.graph, i);
  if (task.fault_limit) recent_faults[i].reserve(static_cast<std::size_t>(task.fault_limit->faults));
  if (task.on_fault != OnFault::restart) return;
  of_task.state_type = c.state;
  if (c.state->is_deep()) of_task.first_state = first_states_.emplace_back(*c.state).data();
}

void RunState::start_with(std::size_t task, const void* parameters) {
  copy_value(*plan.graph.tasks[task].task_class->parameters, at(plan.layout.tasks[task].parameters), parameters);
}

void RunState::make_communicator(std::size_t i) {
  const Communicator& c = plan.graph.communicators[i];
  const Layout::OfCommunicator& places = plan.layout.communicators[i];
  for (const std::size_t place : {places.value, places.input, places.taken})
    make_owned(*c.type, place, &communicator_memory_);
  if (c.direction == Direction::in) copy_value(*c.type, at(places.value), c.init.data());
  last[i] = at(places.value);
}

// A default value whose deep parts go with the heap that they live in.
void RunState::make_private(const Type& type, std::size_t place, PrivateHeap* heap) {
  type.construct(at(place));
  if (type.is_deep()) type.adopt(at(place), heap->values());
}

// A default value in memory that wants it back.
void RunState::make_owned(const Type& type, std::size_t place, std::pmr::memory_resource* memory) {
  type.construct(at(place));
  if (!type.is_deep()) return;
  type.adopt(at(place), memory);
  owned_.push_back({at(place), {&type}});
}

// Connections are in order of their readers, so that each reader's lie side by side.
void RunState::make_deep_inputs() {
  const auto& connections = plan.graph.connections;
  const auto into_task = [](const Connection& c) { return c.type->is_deep() && c.to.kind == End::Kind::task; };
  const auto count = std::count_if(connections.begin(), connections.end(), into_task);
  if (count == 0) return;
  deep_inputs_.resize(static_cast<std::size_t>(count));
  deep_input_of_.resize(connections.size());
  DeepInput* next = deep_inputs_.data();
  for (std::size_t i = 0; i < connections.size(); ++i) {
    if (!into_task(connections[i])) continue;
    Range<DeepInput>& inputs = status[connections[i].to.index].deep_inputs;
    if (inputs.first == nullptr) inputs.first = next;
    deep_input_of_[i] = next++;
    inputs.last = next;
  }
}

void RunState::make_taps() {
  tap_memory_.resize(tapped_.size());
  tap_news.resize(tapped_.size());
  for (std::size_t i = 0; i < tapped_.size(); ++i) {
    taps.push_back(reinterpret_cast<std::byte*>(&tap_memory_[i]));
    const Copy tap = tap_of(i);
    std::memcpy(tap.to, tap.from, tap.size);
  }
}

}  // namespace jarol
