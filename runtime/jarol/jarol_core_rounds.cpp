// What the threads of the core do in each round: sense, compute, act.
#include <algorithm>
#include <utility>

#include "runtime/jarol/jarol_core.h"
#include "runtime/machine/real_clock.h"
#include "runtime/machine/running_task.h"
#include "runtime/machine/signal_stack.h"

namespace jarol {

// What is reached, if the run ends before that round. After the last round of `end` the vehicle comes to rest, for so
// many rounds more at most.
std::optional<Duration> JarolCore::end_at(std::int64_t round, std::int64_t& last, Duration end) {
  if (const std::int64_t reached = rest_reached_.load(std::memory_order_acquire); reached >= 0)
    return reached * period_;
  if (rest_ != nullptr && !resting() && (round >= last || rest_asked_.load(std::memory_order_relaxed))) {
    on_rest_(round * period_);
    rest_from_.store(round, std::memory_order_release);
    last = round + (rest_->longest() + period_ - Duration(1)) / period_;
  }
  if (round < last) return std::nullopt;
  return resting() ? round * period_ : end;
}

// A round's number goes by the clock, also where ticks found this thread at work.
void JarolCore::run_sensor(Duration end) {
  TimeTrigger& trigger = *trigger_;
  std::int64_t rounds = end / period_ + (end % period_ != Duration{} ? 1 : 0);
  for (std::int64_t next = 0; !stopped() && trigger.await() == Awaiting::signalled;) {
    const std::int64_t round = std::min(trigger.ticks() - 1, rounds);
    threads_report_.unawaited_ticks += static_cast<std::uint64_t>(round - next);
    next = round + 1;
    if (const std::optional<Duration> reached = end_at(round, rounds, end)) {
      now_.store(*reached, std::memory_order_relaxed);
      reached_end_ = rest_reached_.load(std::memory_order_relaxed) < 0;
      stopped_.store(true, std::memory_order_release);
      return;
    }
    now_.store(round * period_, std::memory_order_relaxed);
    const Duration tick(trigger.time_of(round).time_since_epoch());
    threads_report_.lateness.add(RealClock::monotonic() - tick);
    tick_.store(tick, std::memory_order_relaxed);
    sense(false, round);
    rounds_begun_.store(next, std::memory_order_release);
    if (core_signal_.signal() != Signalling::done) ++threads_report_.core_busy;
  }
}

// Values from outside into the ports of one side.
void JarolCore::sense(bool terminal, std::int64_t round) {
  const Duration now(round * period_.count());
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    if (graph_.distributers[i].distributer_class->is_vehicle == terminal) continue;
    const std::lock_guard lock(*system_mutexes_[i]);
    if (closed_.load(std::memory_order_relaxed)) return;
    const std::int64_t rest_from = rest_from_.load(std::memory_order_acquire);
    if (rest_from >= 0 && round >= rest_from && !std::exchange(ending_known_[i], char{1})) systems_[i]->ending();
    systems_[i]->reach(now);
    for (const auto& vehicle : watched_) {
      if (vehicle->distributer != i) continue;
      systems_[i]->copy_true_values(vehicle->outside.data());
      vehicle->port.write(vehicle->outside.data());
    }
    for (Carried& in : ins_) {
      const Communicator& c = graph_.communicators[in.communicator];
      if (c.distributer != i || !in.outside.due(round) || !systems_[i]->take(c.channel, in.room.data())) continue;
      if (c.type->finite(in.room.data()))
        in.port->write(in.room.data());
      else
        refused_inputs_.fetch_add(1, std::memory_order_relaxed);
    }
  }
}

void JarolCore::run_core() {
  const SignalStack signal_stack;
  const MemoryScope scope(no_heap());
  for (std::int64_t done = 0; !run_.report.stopped;) {
    const auto ready = [&] { return rounds_begun_.load(std::memory_order_acquire) > done; };
    const bool over = core_signal_.await_unless(ready) == Awaiting::interrupted;
    if (!ready()) {
      if (over) return;
      continue;
    }
    // rounds that were missed are not made up for
    done = rounds_begun_.load(std::memory_order_acquire);
    run_round(done - 1);
    ++threads_report_.rounds;
    rounds_done_.store(threads_report_.rounds, std::memory_order_seq_cst);
    threads_report_.round.add(RealClock::monotonic() - tick_.load(std::memory_order_relaxed));
    static_cast<void>(actuator_signal_.signal());
    static_cast<void>(terminal_signal_.signal());
  }
}

void JarolCore::run_round(std::int64_t round) {
  const Duration instant = round * period_;
  const Now now = run_.publisher.at(instant);
  ++run_.report.instants;
  if (!watched_.empty()) record_true_values(instant);
  const std::int64_t rest_from = rest_from_.load(std::memory_order_acquire);
  const bool rests = rest_from >= 0 && round >= rest_from;
  if (rests && !rest_->has_begun()) {
    rest_->begin();
    run_.publisher.show({.kind = RunEvent::Kind::rest_begun, .instant = rest_from * period_});
  }
  for (Carried& in : ins_) {
    if (!in.core.due(round)) continue;
    const std::optional<std::size_t>& distributer = graph_.communicators[in.communicator].distributer;
    const bool over = rests && distributer && rest_->is_mission(*distributer);
    while (!over && in.port->read(in.action->value)) failsafe_.took(in.communicator, instant);
    if (rests && rest_->command(in.communicator, in.action->value)) failsafe_.took(in.communicator, instant);
    run_.publisher.publish(in.action->publish, now);
  }
  for (Counted& task : tasks_)
    if (task.cadence.due(round)) run_task(task, now);
  for (Carried& out : outs_) {
    if (!out.core.due(round)) continue;
    const void* const safe = failsafe_.in_place_of_input(out.communicator, instant);
    copy_value(*graph_.communicators[out.communicator].type, out.action->value,
               safe != nullptr ? safe : out.action->input);
    run_.publisher.publish(out.action->publish, now);
    out.port->write(out.action->value);
  }
  if (rests && rest_reached_.load(std::memory_order_relaxed) < 0 && rest_->is_reached(failsafe_, instant)) {
    run_.publisher.show({.kind = RunEvent::Kind::at_rest, .instant = instant});
    rest_reached_.store(round, std::memory_order_release);
  }
}

void JarolCore::run_task(Counted& task, const Now& now) {
  const Activation& activation = *task.activation;
  // numbered by the clock: those of rounds that were left out have theirs
  const Tick tick{now.instant, now.instant / task.period, task.period};
  const Duration begin = RealClock::monotonic();
  running_.activation.store(tick.activation, std::memory_order_relaxed);
  running_.instant.store(tick.now, std::memory_order_relaxed);
  running_.task.store(&task, std::memory_order_release);
  running_task.begin(activation.memory, tick);
  const Outcome outcome = activation.run(activation.memory, tick);
  running_task.end();
  running_.task.store(nullptr, std::memory_order_relaxed);
  if (outcome == Outcome::left_out) {
    ++run_.report.left_out[activation.task];
    return;
  }
  threads_report_.execution[activation.task].add(RealClock::monotonic() - begin);
  ++run_.report.activations;
  if (outcome == Outcome::good)
    run_.publisher.publish(*task.publish, now);
  else
    on_bad(activation, {outcome, tick.activation, tick.now});
}

void JarolCore::record_true_values(Duration instant) {
  for (const auto& vehicle : watched_) {
    const auto output = static_cast<std::uint32_t>(run_.plan.outputs.size() + vehicle->distributer);
    if (vehicle->port.read(vehicle->core.data()))
      record(*run_.publisher.recorder(), output, *vehicle->core.type(), vehicle->core.data(), instant);
  }
}

void JarolCore::on_bad(const Activation& activation, const BadActivation& bad) {
  run_.faults.add(activation.task, bad, activation.memory.out);
  if (run_.report.stopped) stopped_.store(true, std::memory_order_release);
  run_.faults.restore(activation);
}

// Values of one side from the ports to the outside.
void JarolCore::act(bool terminal) {
  for (Carried& out : outs_) {
    const Communicator& c = graph_.communicators[out.communicator];
    if (!c.distributer || out.terminal != terminal || !out.port->read(out.room.data())) continue;
    const std::lock_guard lock(*system_mutexes_[*c.distributer]);
    if (closed_.load(std::memory_order_relaxed)) return;
    systems_[*c.distributer]->hand_over(c.channel, out.room.data());
  }
}

void JarolCore::run_actuator() {
  for (std::uint64_t seen = 0; await_core(actuator_signal_, seen);) act(false);
}

void JarolCore::run_terminal() {
  for (std::uint64_t seen = 0; await_core(terminal_signal_, seen);) {
    sense(true, std::max<std::int64_t>(0, rounds_begun_.load(std::memory_order_acquire) - 1));
    act(true);
  }
}

// Until the core has done another round; false at the end.
bool JarolCore::await_core(Signal& signal, std::uint64_t& seen) const {
  const auto ready = [&] { return rounds_done_.load(std::memory_order_seq_cst) != seen; };
  for (bool over = false; !ready();) {
    if (over) return false;
    over = signal.await_unless(ready) == Awaiting::interrupted;
  }
  seen = rounds_done_.load(std::memory_order_acquire);
  return true;
}

}  // namespace jarol
