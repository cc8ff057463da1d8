#include "runtime/dispatch/preemptive_threads.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <future>
#include <system_error>
#include <tuple>

#include "graph/floating_point.h"
#include "graph/model/stages.h"
#include "graph/text/errors.h"
#include "graph/values/heap.h"
#include "runtime/machine/futex.h"
#include "runtime/machine/running_task.h"
#include "runtime/machine/signal_stack.h"
#include "runtime/state/copy.h"

namespace jarol {

PreemptiveThreads::PreemptiveThreads(RunState& state, RealClock& clock, std::span<const analysis::TaskThread> threads)
    : graph_(state.plan.graph), state_(state), clock_(clock), jobs_(graph_.tasks.size()), threads_(threads.size()) {
  added_.reserve(jobs_.size());
  make_jobs();
  for (std::size_t t = 0; t < threads.size(); ++t)
    for (const std::size_t task : threads[t].tasks) jobs_[task].thread = t;
  connect_followers();
  begin(threads);
}

PreemptiveThreads::~PreemptiveThreads() { end(); }

void PreemptiveThreads::end() {
  for (Thread& thread : threads_) {
    if (!thread.thread.joinable()) continue;
    give(thread, nullptr);
    let_go(thread);
    thread.thread.join();
  }
}

// The plan's inputs hold what was published last; what a job reads was latched from there.
void PreemptiveThreads::make_jobs() {
  constexpr std::size_t line = 64;
  const auto rounded = [](std::size_t size) { return (size + line - 1) / line * line; };
  std::size_t size = line;
  for (const Task& task : graph_.tasks) {
    if (task.task_class->in->is_deep())
      throw InputError("task '" + task.name +
                       "' has an input of changing size, which only one core with a table can hand over; "
                       "choose platform: {cores: 1, policy: table}");
    size += rounded(task.task_class->in->size);
  }
  latched_.resize(size);
  void* place = latched_.data();
  std::align(line, 1, place, size);
  auto* next = static_cast<std::byte*>(place);
  for (const Activation& activation : state_.activations) {
    const Task& task = graph_.tasks[activation.task];
    Job& job = jobs_[activation.task];
    job.task = activation.task;
    job.run = activation.run;
    job.memory = activation.memory;
    job.memory.in = job.latched = next;
    job.published = static_cast<const std::byte*>(activation.memory.in);
    job.in_size = task.task_class->in->size;
    job.deadline = task.deadline;
    next += rounded(job.in_size);
  }
  const std::vector<std::size_t> turns = dispatch_order(graph_);
  for (std::size_t turn = 0; turn < turns.size(); ++turn) jobs_[turns[turn]].turn = turn;
}

void PreemptiveThreads::connect_followers() {
  for (const Connection& c : graph_.connections) {
    if (c.from.kind != End::Kind::task || c.to.kind != End::Kind::task || graph_.tasks[c.from.index].let) continue;
    Job &from = jobs_[c.from.index], &to = jobs_[c.to.index];
    auto follower = std::find_if(from.followers.begin(), from.followers.end(),
                                 [&](const Follower& known) { return known.job == &to; });
    if (follower == from.followers.end()) {
      follower = from.followers.insert(follower, Follower{&to, from.thread != to.thread, {}});
      if (follower->elsewhere) to.producers.push_back(&from);
    }
    const TypeField& output = graph_.tasks[c.from.index].task_class->out->fields[c.from.field];
    const TypeField& input = graph_.tasks[c.to.index].task_class->in->fields[c.to.field];
    follower->copies.push_back({static_cast<const std::byte*>(from.memory.out) + output.offset,
                                to.latched + input.offset, static_cast<std::uint32_t>(c.type->size)});
  }
}

void PreemptiveThreads::begin(std::span<const analysis::TaskThread> threads) {
  std::size_t cores = 0, levels = 0;
  for (const analysis::TaskThread& t : threads) {
    cores = std::max(cores, t.core + 1);
    levels = std::max(levels, t.urgency + 1);
  }
  const auto priority = clock_.options().priority;
  if (priority && *priority <= static_cast<int>(levels))
    throw InputError("SCHED_FIFO priority " + std::to_string(*priority) + " is too low; tasks take " +
                     std::to_string(levels) + " below it, so that it has to be " + std::to_string(levels + 1) +
                     " at least");
  cores_ = std::vector<Core>(cores);
  std::vector<std::future<std::vector<std::string>>> prepared;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    Thread& thread = threads_[i];
    thread.ring.resize(std::bit_ceil(threads[i].tasks.size() + 1));
    thread.core = &cores_[threads[i].core];
    std::packaged_task<std::vector<std::string>()> prepare(
        [options = clock_.options().of_thread(threads[i].core, threads[i].urgency)] {
          return prepare_thread(options);
        });
    prepared.push_back(prepare.get_future());
    try {
      thread.thread = std::thread([this, &thread, prepare = std::move(prepare)]() mutable {
        set_floating_point_control(default_floating_point_control());
        prepare();
        run(thread);
      });
    } catch (const std::system_error& error) {
      end();
      throw Unfinished("no thread can be started for tasks: " + std::string(error.what()));
    }
  }
  for (auto& of_thread : prepared)
    for (const std::string& refusal : of_thread.get())
      if (std::find(refusals_.begin(), refusals_.end(), refusal) == refusals_.end()) refusals_.push_back(refusal);
}

Outcome PreemptiveThreads::add(std::size_t task, const Tick& tick) {
  Job& job = jobs_[task];
  job.newest = tick;
  if (job.state.load(std::memory_order_acquire) != State::idle) {
    job.to_skip = false;  // this was the one to skip
    return job.left_out = Outcome::overrun;
  }
  if (std::exchange(job.to_undo, false) && job.began) state_.status[task].restore(job.memory.state);
  if (std::exchange(job.to_restart, false)) state_.status[task].begins_anew = true;
  if (std::exchange(job.to_skip, false)) return job.left_out = Outcome::left_out;
  job.tick = tick;
  job.left_out = Outcome::good;
  job.abandoned = false;
  std::memcpy(job.latched, job.published, job.in_size);
  job.instant.store(tick.now, std::memory_order_relaxed);
  job.state.store(State::released, std::memory_order_relaxed);
  added_.push_back(&job);
  return Outcome::good;
}

void PreemptiveThreads::release() {
  std::sort(added_.begin(), added_.end(), [](const Job* a, const Job* b) { return a->turn < b->turn; });
  for (Job* job : added_) {
    const Duration instant = job->instant.load(std::memory_order_relaxed);
    const auto awaited = std::count_if(job->producers.begin(), job->producers.end(), [&](const Job* p) {
      return p->instant.load(std::memory_order_relaxed) == instant;
    });
    job->awaited.store(static_cast<std::uint32_t>(awaited), std::memory_order_relaxed);
  }
  for (Job* job : added_) give(threads_[job->thread], job);
  added_.clear();
  for (Thread& thread : threads_)
    if (thread.given != thread.released.load(std::memory_order_relaxed)) let_go(thread);
}

void PreemptiveThreads::give(Thread& thread, Job* job) { thread.ring[thread.given++ % thread.ring.size()] = job; }

void PreemptiveThreads::let_go(Thread& thread) {
  thread.released.store(thread.given, std::memory_order_release);
  Futex::wake_all(thread.released);
}

std::optional<Outcome> PreemptiveThreads::outcome(std::size_t task, bool due) {
  Job& job = jobs_[task];
  if (job.left_out != Outcome::good) return std::exchange(job.left_out, Outcome::good);
  State state = job.state.load(std::memory_order_acquire);
  if (state == State::released) {
    if (!due) return std::nullopt;
    if (job.state.compare_exchange_strong(state, State::abandoned, std::memory_order_acquire)) {
      job.abandoned = true;
      return Outcome::late;
    }
  }
  job.state.store(State::idle, std::memory_order_relaxed);
  return job.outcome;
}

std::optional<Duration> PreemptiveThreads::ended_after(std::size_t task) const {
  const Job& job = jobs_[task];
  if (job.abandoned) return std::nullopt;
  return job.end - job.newest.now;
}

void PreemptiveThreads::undo(std::size_t task, OnFault on_fault) {
  jobs_[task].to_undo = state_.status[task].recoverable;
  jobs_[task].to_skip = on_fault == OnFault::skip;
  jobs_[task].to_restart = on_fault == OnFault::restart;
}

std::optional<HangingTask> PreemptiveThreads::first_under_way() const {
  const Job* first = nullptr;
  Duration released{};
  for (const Job& job : jobs_) {
    const State state = job.state.load(std::memory_order_relaxed);
    if (state != State::released && state != State::abandoned) continue;
    if (job.awaited.load(std::memory_order_relaxed) != 0) continue;
    const Duration instant = job.instant.load(std::memory_order_relaxed);
    if (first != nullptr && std::tie(released, first->turn) <= std::tie(instant, job.turn)) continue;
    first = &job;
    released = instant;
  }
  if (first == nullptr) return std::nullopt;
  const Task& task = graph_.tasks[first->task];
  return HangingTask{task.name, (released - task.offset) / task.period, released};
}

std::vector<HangingTask> PreemptiveThreads::drain(std::optional<Futex::Time> patience) {
  std::vector<HangingTask> hanging, waiting;
  for (Thread& thread : threads_) {
    thread.watched.store(true, std::memory_order_seq_cst);
    for (std::uint32_t done; (done = thread.done.load(std::memory_order_seq_cst)) != thread.given;) {
      if (Futex::wait(thread.done, done, patience)) continue;
      const Job& job = *thread.ring[done % thread.ring.size()];
      auto& whose = job.awaited.load(std::memory_order_acquire) == 0 ? hanging : waiting;
      whose.push_back({graph_.tasks[job.task].name, job.tick.activation, job.tick.now});
      break;
    }
    thread.watched.store(false, std::memory_order_relaxed);
  }
  // one that waits for what another thread runs is not to blame
  return hanging.empty() ? waiting : hanging;
}

// In the order in which they were given: one that has to wait for a producer holds up those behind it, as in a table.
void PreemptiveThreads::run(Thread& thread) {
  const SignalStack signal_stack;
  const MemoryScope scope(no_heap());  // a task with a heap has a scope of its own
  for (std::uint32_t taken = 0;;) {
    while (thread.released.load(std::memory_order_acquire) == taken) Futex::wait(thread.released, taken, std::nullopt);
    Job* const job = thread.ring[taken++ % thread.ring.size()];
    if (job == nullptr) return;
    execute(*job, *thread.core);
    thread.done.store(taken, std::memory_order_seq_cst);
    if (thread.watched.load(std::memory_order_seq_cst)) Futex::wake_all(thread.done);
  }
}

void PreemptiveThreads::execute(Job& job, Core& core) {
  for (std::uint32_t awaited; (awaited = job.awaited.load(std::memory_order_acquire)) != 0;)
    Futex::wait(job.awaited, awaited, std::nullopt);
  const Duration instant = job.tick.now;
  Outcome outcome = Outcome::late;
  // what is late before it has begun does not begin
  job.began = job.state.load(std::memory_order_relaxed) == State::released;
  if (job.began) {
    // in this order, so that what preempts in between is counted to this one rather than left out
    const Duration begin = clock_.now();
    const Duration others(core.busy.load(std::memory_order_relaxed));
    running_task.begin(job.memory, job.tick);
    outcome = job.run(job.memory, job.tick);
    running_task.end();
    const Duration preempted = Duration(core.busy.load(std::memory_order_relaxed)) - others;
    job.end = clock_.now();
    const Duration took = job.end - begin - preempted;
    core.busy.fetch_add(took.count(), std::memory_order_relaxed);
    TaskTiming& timing = clock_.timing(job.task);
    timing.execution.add(took);
    timing.response.add(job.end - instant);
    if (outcome == Outcome::good && job.end - instant > job.deadline) outcome = Outcome::late;
    job.outcome = outcome;
  }
  State state = State::released;
  const bool counts = job.state.compare_exchange_strong(state, State::ended, std::memory_order_acq_rel);
  // from here on the job may be released again, and is not looked at any more but for what never changes
  if (!counts) job.state.store(State::idle, std::memory_order_release);
  hand_on(job, instant, counts && outcome == Outcome::good);
}

void PreemptiveThreads::hand_on(const Job& job, Duration instant, bool good) {
  for (const Follower& follower : job.followers) {
    Job& reader = *follower.job;
    if (reader.instant.load(std::memory_order_relaxed) != instant) continue;
    if (good)
      for (const Copy& c : follower.copies) transfer(c);
    if (follower.elsewhere && reader.awaited.fetch_sub(1, std::memory_order_acq_rel) == 1)
      Futex::wake_all(reader.awaited);
  }
}

}  // namespace jarol
