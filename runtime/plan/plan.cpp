#include "runtime/plan/plan.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "graph/values/digest.h"

namespace jarol {
namespace {

// Without tasks a group has none, and its place among the others does not matter.
Duration deadline_of(const GroupDeadlines& deadlines, Duration period, Duration first) {
  const auto found = deadlines.find({period, first});
  return found == deadlines.end() ? Duration::max() : found->second;
}

// Tasks of one group lie in the order in which they run.
std::vector<std::uint32_t> execution_order(const Graph& graph, const GroupDeadlines& group_deadlines) {
  const std::vector<std::size_t> turns = dispatch_order(graph);
  std::vector<std::uint32_t> order(turns.begin(), turns.end());
  std::vector<Duration> deadlines;
  for (const Task& task : graph.tasks) deadlines.push_back(deadline_of(group_deadlines, task.period, task.offset));
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Task &s = graph.tasks[a], &t = graph.tasks[b];
    return std::tie(deadlines[a], s.period, s.offset) < std::tie(deadlines[b], t.period, t.offset);
  });
  return order;
}

template <class T>
std::uint32_t count_of(const std::vector<T>& all) {
  return static_cast<std::uint32_t>(all.size());
}

// Appends; where it stands then.
template <class T>
Indices append(std::vector<T>& all, const std::vector<T>& more) {
  const std::uint32_t first = count_of(all);
  all.insert(all.end(), more.begin(), more.end());
  return {first, count_of(more)};
}

// Names what each task and communicator publishes.
void name_published(Plan& plan) {
  const Graph& graph = plan.graph;
  const auto add = [&](Plan::Publisher& publisher, const std::string& name) {
    const auto at = std::lower_bound(plan.outputs.begin(), plan.outputs.end(), name,
                                     [](const Output& output, const std::string& n) { return output.name < n; });
    if (publisher.published.count++ == 0) publisher.published.first = count_of(plan.published);
    plan.published.push_back({digest::name_hash(name), static_cast<std::uint32_t>(at - plan.outputs.begin())});
  };
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    for (std::size_t f = 0; f < graph.tasks[i].task_class->out->fields.size(); ++f)
      add(plan.tasks[i], end_name(graph, {End::Kind::task, i, f}, true));
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) add(plan.communicators[i], graph.communicators[i].name);
}

// The connections of each producer side by side, in the order of the graph.
void sort_connections(Plan& plan) {
  const std::vector<Connection>& connections = plan.graph.connections;
  const auto readers_of = [&](const Connection& c) -> Indices& {
    return (c.from.kind == End::Kind::task ? plan.tasks : plan.communicators)[c.from.index].readers;
  };
  for (const Connection& c : connections) ++readers_of(c).count;
  std::uint32_t next = 0;
  for (auto* publishers : {&plan.tasks, &plan.communicators})
    for (Plan::Publisher& publisher : *publishers) {
      publisher.readers.first = next;
      next += std::exchange(publisher.readers.count, 0);
    }
  plan.readers.resize(connections.size());
  for (std::uint32_t i = 0; i < connections.size(); ++i) {
    Indices& readers = readers_of(connections[i]);
    plan.readers[readers.first + readers.count++] = i;
  }
}

bool publishes_deep(const Plan& plan, std::uint32_t task) {
  const auto readers = plan.tasks[task].readers.of(plan.readers);
  return std::any_of(readers.begin(), readers.end(),
                     [&](std::uint32_t reader) { return plan.graph.connections[reader].type->is_deep(); });
}

// Appends the task at a place of the order to the newest segment and level of its group, or begins new ones.
void add_to_segment(Plan& plan, Plan::Group& group, const Stages& stages, std::uint32_t place) {
  const std::uint32_t task = plan.order[place];
  const bool first = place == group.tasks.first;
  const std::uint32_t before = first ? task : plan.order[place - 1];
  const bool same_stage = !first && stages.stage[before] == stages.stage[task];
  if (!same_stage) {
    plan.segments.push_back({stages.stage[task], false, {place, 0}, {count_of(plan.levels), 0}});
    ++group.segments.count;
  }
  Plan::Segment& segment = plan.segments.back();
  if (!same_stage || stages.level[before] != stages.level[task]) {
    plan.levels.push_back({place, 0});
    ++segment.levels.count;
  }
  ++plan.levels.back().count;
  ++segment.tasks.count;
  segment.publishes_deep = segment.publishes_deep || publishes_deep(plan, task);
}

void make_groups(Plan& plan, const GroupDeadlines& deadlines) {
  const Graph& graph = plan.graph;
  struct Members {
    std::vector<std::uint32_t> let_ends, outs, ins;
    std::uint32_t tasks = 0;
  };
  // by the least deadline of their tasks, period, first instant
  std::map<std::tuple<Duration, Duration, Duration>, Members> groups;
  const auto members_at = [&](Duration period, Duration first) -> Members& {
    return groups[{deadline_of(deadlines, period, first), period, first}];
  };
  for (const std::uint32_t i : plan.order) {
    const Task& task = graph.tasks[i];
    ++members_at(task.period, task.offset).tasks;
    if (task.let) members_at(task.period, task.offset + *task.let).let_ends.push_back(i);
  }
  for (std::uint32_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& c = graph.communicators[i];
    Members& members = members_at(c.period, c.offset);
    (c.direction == Direction::in ? members.ins : members.outs).push_back(i);
  }
  const Stages stages = stages_of(graph);
  plan.groups.reserve(groups.size());
  std::uint32_t next = 0;  // in the order, which goes by groups
  for (const auto& [key, members] : groups) {
    Plan::Group group{.first = std::get<2>(key),
                      .period = std::get<1>(key),
                      .let_ends = append(plan.let_ends, members.let_ends),
                      .outs = append(plan.outs, members.outs),
                      .ins = append(plan.ins, members.ins),
                      .tasks = {next, members.tasks},
                      .segments = {count_of(plan.segments), 0}};
    for (; next < group.tasks.last(); ++next) add_to_segment(plan, group, stages, next);
    plan.groups.push_back(group);
  }
}

}  // namespace

Plan::Plan(const Graph& of, Spacing spacing) : Plan(of, group_deadlines(of), spacing) {}

Plan::Plan(const Graph& of, const GroupDeadlines& deadlines, Spacing spacing)
    : graph(of),
      outputs(outputs_of(of)),
      order(execution_order(of, deadlines)),
      layout(of, order, spacing),
      tasks(of.tasks.size()),
      communicators(of.communicators.size()) {
  name_published(*this);
  sort_connections(*this);
  make_groups(*this, deadlines);
}

}  // namespace jarol
