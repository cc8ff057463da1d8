#include "runtime/dispatch/on_threads.h"

#include <algorithm>

namespace jarol {

OnThreads::OnThreads(Run& run, RealClock& clock, std::span<const analysis::TaskThread> threads)
    : run_(run), clock_(clock), releases_(run), threads_(run.state, clock, threads) {
  under_way_.reserve(run.graph.tasks.size());
  // a data-flow task is seen to have ended by its deadline, when others may have published at later instants
  Duration longest{};
  for (const Task& task : run.graph.tasks)
    if (!task.let) longest = std::max(longest, task.deadline);
  if (Recorder* const recorder = run.publisher.recorder()) recorder->put_in_order(longest);
}

void OnThreads::end_lets(const Now& now) {
  for (const std::uint32_t g : now.due)
    for (const LetEnd& let_end : run_.plan.groups[g].let_ends.of(run_.state.let_ends)) {
      const Outcome outcome = *threads_.outcome(let_end.task, true);
      if (outcome == Outcome::good) {
        run_.publisher.publish(let_end.publish, now);
      } else if (outcome != Outcome::left_out) {
        on_bad(let_end.task, outcome, now.instant);
      }
    }
}

void OnThreads::release(const Now& now) {
  releases_.each_task(now, [&](const Activation& activation, const Tick& tick) {
    const Outcome outcome = threads_.add(activation.task, tick);
    if (outcome != Outcome::good) --run_.report.activations;
    if (outcome == Outcome::left_out) ++run_.report.left_out[activation.task];
    if (outcome == Outcome::overrun) run_.log.left_out(activation.task, tick.activation, now.instant);
    if (activation.has_let) return;  // what it was shows at the end of the LET
    if (outcome == Outcome::good) under_way_.push_back(&activation);
    if (outcome == Outcome::overrun) on_bad(activation.task, outcome, now.instant);
  });
  threads_.release();
}

void OnThreads::settle(Duration instant) {
  std::size_t left = 0;
  for (const Activation* activation : under_way_) {
    const Duration release = threads_.tick(activation->task).now;
    const bool due = instant - release >= run_.graph.tasks[activation->task].deadline;
    const std::optional<Outcome> outcome = threads_.outcome(activation->task, due);
    if (!outcome) {
      under_way_[left++] = activation;
    } else if (*outcome == Outcome::good) {
      run_.publisher.publish(activation->publish, run_.publisher.at(release));
    } else {
      on_bad(activation->task, *outcome, release);
    }
  }
  under_way_.resize(left);
}

// Whether one that has not ended is late shows later.
Duration OnThreads::settled(Duration instant) const {
  for (const Activation* activation : under_way_) instant = std::min(instant, threads_.tick(activation->task).now);
  return instant;
}

std::vector<HangingTask> OnThreads::drain(std::optional<Futex::Time> patience) {
  const MemoryScope scope(no_heap());
  std::vector<HangingTask> hanging = threads_.drain(patience);
  if (hanging.empty()) settle(Duration{});
  return hanging;
}

void OnThreads::on_bad(std::uint32_t task, Outcome outcome, Duration instant) {
  const BadActivation bad{outcome, threads_.tick(task).activation, instant,
                          outcome == Outcome::late ? threads_.ended_after(task) : std::nullopt};
  TaskTiming& timing = clock_.timing(task);
  if (outcome == Outcome::overrun) ++timing.left_out;
  if (outcome == Outcome::late) {
    ++timing.late;
    run_.log.late(task, bad.activation, bad.ended_after, instant);
  }
  run_.faults.add(task, bad, threads_.out(task));
  if (outcome != Outcome::overrun) threads_.undo(task, run_.graph.tasks[task].on_fault);
}

}  // namespace jarol
