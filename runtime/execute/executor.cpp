#include "runtime/execute/executor.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <thread>

#include "graph/floating_point.h"
#include "runtime/execute/channels_in_use.h"
#include "runtime/execute/expectations.h"
#include "runtime/execute/finite.h"
#include "runtime/execute/publish.h"
#include "runtime/machine/running_task.h"

namespace jarol {
namespace {

// Communicators are in order of name in the graph, so their index tells it; few are due at once.
void sort_by_name(std::vector<const CommunicatorAction*>& actions) {
  if (actions.size() < 2) return;
  std::sort(actions.begin(), actions.end(),
            [](const auto* a, const auto* b) { return a->communicator < b->communicator; });
}

// False also where a closer look has to tell.
inline bool are_finite(const LetOutputs& outputs) {
  for (const LetValue& v : outputs.values)
    if (!v.finite(v.value)) return false;
  const Range<double>& doubles = outputs.doubles;
  return doubles.first == doubles.last || are_surely_finite(doubles.first, doubles.last);
}

// Where the vehicle may be brought to rest, what that hangs on.
std::span<const expect::Signal> tapped_signals(const Graph& graph, const ExecutorOptions& options) {
  if (options.clock == nullptr || !graph.at_end) return {};
  return graph.at_end->until.signals;
}

// More than there are processors never pay.
std::size_t useful_workers(std::size_t wanted, Sharing sharing) {
  if (sharing == Sharing::always) return wanted;
  return std::min<std::size_t>(wanted, std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

Executor::Executor(PlanOfRun plan, std::vector<std::unique_ptr<Channels>> channels, const ExecutorOptions& options)
    : shared_plan_(std::move(plan)),
      plan_(*shared_plan_),
      graph_(plan_.graph),
      state_(plan_, tapped_signals(graph_, options)),
      channels_(std::move(channels)),
      options_(options),
      safe_commands_(graph_) {
  const Graph& graph = graph_;
  assert(channels_.size() == graph.distributers.size());
  if (options.recorder != nullptr) options.recorder->expect(plan_.outputs);
  if (options.log != nullptr) begin_log();
  assert(!options.misses || (options.clock == nullptr && options.workers == 1));
  if (options.clock != nullptr)
    for (Recorder* recorder : {options.recorder, options.log})
      if (recorder != nullptr) recorder->never_wait();
  if (options.misses) missed_ = std::make_unique<MissedActivations>(graph.tasks.size(), *options.misses);
  if (!options.threads.empty()) begin_threads();
  if (options.workers > 1 || options.sharing == Sharing::measure) {
    bad_items_.reserve(graph.tasks.size());
    team_ = std::make_unique<StageTeam>(useful_workers(options.workers, options.sharing), options.sharing, plan_);
  }
  for (const std::size_t distributer : watched_vehicles(graph))
    if (const Type* type = channels_[distributer]->true_type();
        type != nullptr && options.record_truth && options.recorder != nullptr)
      watched_.push_back({distributer, Value(*type)});
  if (options.clock != nullptr && graph.at_end) rest_ = std::make_unique<Rest>(state_, channels_);
  const std::size_t groups = plan_.groups.size();
  cursors_.resize(groups);
  in_stage_.resize(groups);
  ticks_.resize(groups);
  outs_.reserve(graph.communicators.size());
  ins_.reserve(graph.communicators.size());
  report_.left_out.resize(graph.tasks.size());
}

namespace {
// The calling thread covers instants while this lives.
struct RunningHere {
  explicit RunningHere(std::atomic<const RunningTask*>& to) : running(to) { running.store(&running_task); }
  ~RunningHere() { running.store(nullptr); }
  std::atomic<const RunningTask*>& running;
};
}  // namespace

void Executor::run_until(Duration end) {
  try {
    cover(end);
  } catch (...) {
    // an external system is lost; what was released before is part of the run
    finish();
    throw;
  }
  finish();
}

void Executor::cover(Duration end) {
  if (report_.stopped && missed_ == nullptr) return;
  cover_end_.store(end.count(), std::memory_order_relaxed);
  const MemoryScope scope(no_heap());  // a task with a heap has a scope of its own
  const RunningHere here(running_);
  const DefaultFloatingPoint arithmetic;
  const bool record = options_.recorder != nullptr;
  if (options_.clock != nullptr || missed_ != nullptr) {
    record ? walk<true, true, true>(end) : walk<true, false, true>(end);
  } else if (options_.digest) {
    record ? walk<true, true, false>(end) : walk<true, false, false>(end);
  } else {
    record ? walk<false, true, false>(end) : walk<false, false, false>(end);
  }
}

template <bool Digest, bool Record, bool MayMiss>
void Executor::walk(Duration end) {
  while (state_.calendar.next() < end.count()) {
    if (must_return()) return;
    const std::int64_t instant = state_.calendar.next();
    if (MayMiss && missed_ == nullptr) {
      options_.clock->wait_until(instant, interrupted_);
      if (must_return()) return;
      if (threads_ != nullptr) settle(instant);
      if (report_.stopped) return;
    }
    if (options_.log != nullptr && instant >= checkpoint_due_) log_checkpoint(instant);
    now_.store(instant, std::memory_order_relaxed);
    due_ = state_.calendar.take();
    const bool done = step_instant<Digest, Record, MayMiss>(instant);
    if (!done) return;
    report_.instants += 1;
    report_.simulated = Duration(instant);
    report_.covered = Duration(instant + 1);
    if (report_.stopped && missed_ == nullptr) return;
    if (MayMiss && resting() && rest_->is_reached(safe_commands_, Duration(instant))) {
      rest_reached_ = true;
      return;
    }
  }
  report_.simulated = end;
  report_.covered = end;
  now_.store(end.count(), std::memory_order_relaxed);
}

// False: the run was closed before anything of the instant took place.
template <bool Digest, bool Record, bool MayMiss>
bool Executor::step_instant(std::int64_t instant) {
  const std::uint64_t instant_term = Digest ? digest::instant_term(instant) : 0;
  if (!state_.last.empty()) gather_communicators();
  ChannelsInUse channels_in_use(outs_.empty() && ins_.empty() ? nullptr : &use_);
  if (channels_in_use.closed()) return false;
  // step 0: external systems reach this instant with the inputs they held before it
  if (!outs_.empty() || !ins_.empty()) {
    const MemoryScope outside(nullptr);
    for (const auto& channels : channels_) channels->reach(Duration(instant));
    if constexpr (Record)
      if (!watched_.empty()) record_true_values(instant);
  }
  // step 1: outputs of LET tasks that end now
  for (const std::uint32_t g : due_) {
    const Plan::Group& group = plan_.groups[g];
    if (group.let_ends.count == 0) continue;
    const LetOutputs& outputs = state_.let_outputs[g];
    if (MayMiss && threads_ != nullptr) {
      for (const LetEnd& let_end : group.let_ends.of(state_.let_ends)) end_let(let_end, instant);
    } else if (state_.bad_outcomes == 0 && are_finite(outputs)) [[likely]] {
      publish<Digest, Record>(outputs.publish, instant, instant_term);
    } else {
      publish_one_by_one<Digest, Record>(group, instant, instant_term);
    }
  }
  // steps 2 and 3: communicators, by name
  for (const CommunicatorAction* out : outs_) {
    hand_over(*out, Duration(instant));
    publish<Digest, Record>(out->publish, instant, instant_term);
  }
  for (const CommunicatorAction* in : ins_) {
    take(*in, Duration(instant));
    publish<Digest, Record>(in->publish, instant, instant_term);
  }
  channels_in_use.end();
  // step 4: tasks released now
  if (MayMiss && threads_ != nullptr) {
    release_on_threads(instant);
  } else if (team_ != nullptr && team_->may_share(due_)) {
    run_stages_shared<Digest, Record>(instant, instant_term);
  } else if (due_.size() == 1) {
    const Plan::Group& group = plan_.groups[due_[0]];
    const Tick tick{Duration(instant), state_.releases[due_[0]]++, group.period};
    for (const Plan::Segment& segment : plan_.segments_of(group))
      run_segment<Digest, Record, MayMiss>(segment, tick, instant_term);
    report_.activations += group.tasks.count;
  } else {
    run_stages<Digest, Record, MayMiss>(instant, instant_term);
  }
  return true;
}

// As a LET task among those that are under way has a fault, or may have one.
template <bool Digest, bool Record>
void Executor::publish_one_by_one(const Plan::Group& group, std::int64_t instant, std::uint64_t instant_term) {
  for (const LetEnd& let_end : group.let_ends.of(state_.let_ends)) {
    Outcome& outcome = state_.outcomes[let_end.task];
    if (outcome == Outcome::good && has_late_fault(let_end, instant)) {
      record_fault(let_end.task, instant);
    } else if (outcome == Outcome::good) {
      publish<Digest, Record>(let_end.publish, instant, instant_term);
    } else {
      if (outcome != Outcome::left_out) record_fault(let_end.task, instant);
      outcome = Outcome::good;  // at most one activation waits for its end
      --state_.bad_outcomes;
    }
  }
}

// The communicators due now, by name.
void Executor::gather_communicators() {
  outs_.clear();
  ins_.clear();
  for (const std::uint32_t g : due_) {
    for (const CommunicatorAction& action : plan_.groups[g].outs.of(state_.outs)) outs_.push_back(&action);
    for (const CommunicatorAction& action : plan_.groups[g].ins.of(state_.ins)) ins_.push_back(&action);
  }
  sort_by_name(outs_);
  sort_by_name(ins_);
}

void Executor::record_true_values(std::int64_t instant) {
  for (WatchedVehicle& vehicle : watched_) {
    channels_[vehicle.distributer]->copy_true_values(vehicle.values.data());
    const auto output = static_cast<std::uint32_t>(plan_.outputs.size() + vehicle.distributer);
    record(*options_.recorder, output, *vehicle.values.type(), vehicle.values.data(), instant);
  }
}

void Executor::start_groups(std::int64_t instant) {
  for (std::size_t i = 0; i < due_.size(); ++i) {
    const Plan::Group& group = plan_.groups[due_[i]];
    const std::span<const Plan::Segment> segments = plan_.segments_of(group);
    cursors_[i] = {segments.data(), segments.data() + segments.size()};
    ticks_[i] = {Duration(instant), state_.releases[due_[i]]++, group.period};
    report_.activations += group.tasks.count;
  }
}

// Several groups: the segments of the lowest stage of all, then those of the next.
template <bool Digest, bool Record, bool MayMiss>
void Executor::run_stages(std::int64_t instant, std::uint64_t instant_term) {
  start_groups(instant);
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t stage = 0; stage != none;) {
    std::uint32_t next = none;
    for (std::size_t i = 0; i < due_.size(); ++i) {
      Cursor& cursor = cursors_[i];
      if (cursor.next != cursor.last && cursor.next->stage == stage)
        run_segment<Digest, Record, MayMiss>(*cursor.next++, ticks_[i], instant_term);
      if (cursor.next != cursor.last) next = std::min(next, cursor.next->stage);
    }
    stage = next;
  }
}

// The same by several workers, stage by stage.
template <bool Digest, bool Record>
void Executor::run_stages_shared(std::int64_t instant, std::uint64_t instant_term) {
  start_groups(instant);
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t stage = 0; stage != none;) {
    std::uint32_t next = none;
    std::uint32_t levels = 0;
    std::size_t segments = 0;
    bool deep = false;
    for (std::size_t i = 0; i < due_.size(); ++i) {
      Cursor& cursor = cursors_[i];
      in_stage_[i] = cursor.next != cursor.last && cursor.next->stage == stage ? cursor.next++ : nullptr;
      if (in_stage_[i] != nullptr) {
        ++segments;
        deep = deep || in_stage_[i]->publishes_deep;
        levels = std::max(levels, in_stage_[i]->levels.count);
      }
      if (cursor.next != cursor.last) next = std::min(next, cursor.next->stage);
    }
    if (deep && segments > 1) {  // a reader's heap tells which of its producers came first
      for (std::size_t i = 0; i < due_.size(); ++i)
        if (in_stage_[i] != nullptr) run_segment<Digest, Record, false>(*in_stage_[i], ticks_[i], instant_term);
    } else {
      for (std::uint32_t level = 0; level < levels; ++level) run_level_shared<Digest, Record>(level, instant_term);
      tell_bad_outcomes();
    }
    stage = next;
  }
}

// The tasks of one level of all segments of the stage: none feeds another.
template <bool Digest, bool Record>
void Executor::run_level_shared(std::uint32_t level, std::uint64_t instant_term) {
  team_->clear();
  for (std::size_t i = 0; i < due_.size(); ++i) {
    const Plan::Segment* const segment = in_stage_[i];
    if (segment == nullptr || level >= segment->levels.count) continue;
    const Indices& tasks = plan_.levels[segment->levels.first + level];
    for (const Activation& activation : tasks.of(state_.activations)) team_->add(activation, ticks_[i]);
  }
  report_.digest += team_->run(Digest, instant_term);
  for (const StageTeam::Item& item : team_->items()) {
    const std::int64_t instant = item.tick->now.count();
    if (item.outcome != Outcome::good) {
      bad_items_.push_back(item);
    } else if (item.activation->publishes_deep) {
      publish<Digest, Record>(item.activation->publish, instant, instant_term);
    } else if constexpr (Record) {
      record(*options_.recorder, item.activation->publish, instant);
    }
  }
}

// In the order in which one worker would have seen them, which is that of the plan.
void Executor::tell_bad_outcomes() {
  std::sort(bad_items_.begin(), bad_items_.end(),
            [](const StageTeam::Item& a, const StageTeam::Item& b) { return a.activation < b.activation; });
  for (const StageTeam::Item& item : bad_items_) on_bad_outcome(*item.activation, item.outcome, *item.tick);
  bad_items_.clear();
}

template <bool Digest, bool Record, bool MayMiss>
void Executor::run_segment(const Plan::Segment& segment, const Tick& tick, std::uint64_t instant_term) {
  running_task.tick.store(&tick, std::memory_order_relaxed);
  const Activation* next = state_.activations.data() + segment.tasks.first;
  const Activation* const last = next + segment.tasks.count;
  while (next != last) {
    if (!MayMiss && next->body != nullptr) {
      next = run_bodies(next, last, tick);
      continue;
    }
    const Activation& activation = *next++;
    running_task.next(activation.memory);
    const Outcome outcome = MayMiss ? run_in_time(activation, tick) : activation.run(activation.memory, tick);
    if (outcome == Outcome::good) [[likely]] {
      if (!activation.has_let) publish<Digest, Record>(activation.publish, tick.now.count(), instant_term);
    } else {
      on_bad_outcome(activation, outcome, tick);
    }
  }
  running_task.end();
}

// Those in a row that are checked at the ends of their LETs; returns the first that is not one. What one throws ends
// its own activation alone.
const Activation* Executor::run_bodies(const Activation* next, const Activation* last, const Tick& tick) {
  while (next != last && next->body != nullptr) {
    const Outcome outcome = contain(
        [&] {
          for (; next != last && next->body != nullptr; ++next) {
            running_task.next(next->memory);
            next->body(next->memory, tick);
          }
        },
        [&]() -> FaultText& { return *next->memory.fault; });
    if (outcome != Outcome::good) on_bad_outcome(*next++, outcome, tick);
  }
  return next;
}

template <bool Digest, bool Record>
inline void Executor::publish(const Publish& what, std::int64_t instant, std::uint64_t instant_term) {
  report_.digest += make_visible<Digest>(what, instant_term);
  if constexpr (Record) record(*options_.recorder, what, instant);
}

void Executor::hand_over(const CommunicatorAction& out, Duration instant) {
  const Communicator& communicator = graph_.communicators[out.communicator];
  const void* const safe = safe_commands_.in_place_of_input(out.communicator, instant);
  copy_value(*communicator.type, out.value, safe != nullptr ? safe : out.input);
  const MemoryScope outside(nullptr);
  if (communicator.distributer) channels_[*communicator.distributer]->hand_over(communicator.channel, out.value);
}

void Executor::take(const CommunicatorAction& in, Duration instant) {
  const Communicator& communicator = graph_.communicators[in.communicator];
  if (!communicator.distributer) return;
  const MemoryScope outside(nullptr);
  const bool over = resting() && rest_->is_mission(*communicator.distributer);
  bool fresh = !over && channels_[*communicator.distributer]->take(communicator.channel, in.taken);
  if (fresh && !communicator.type->finite(in.taken)) {
    ++refused_inputs_;
    fresh = false;
  }
  if (fresh) copy_value(*communicator.type, in.value, in.taken);
  const bool commanded = resting() && rest_->command(in.communicator, in.value);
  if (!fresh && !commanded) return;
  safe_commands_.took(in.communicator, instant);
  if (options_.log != nullptr)
    record(*options_.log, log_outputs_[in.communicator], *communicator.type, in.value, instant.count());
}

// On the real clock: an activation that ends after its deadline has a fault, and so have those whose releases fall into
// the time that it took.
Outcome Executor::run_in_time(const Activation& activation, const Tick& tick) {
  if (missed_ != nullptr) return run_as_logged(activation, tick);
  TaskTiming& timing = options_.clock->timing(activation.task);
  if (timing.busy_until > tick.now.count()) {
    ++timing.left_out;
    return Outcome::overrun;
  }
  const std::int64_t begin = options_.clock->now();
  const Outcome outcome = activation.run(activation.memory, tick);
  if (outcome == Outcome::left_out) return outcome;
  const std::int64_t end = options_.clock->now();
  timing.busy_until = end;
  timing.execution.add(end - begin);
  timing.response.add(end - tick.now.count());
  if (outcome != Outcome::good || end - tick.now.count() <= graph_.tasks[activation.task].deadline.count())
    return outcome;
  ++timing.late;
  ended_after_ = Duration(end - tick.now.count());
  return Outcome::late;
}

// What was late or left out has the same effect whether it runs or not.
Outcome Executor::run_as_logged(const Activation& activation, const Tick& tick) {
  const Miss* const miss = missed_->find(activation.task, tick.activation);
  if (miss == nullptr) return activation.run(activation.memory, tick);
  if (miss->left_out != 0) return Outcome::overrun;
  ended_after_ = miss->ended_after == Miss::unknown ? std::nullopt : std::optional(Duration(miss->ended_after));
  return Outcome::late;
}

}  // namespace jarol
