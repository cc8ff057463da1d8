#include "graph/model/build.h"

#include <algorithm>
#include <functional>

#include "graph/language/key.h"
#include "graph/model/chains.h"
#include "graph/model/channels.h"
#include "graph/model/connect.h"
#include "graph/model/deadlines.h"
#include "graph/model/failsafe.h"
#include "graph/model/heaps.h"
#include "graph/model/parameters.h"
#include "graph/values/bind.h"

namespace jarol {
namespace {

// References: a spec is large.
template <class S>
std::vector<std::reference_wrapper<const S>> by_name(const std::vector<S>& specs) {
  std::vector<std::reference_wrapper<const S>> order(specs.begin(), specs.end());
  std::stable_sort(order.begin(), order.end(), [](const S& a, const S& b) { return a.name < b.name; });
  return order;
}

template <class T>
std::optional<T> value_of(const Maybe<T>& maybe) {
  return maybe ? std::optional<T>(maybe->value) : std::nullopt;
}

class Builder {
 public:
  Builder(const GraphSpec& spec, const Registry& registry, Problems& problems)
      : spec_(spec), registry_(registry), problems_(problems) {}

  Graph build() {
    graph_.name = spec_.name ? spec_.name->value : "";
    graph_.where = spec_.where;
    graph_.period = value_of(spec_.timing.period);
    graph_.platform.cores = spec_.platform.cores ? spec_.platform.cores->value : 1;
    graph_.platform.policy = find_policy();
    graph_.platform.dispatch = value_of(spec_.platform.dispatch).value_or(Duration{});
    graph_.platform.copy = value_of(spec_.platform.copy).value_or(Duration{});
    if (spec_.platform.phasing) graph_.platform.phasing = spec_.platform.phasing->value;
    graph_.fault_limit = value_of(spec_.fault_limit).value_or(graph_.fault_limit);
    add_distributers();
    add_communicators();
    add_tasks();
    check_names();
    if (graph_.tasks.empty() && graph_.communicators.empty() && graph_.distributers.empty() && problems_.empty())
      problems_.add(spec_.where, "the graph holds no task, communicator or distributer; add a task below 'tasks:'");
    if (!connect(spec_, graph_, problems_)) complete_ = false;
    add_chains(spec_, graph_, problems_);
    if (complete_) {
      graph_.order = data_flow_order(graph_, problems_);
      set_deadlines(graph_, declared_deadlines_, problems_);
      check_heaps(graph_, problems_);
    }
    return std::move(graph_);
  }

 private:
  struct Timing {
    Duration period{};
    Duration offset{};
  };

  // Own period, else the graph's; offset below it.
  template <class S>
  Timing timing_of(const S& spec, const std::string& subject) {
    Timing timing;
    if (spec.period) {
      timing.period = spec.period->value;
      if (graph_.period && graph_.period->count() % timing.period.count() != 0)
        problems_.add(spec.period->where, subject + " has period " + duration_text(timing.period) +
                                              ", of which the graph's period " + duration_text(*graph_.period) +
                                              " is no multiple; change one of them");
    } else if (graph_.period && !spec.period.bad) {
      timing.period = *graph_.period;
    } else {
      if (!spec.period.bad && !spec_.timing.period.bad)
        problems_.add(spec.where,
                      subject + " has no period, and the graph states none; add 'period:' here or below 'timing:'");
      timing.period = Duration(1);
      complete_ = false;
      return timing;
    }
    if (spec.offset) {
      timing.offset = spec.offset->value;
      if (timing.offset >= timing.period)
        problems_.add(spec.offset->where, subject + " has offset " + duration_text(timing.offset) +
                                              " not below its period " + duration_text(timing.period));
    }
    return timing;
  }

  // The one that is stated, or null.
  const Policy* find_policy() {
    if (!spec_.platform.policy) return nullptr;
    const Yaml& yaml = spec_.platform.policy->value;
    if (!registry_.is_complete() && yaml.kind == Yaml::Kind::scalar) return registry_.find_policy(yaml.text);
    std::size_t which = 0;
    const bool known = read_choice(yaml, names_of(registry_.policies()), which, "'platform' key 'policy'", problems_);
    return known ? &registry_.policies()[which] : nullptr;
  }

  void add_distributers() {
    for (const DistributerSpec& spec : by_name(spec_.distributers)) {
      Distributer distributer{spec.name, spec.where, nullptr, spec.link ? spec.link->value : Yaml{}, {}};
      if (spec.type) {
        distributer.distributer_class = registry_.find_distributer(spec.type->value);
        if (distributer.distributer_class == nullptr) {
          const auto names = names_of(registry_.distributers());
          problems_.add(spec.type->where, "distributer '" + spec.name + "' has unknown type '" + spec.type->value +
                                              "'" + did_you_mean(spec.type->value, names) +
                                              "; there are: " + list_of(names));
        } else {
          distributer.parameters = read_parameters(spec.name, *distributer.distributer_class,
                                                   spec.parameters ? &spec.parameters->value : nullptr, problems_);
        }
      }
      graph_.distributers.push_back(std::move(distributer));
    }
  }

  void add_communicators() {
    for (const CommunicatorSpec& spec : by_name(spec_.communicators)) {
      const std::string subject = "communicator '" + spec.name + "'";
      Communicator communicator;
      communicator.name = spec.name;
      communicator.where = spec.where;
      const Timing timing = timing_of(spec, subject);
      communicator.period = timing.period;
      communicator.offset = timing.offset;
      if (spec.channel) {
        resolve_channel(spec, subject, graph_, communicator, problems_);
      } else {
        resolve_type(spec, subject, communicator);
      }
      if (communicator.type == nullptr) {
        complete_ = false;
      } else if (communicator.direction == Direction::in) {
        communicator.init = Value(*communicator.type);
        if (spec.init)
          bind_value(spec.init->value, *communicator.type, "", communicator.init.data(), subject + " init", problems_);
      } else if (spec.init) {
        problems_.add(spec.init->where, subject + " is an 'out' and has an 'init'; that belongs to an 'in' only");
      }
      graph_.communicators.push_back(std::move(communicator));
    }
    check_channels(graph_, problems_);
    add_failsafe(spec_, graph_, problems_);
  }

  void resolve_type(const CommunicatorSpec& spec, const std::string& subject, Communicator& communicator) {
    if (!spec.type || !spec.direction) {
      if (!spec.type.bad && !spec.direction.bad && !spec.channel.bad)
        problems_.add(spec.where,
                      subject + " has no channel; add 'channel: distributer.channel', or both 'type' and 'direction'");
      return;
    }
    communicator.direction = spec.direction->value;
    communicator.type = registry_.find_type(spec.type->value);
    if (communicator.type == nullptr && registry_.is_complete())
      problems_.add(spec.type->where, subject + " has unknown type '" + spec.type->value + "'" +
                                          did_you_mean(spec.type->value, registry_.type_names()) +
                                          "; there are: " + list_of(registry_.type_names()));
  }

  void add_tasks() {
    graph_.tasks.reserve(spec_.tasks.size());
    for (const TaskSpec& spec : by_name(spec_.tasks)) {
      Task task;
      task.name = spec.name;
      task.where = spec.where;
      std::string subject = "task '" + spec.name + "'";
      const Timing timing = timing_of(spec, subject);
      task.period = timing.period;
      task.offset = timing.offset;
      task.let = value_of(spec.let);
      task.wcet = value_of(spec.wcet);
      task.jitter = value_of(spec.jitter).value_or(Duration{});
      task.blocking = value_of(spec.blocking).value_or(Duration{});
      task.priority = value_of(spec.priority);
      task.core = value_of(spec.core);
      if (spec.on_fault) task.on_fault = spec.on_fault->value;
      if (spec.fault_limit) task.fault_limit = spec.fault_limit->value;
      if (spec.fault_limit && task.on_fault == OnFault::stop && !spec.on_fault.bad)
        problems_.add(spec.fault_limit->where,
                      subject +
                          " has a 'fault_limit', but its first fault stops the run; with it belongs 'on_fault: "
                          "hold', 'skip' or 'restart'");
      if (spec.isolation) task.isolation = spec.isolation->value;
      if (task.let && !spec.period.bad && *task.let > task.period)
        problems_.add(spec.let->where, subject + " has LET " + duration_text(*task.let) + " longer than its period " +
                                           duration_text(task.period));
      if (task.core && *task.core >= graph_.platform.cores)
        problems_.add(spec.core->where, subject + " is on core " + std::to_string(*task.core) +
                                            ", but the platform has " + std::to_string(graph_.platform.cores) +
                                            " (counted from 0)");
      resolve_task_class(spec, subject, task);
      if (spec.heap) {
        constexpr auto max = static_cast<std::int64_t>(largest_heap), min = static_cast<std::int64_t>(smallest_heap);
        const bool too_small = spec.heap->value > 0 && spec.heap->value < min;
        if (too_small)
          problems_.add(spec.heap->where, subject + " has a heap of " + std::to_string(spec.heap->value) +
                                              "B, which is too small; the minimum is " + std::to_string(min) +
                                              "B, the default 64KiB");
        if (spec.heap->value > max)
          problems_.add(spec.heap->where, subject + " has a heap of more than 1GiB, the maximum");
        task.heap = too_small ? default_heap : static_cast<std::size_t>(std::min(spec.heap->value, max));
        if (heaps_ <= max && heaps_ + spec.heap->value > max && spec.heap->value <= max)
          problems_.add(spec.heap->where, subject +
                                              " has a heap with which those of all tasks exceed 1GiB together, "
                                              "the maximum");
        heaps_ += std::min(spec.heap->value, max);
      } else if (task.task_class != nullptr && task.task_class->is_deep()) {
        task.heap = default_heap;
      }
      declared_deadlines_.push_back(spec.deadline);
      graph_.tasks.push_back(std::move(task));
    }
  }

  void resolve_task_class(const TaskSpec& spec, std::string subject, Task& task) {
    if (spec.type) {
      task.task_class = registry_.find_task(spec.type->value);
      if (task.task_class == nullptr && registry_.is_complete()) {
        const auto names = names_of(registry_.tasks());
        problems_.add(spec.type->where, subject + " has unknown type '" + spec.type->value + "'" +
                                            did_you_mean(spec.type->value, names) + "; there are: " + list_of(names));
      }
    }
    if (task.task_class == nullptr) {
      complete_ = false;
      return;
    }
    subject += " (" + task.task_class->name + ")";
    task.parameters =
        read_parameters(spec.name, *task.task_class, spec.parameters ? &spec.parameters->value : nullptr, problems_);
    task.out = Value(*task.task_class->out);
    if (spec.init) bind_fields(spec.init->value, *task.task_class->out, task.out.data(), subject, "output", problems_);
  }

  void check_names() {
    for (const Communicator& c : graph_.communicators)
      for (const Task& t : graph_.tasks)
        if (t.name == c.name)
          problems_.add(c.where, "communicator '" + c.name + "' has the name of a task; names are unique among both",
                        {{t.where, "the task"}});
  }

  const GraphSpec& spec_;
  const Registry& registry_;
  Problems& problems_;
  Graph graph_;
  std::vector<Maybe<Duration>> declared_deadlines_;
  std::int64_t heaps_ = 0;  // bytes of all that are stated
  bool complete_ = true;    // order and deadlines make sense
};

}  // namespace

std::string end_name(const Graph& graph, const End& end, bool output) {
  if (end.kind == End::Kind::communicator) return graph.communicators[end.index].name;
  const Task& task = graph.tasks[end.index];
  const Type& fields = output ? *task.task_class->out : *task.task_class->in;
  return task.name + "." + fields.fields[end.field].name;
}

Graph build_graph(const GraphSpec& spec, const Registry& registry, Problems& problems) {
  return Builder(spec, registry, problems).build();
}

}  // namespace jarol
