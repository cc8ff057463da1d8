// The actions of a run: the plan's, with the addresses of the run's values.
#include <algorithm>

#include "runtime/state/run_state.h"

namespace jarol {
namespace {

template <class T>
ShortRange<T> from(const LargeVector<T>& all, std::size_t first) {
  return {all.data() + first, static_cast<std::uint32_t>(all.size() - first)};
}

}  // namespace

// Ranges point into these: they never grow beyond what is reserved here.
void RunState::reserve_actions() {
  const Graph& graph = plan.graph;
  copies_.reserve(graph.connections.size() + 2 * tapped_.size());
  if (!deep_input_of_.empty() || !owned_.empty()) deep_copies_.reserve(graph.connections.size());
  publications_.reserve(plan.outputs.size());
  activations.reserve(graph.tasks.size());
  let_ends.reserve(plan.let_ends.size());
  let_values_.reserve(plan.let_ends.size());
  let_outputs.reserve(plan.groups.size());
  outs.reserve(plan.outs.size());
  ins.reserve(plan.ins.size());
  release_queue.reserve(plan.groups.size());
}

void RunState::make_group(const Plan::Group& group) {
  release_queue.add(group.first, group.period);
  const std::size_t copy = copies_.size(), publication = publications_.size(), value = let_values_.size();
  LetOutputs outputs;
  for (const std::uint32_t i : group.let_ends.of(plan.let_ends)) {
    let_ends.push_back({publish_of(End::Kind::task, i), at(plan.layout.tasks[i].out), i});
    add_let_output(outputs, i);
  }
  outputs.publish = {from(copies_, copy), from(publications_, publication)};
  outputs.values = from(let_values_, value);
  let_outputs.push_back(outputs);
  for (const std::uint32_t i : group.outs.of(plan.outs)) outs.push_back(make_action(i));
  for (const std::uint32_t i : group.ins.of(plan.ins)) ins.push_back(make_action(i));
  for (const std::uint32_t i : group.tasks.of(plan.order)) activations.push_back(make_activation(i));
}

void RunState::add_let_output(LetOutputs& outputs, std::uint32_t i) {
  const Task& task = plan.graph.tasks[i];
  const Type& type = *task.task_class->out;
  const std::byte* const out = at(plan.layout.tasks[i].out);
  if (has_let_doubles(task) && plan.layout.spacing == Spacing::lines) {
    const std::size_t lines = (type.size + Layout::line - 1) / Layout::line;
    if (outputs.doubles.first == nullptr) outputs.doubles.first = reinterpret_cast<const double*>(out);
    outputs.doubles.last = reinterpret_cast<const double*>(out + lines * Layout::line);
  } else if (is_checked_at_let_end(task) && has_floating(type)) {
    let_values_.push_back({out, type.finite});
  }
}

Activation RunState::make_activation(std::uint32_t i) {
  const Task& task = plan.graph.tasks[i];
  const Layout::OfTask& place = plan.layout.tasks[i];
  const auto readers = plan.tasks[i].readers.of(plan.readers);
  const std::size_t connections = task.task_class->in->fields.size() + (task.let ? 0 : readers.size());
  return {is_recoverable(task) || has_heap(task) ? &run_with_care : task.task_class->run,
          is_checked_at_let_end(task) ? task.task_class->body : nullptr,
          {at(place.parameters), at(place.in), at(place.state), at(place.out), &status[i]},
          i,
          static_cast<std::uint32_t>(connections),
          task.let ? Publish{} : publish_of(End::Kind::task, i),
          task.let.has_value(),
          std::any_of(readers.begin(), readers.end(),
                      [&](std::uint32_t reader) { return plan.graph.connections[reader].type->is_deep(); })};
}

CommunicatorAction RunState::make_action(std::uint32_t i) {
  const Layout::OfCommunicator& place = plan.layout.communicators[i];
  return {i, at(place.value), at(place.input), at(place.taken), publish_of(End::Kind::communicator, i)};
}

Publish RunState::publish_of(End::Kind kind, std::uint32_t index) {
  const bool is_task = kind == End::Kind::task;
  const Plan::Publisher& publisher = is_task ? plan.tasks[index] : plan.communicators[index];
  const std::size_t copy = copies_.size(), publication = publications_.size();
  for (const std::uint32_t connection : publisher.readers.of(plan.readers)) add_copy(connection);
  add_taps(kind, index);
  std::size_t field = 0;
  for (const Plan::Published& published : publisher.published.of(plan.published)) {
    const Type& type = *plan.outputs[published.output].type;
    publications_.push_back({source_of({kind, index, field++}), published.name_hash, type.hash_words, published.output,
                             type.is_deep() ? 0 : static_cast<std::uint32_t>(type.size)});
  }
  return {from(copies_, copy), from(publications_, publication)};
}

// Of the task whose activation is made.
bool RunState::is_read_next(const Connection& c) const {
  if (c.from.kind != End::Kind::task || c.to.kind != End::Kind::task || plan.graph.tasks[c.from.index].let)
    return false;
  const std::size_t next = activations.size() + 1;
  return next < plan.order.size() && plan.order[next] == c.to.index;
}

void RunState::add_copy(std::uint32_t connection) {
  const Connection& c = plan.graph.connections[connection];
  if (!c.type->is_deep()) {
    copies_.push_back({source_of(c.from), target_of(c.to), static_cast<std::uint32_t>(c.type->size), is_read_next(c)});
    return;
  }
  deep_copies_.push_back({c.type, source_of(c.from), deep_input_of_.empty() ? nullptr : deep_input_of_[connection]});
  copies_.push_back({&deep_copies_.back(), target_of(c.to), 0});
}

// What is published there is looked at, as by a reader.
void RunState::add_taps(End::Kind kind, std::size_t index) {
  static constexpr std::byte published{1};
  for (std::size_t i = 0; i < tapped_.size(); ++i)
    if (tapped_[i].published->kind == kind && tapped_[i].published->index == index)
      copies_.insert(copies_.end(), {tap_of(i), {&published, &tap_news[i], 1}});
}

Copy RunState::tap_of(std::size_t i) const {
  const expect::Signal& signal = tapped_[i];
  return {source_of(*signal.published) + signal.leaf.offset, taps[i],
          static_cast<std::uint32_t>(signal.leaf.type->size)};
}

}  // namespace jarol
