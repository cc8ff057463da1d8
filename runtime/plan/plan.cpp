#include "runtime/plan/plan.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <new>
#include <optional>
#include <tuple>

#include "graph/model/stages.h"
#include "runtime/plan/layout.h"

namespace jarol {
namespace {

// Runs a task that has a heap: what it allocates meanwhile is scratch.
Outcome run_with_heap(TaskStatus& status, const TaskMemory& memory, const Tick& tick) {
  for (const DeepInput& input : status.deep_inputs) {
    if (!input.lost) continue;
    static_cast<FaultText&>(status) = input;
    return Outcome::heap_exhausted;
  }
  const MemoryScope scope(status.heap->scratch());
  const Outcome outcome = status.run(memory, tick);
  status.heap->release_scratch();
  return outcome;
}

// Runs a task that has a heap or may have to be undone: what to undo is kept until the executor has seen the outcome.
Outcome run_with_care(const TaskMemory& memory, const Tick& tick) {
  auto& status = static_cast<TaskStatus&>(*memory.fault);
  if (status.skip_next) {
    status.skip_next = false;
    return Outcome::left_out;
  }
  if (status.undoable) status.keep(memory.state);
  return status.heap != nullptr ? run_with_heap(status, memory, tick) : status.run(memory, tick);
}

template <class T>
Range<T> range(const std::vector<T>& all, std::size_t first) {
  return {all.data() + first, all.data() + all.size()};
}

template <class T>
ShortRange<T> short_range(const std::vector<T>& all, std::size_t first) {
  return {all.data() + first, static_cast<std::uint32_t>(all.size() - first)};
}

}  // namespace

class PlanBuilder {
 public:
  PlanBuilder(const Graph& graph, Plan& plan, bool for_rest) : graph_(graph), plan_(plan), for_rest_(for_rest) {}

  void build() {
    sort_connections();
    stages_ = stages_of(graph_);
    group_deadlines_ = group_deadlines(graph_);
    lay_out();
    fill();
    name_outputs();
    make_groups();
  }

 private:
  using GroupKey = std::tuple<Duration, Duration, Duration>;  // least deadline of its tasks, period, first instant

  void sort_connections() {
    from_task_.resize(graph_.tasks.size());
    from_communicator_.resize(graph_.communicators.size());
    for (const Connection& c : graph_.connections)
      (c.from.kind == End::Kind::task ? from_task_ : from_communicator_)[c.from.index].push_back(&c);
  }

  // Without tasks a group has none, and its place among the others does not matter.
  Duration deadline_of_group(Duration period, Duration first) const {
    const auto found = group_deadlines_.find({period, first});
    return found == group_deadlines_.end() ? Duration::max() : found->second;
  }

  // Tasks of one group lie in the order in which they run.
  std::vector<std::size_t> execution_order() const {
    std::vector<std::size_t> order = turns_of(graph_);
    std::vector<Duration> deadlines;
    for (const Task& task : graph_.tasks) deadlines.push_back(deadline_of_group(task.period, task.offset));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const Task &s = graph_.tasks[a], &t = graph_.tasks[b];
      return std::tie(deadlines[a], s.period, s.offset) < std::tie(deadlines[b], t.period, t.offset);
    });
    return order;
  }

  void lay_out() {
    order_ = execution_order();
    layout_.emplace(graph_, order_);
    plan_.arena_.reset(static_cast<std::byte*>(::operator new (layout_->size, std::align_val_t{Layout::line})));
    std::memset(plan_.arena_.get(), 0, layout_->size);
  }

  std::byte* at(std::size_t place) const { return plan_.arena_.get() + place; }

  const std::byte* source_of(const Connection& c) const {
    if (c.from.kind == End::Kind::communicator) return at(layout_->communicators[c.from.index].value);
    const TaskClass& task_class = *graph_.tasks[c.from.index].task_class;
    return at(layout_->tasks[c.from.index].out) + task_class.out->fields[c.from.field].offset;
  }

  std::byte* target_of(const Connection& c) const {
    if (c.to.kind == End::Kind::communicator) return at(layout_->communicators[c.to.index].input);
    const TaskClass& task_class = *graph_.tasks[c.to.index].task_class;
    return at(layout_->tasks[c.to.index].in) + task_class.in->fields[c.to.field].offset;
  }

  // Initial values; each input begins with what its source reads as until first published.
  void fill() {
    plan_.status.resize(graph_.tasks.size());
    plan_.outcomes.resize(graph_.tasks.size(), Outcome::good);
    plan_.heaps.resize(graph_.tasks.size());
    for (std::size_t i = 0; i < graph_.tasks.size(); ++i) fill_task(i);
    for (std::size_t i = 0; i < graph_.communicators.size(); ++i) {
      const Communicator& c = graph_.communicators[i];
      for (const std::size_t place :
           {layout_->communicators[i].value, layout_->communicators[i].input, layout_->communicators[i].taken})
        make(*c.type, place, &plan_.communicator_memory_);
      if (c.direction == Direction::in) copy_value(*c.type, at(layout_->communicators[i].value), c.init.data());
    }
    for (const Connection& c : graph_.connections) copy_value(*c.type, target_of(c), source_of(c));
    make_deep_inputs();
    make_taps();
  }

  const std::vector<expect::Signal>& tapped() const {
    static const std::vector<expect::Signal> none;
    return for_rest_ && graph_.at_end ? graph_.at_end->until.signals : none;
  }

  static constexpr std::byte published_{1};

  Copy tap_of(std::size_t i) const {
    const expect::Signal& signal = tapped()[i];
    const End& end = *signal.published;
    const std::byte* from =
        end.kind == End::Kind::communicator
            ? at(layout_->communicators[end.index].value)
            : at(layout_->tasks[end.index].out) + graph_.tasks[end.index].task_class->out->fields[end.field].offset;
    return {from + signal.leaf.offset, plan_.taps[i], signal.leaf.type->size};
  }

  void make_taps() {
    plan_.tap_memory_.resize(tapped().size());
    plan_.tap_news.resize(tapped().size());
    for (std::size_t i = 0; i < tapped().size(); ++i) {
      plan_.taps.push_back(reinterpret_cast<std::byte*>(&plan_.tap_memory_[i]));
      const Copy tap = tap_of(i);
      std::memcpy(tap.to, tap.from, tap.size);
    }
  }

  // What is published there is looked at, as by a reader.
  void add_taps(End::Kind kind, std::size_t index) {
    for (std::size_t i = 0; i < tapped().size(); ++i)
      if (tapped()[i].published->kind == kind && tapped()[i].published->index == index)
        plan_.copies_.insert(plan_.copies_.end(), {tap_of(i), {&published_, &plan_.tap_news[i], 1}});
  }

  void fill_task(std::size_t i) {
    const Task& task = graph_.tasks[i];
    const TaskClass& c = *task.task_class;
    TaskStatus& status = plan_.status[i];
    if (has_heap(task)) {
      plan_.heaps[i] = std::make_unique<PrivateHeap>(at(layout_->tasks[i].heap), task.heap);
      status.heap = plan_.heaps[i].get();
    }
    make(*c.parameters, layout_->tasks[i].parameters, std::pmr::new_delete_resource());
    make_private(*c.out, layout_->tasks[i].out, status.heap);
    copy_value(*c.parameters, at(layout_->tasks[i].parameters), task.parameters.data());
    copy_value(*c.out, at(layout_->tasks[i].out), task.out.data());
    make_private(*c.state, layout_->tasks[i].state, status.heap);
    make_private(*c.in, layout_->tasks[i].in, status.heap);
    status.task = static_cast<std::uint32_t>(i);
    status.undoable = is_undoable(task);
    status.run = c.run;
    if (!status.undoable) return;
    status.kept = at(layout_->tasks[i].kept);
    status.size = layout_->undoable_size(graph_, i);
  }

  // A default value whose deep parts go with the heap that they live in.
  void make_private(const Type& type, std::size_t place, PrivateHeap* heap) {
    type.construct(at(place));
    if (type.is_deep()) type.adopt(at(place), heap->values());
  }

  // A default value in memory that wants it back.
  void make(const Type& type, std::size_t place, std::pmr::memory_resource* memory) {
    type.construct(at(place));
    if (!type.is_deep()) return;
    type.adopt(at(place), memory);
    plan_.owned_.push_back({at(place), {&type}});
  }

  // Connections are in order of their readers, so that each reader's lie side by side.
  void make_deep_inputs() {
    const auto into_task = [](const Connection& c) { return c.type->is_deep() && c.to.kind == End::Kind::task; };
    const auto count = std::count_if(graph_.connections.begin(), graph_.connections.end(), into_task);
    plan_.deep_inputs_.resize(static_cast<std::size_t>(count));
    DeepInput* next = plan_.deep_inputs_.data();
    for (const Connection& c : graph_.connections) {
      if (!into_task(c)) continue;
      Range<DeepInput>& inputs = plan_.status[c.to.index].deep_inputs;
      if (inputs.first == nullptr) inputs.first = next;
      deep_input_[&c] = next++;
      inputs.last = next;
    }
  }

  void add_copy(const Connection& c) {
    if (!c.type->is_deep()) {
      plan_.copies_.push_back({source_of(c), target_of(c), c.type->size});
      return;
    }
    const auto input = deep_input_.find(&c);
    plan_.deep_copies_.push_back({c.type, source_of(c), input == deep_input_.end() ? nullptr : input->second});
    plan_.copies_.push_back({&plan_.deep_copies_.back(), target_of(c), 0});
  }

  void name_outputs() {
    for (std::size_t i = 0; i < graph_.tasks.size(); ++i) {
      const auto& fields = graph_.tasks[i].task_class->out->fields;
      for (std::size_t f = 0; f < fields.size(); ++f)
        plan_.outputs.push_back({end_name(graph_, {End::Kind::task, i, f}, true), fields[f].type});
    }
    for (const Communicator& c : graph_.communicators) plan_.outputs.push_back({c.name, c.type});
    std::sort(plan_.outputs.begin(), plan_.outputs.end(),
              [](const Output& a, const Output& b) { return a.name < b.name; });
    for (std::uint32_t i = 0; i < plan_.outputs.size(); ++i) output_index_[plan_.outputs[i].name] = i;
    // ranges point into these: they never grow beyond what is reserved here
    std::size_t publications = plan_.outputs.size();
    plan_.copies_.reserve(graph_.connections.size() + 2 * tapped().size());
    plan_.deep_copies_.reserve(graph_.connections.size());
    plan_.publications_.reserve(publications);
    plan_.activations_.reserve(graph_.tasks.size());
    plan_.let_ends_.reserve(graph_.tasks.size());
    plan_.let_values_.reserve(graph_.tasks.size());
    plan_.outs_.reserve(graph_.communicators.size());
    plan_.ins_.reserve(graph_.communicators.size());
    plan_.segments_.reserve(graph_.tasks.size());
    plan_.levels_.reserve(graph_.tasks.size());
  }

  Publication publication(const std::string& name, const Type& type, const std::byte* value) const {
    return {value, digest::name_hash(name), type.hash_words, output_index_.at(name),
            type.is_deep() ? 0 : static_cast<std::uint32_t>(type.size)};
  }

  Publish publish_task(std::size_t i) {
    const std::size_t first_copy = plan_.copies_.size(), first_publication = plan_.publications_.size();
    for (const Connection* c : from_task_[i]) add_copy(*c);
    add_taps(End::Kind::task, i);
    const auto& fields = graph_.tasks[i].task_class->out->fields;
    for (std::size_t f = 0; f < fields.size(); ++f)
      plan_.publications_.push_back(publication(end_name(graph_, {End::Kind::task, i, f}, true), *fields[f].type,
                                                at(layout_->tasks[i].out) + fields[f].offset));
    return {short_range(plan_.copies_, first_copy), short_range(plan_.publications_, first_publication)};
  }

  CommunicatorAction communicator_action(std::size_t i) {
    const Communicator& c = graph_.communicators[i];
    const std::size_t first_copy = plan_.copies_.size(), first_publication = plan_.publications_.size();
    for (const Connection* s : from_communicator_[i]) add_copy(*s);
    add_taps(End::Kind::communicator, i);
    plan_.publications_.push_back(publication(c.name, *c.type, at(layout_->communicators[i].value)));
    return {static_cast<std::uint32_t>(i),
            at(layout_->communicators[i].value),
            at(layout_->communicators[i].input),
            at(layout_->communicators[i].taken),
            {short_range(plan_.copies_, first_copy), short_range(plan_.publications_, first_publication)}};
  }

  Activation activation(std::size_t i) {
    const Task& task = graph_.tasks[i];
    return {is_undoable(task) || has_heap(task) ? &run_with_care : task.task_class->run,
            is_checked_at_let_end(task) ? task.task_class->body : nullptr,
            {at(layout_->tasks[i].parameters), at(layout_->tasks[i].in), at(layout_->tasks[i].state),
             at(layout_->tasks[i].out), &plan_.status[i]},
            task.let ? Publish{} : publish_task(i),
            static_cast<std::uint32_t>(i),
            connections_of(i),
            task.let.has_value(),
            std::any_of(from_task_[i].begin(), from_task_[i].end(),
                        [](const Connection* c) { return c->type->is_deep(); })};
  }

  std::uint32_t connections_of(std::size_t i) const {
    const std::size_t out = graph_.tasks[i].let ? 0 : from_task_[i].size();
    return static_cast<std::uint32_t>(graph_.tasks[i].task_class->in->fields.size() + out);
  }

  // Appends to the newest segment and level, or begins new ones.
  void add_to_segment(std::size_t task, const std::size_t* before, Range<Activation> activation) {
    const bool same_stage = before != nullptr && stages_.stage[*before] == stages_.stage[task];
    if (!same_stage) plan_.segments_.push_back({stages_.stage[task], false, {activation.first, nullptr}, {}});
    if (!same_stage || stages_.level[*before] != stages_.level[task])
      plan_.levels_.push_back({activation.first, nullptr});
    plan_.levels_.back().last = activation.last;
    Segment& segment = plan_.segments_.back();
    segment.publishes_deep = segment.publishes_deep || activation.first->publishes_deep;
    segment.activations.last = activation.last;
    if (segment.levels.first == nullptr) segment.levels.first = &plan_.levels_.back();
    segment.levels.last = plan_.levels_.data() + plan_.levels_.size();
  }

  void add_let_output(Group& group, std::size_t i) {
    const Task& task = graph_.tasks[i];
    const Type& type = *task.task_class->out;
    const std::byte* out = at(layout_->tasks[i].out);
    if (has_let_doubles(task)) {
      const std::size_t lines = (type.size + Layout::line - 1) / Layout::line;
      if (group.let_doubles.first == nullptr) group.let_doubles.first = reinterpret_cast<const double*>(out);
      group.let_doubles.last = reinterpret_cast<const double*>(out + lines * Layout::line);
    } else if (is_checked_at_let_end(task) && has_floating(type)) {
      plan_.let_values_.push_back({out, type.finite});
    }
  }

  void make_groups() {
    struct Members {
      std::vector<std::size_t> let_ends, outs, ins, tasks;
    };
    std::map<GroupKey, Members> groups;
    const auto members_at = [&](Duration period, Duration first) -> Members& {
      return groups[{deadline_of_group(period, first), period, first}];
    };
    for (const std::size_t i : order_) {
      const Task& task = graph_.tasks[i];
      members_at(task.period, task.offset).tasks.push_back(i);
      if (task.let) members_at(task.period, task.offset + *task.let).let_ends.push_back(i);
    }
    for (std::size_t i = 0; i < graph_.communicators.size(); ++i) {
      const Communicator& c = graph_.communicators[i];
      Members& members = members_at(c.period, c.offset);
      (c.direction == Direction::in ? members.ins : members.outs).push_back(i);
    }
    for (const auto& [key, members] : groups) {
      Group group;
      group.period = std::get<1>(key);
      group.first = std::get<2>(key);
      group.activations = members.tasks.size();
      std::size_t first = plan_.let_ends_.size();
      const std::size_t first_copy = plan_.copies_.size(), first_publication = plan_.publications_.size();
      const std::size_t first_value = plan_.let_values_.size();
      for (const std::size_t i : members.let_ends) {
        plan_.let_ends_.push_back({publish_task(i), at(layout_->tasks[i].out), static_cast<std::uint32_t>(i)});
        add_let_output(group, i);
      }
      group.let_ends = range(plan_.let_ends_, first);
      group.let_values = range(plan_.let_values_, first_value);
      group.let_publish = {short_range(plan_.copies_, first_copy), short_range(plan_.publications_, first_publication)};
      first = plan_.outs_.size();
      for (const std::size_t i : members.outs) plan_.outs_.push_back(communicator_action(i));
      group.outs = range(plan_.outs_, first);
      first = plan_.ins_.size();
      for (const std::size_t i : members.ins) plan_.ins_.push_back(communicator_action(i));
      group.ins = range(plan_.ins_, first);
      const std::size_t first_segment = plan_.segments_.size();
      for (std::size_t m = 0; m < members.tasks.size(); ++m) {
        const std::size_t i = members.tasks[m];
        const std::size_t at = plan_.activations_.size();
        plan_.activations_.push_back(activation(i));
        add_to_segment(i, m == 0 ? nullptr : &members.tasks[m - 1],
                       {&plan_.activations_[at], &plan_.activations_[at] + 1});
      }
      group.segments = range(plan_.segments_, first_segment);
      plan_.groups.push_back(group);
    }
  }

  const Graph& graph_;
  Plan& plan_;
  bool for_rest_;
  std::vector<std::vector<const Connection*>> from_task_, from_communicator_;
  Stages stages_;
  GroupDeadlines group_deadlines_;
  std::vector<std::size_t> order_;
  std::optional<Layout> layout_;
  std::map<std::string, std::uint32_t> output_index_;
  std::map<const Connection*, DeepInput*> deep_input_;
};

void TaskStatus::keep(const void* state) {
  std::memcpy(kept, state, size);
  if (heap != nullptr) heap->keep(kept + size);
}

void TaskStatus::put_back(void* state) {
  std::memcpy(state, kept, size);
  if (heap != nullptr) heap->put_back(kept + size);
}

Plan::Plan(const Graph& graph, bool for_rest) { PlanBuilder(graph, *this, for_rest).build(); }

void Plan::Release::operator()(std::byte* memory) const { ::operator delete (memory, std::align_val_t{Layout::line}); }

}  // namespace jarol
