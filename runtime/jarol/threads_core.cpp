#include "runtime/jarol/threads_core.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "graph/floating_point.h"
#include "runtime/execute/expectations.h"
#include "runtime/jarol/threads_order.h"
#include "runtime/machine/real_clock.h"
#include "runtime/machine/running_task.h"
#include "runtime/machine/signal_stack.h"

namespace jarol {

ThreadsCore::ThreadsCore(PlanOfRun plan, std::vector<std::unique_ptr<Channels>> channels, Recorder* recorder)
    : run_(std::move(plan), {.recorder = recorder, .may_rest = true}),
      graph_(run_.graph),
      channels_(std::move(channels)),
      period_(choose_period()),
      safe_commands_(graph_) {
  for (std::size_t i = 0; i < channels_.size(); ++i) channel_mutexes_.push_back(std::make_unique<std::mutex>());
  threads_report_.execution.resize(graph_.tasks.size());
  gather();
  if (run_.may_rest) rest_ = std::make_unique<Rest>(run_.state, channels_);
  if (recorder == nullptr) return;
  recorder->never_wait();
  for (const std::size_t distributer : watched_vehicles(graph_))
    if (const Type* type = channels_[distributer]->true_type())
      watched_.push_back(std::make_unique<Watched>(distributer, *type));
}

bool ThreadsCore::on_vehicle(std::size_t communicator) const {
  const auto distributer = graph_.communicators[communicator].distributer;
  return distributer && graph_.distributers[*distributer].distributer_class->is_vehicle;
}

Duration ThreadsCore::choose_period() const {
  Duration vehicle = Duration::max(), any = Duration::max();
  for (std::size_t i = 0; i < graph_.communicators.size(); ++i) {
    const Duration period = graph_.communicators[i].period;
    any = std::min(any, period);
    if (on_vehicle(i)) vehicle = std::min(vehicle, period);
  }
  for (const Task& task : graph_.tasks) any = std::min(any, task.period);
  if (any == Duration::max()) throw std::invalid_argument("a graph without tasks and communicators has nothing to run");
  return vehicle != Duration::max() ? vehicle : any;
}

std::int64_t ThreadsCore::rounds_of(const std::string& what, Duration period) const {
  if (period.count() % period_.count() != 0)
    throw std::invalid_argument("threads count in periods of the vehicle's channels, " + duration_text(period_) + "; " +
                                what + " has " + duration_text(period) + ", which is no multiple of it");
  return period.count() / period_.count();
}

void ThreadsCore::gather() {
  std::vector<const Activation*> activations(graph_.tasks.size());
  std::vector<const Publish*> publishes(graph_.tasks.size());
  for (const Activation& activation : run_.state.activations) {
    activations[activation.task] = &activation;
    if (!activation.has_let) publishes[activation.task] = &activation.publish;
  }
  for (const LetEnd& end : run_.state.let_ends) publishes[end.task] = &end.publish;
  for (const auto& [actions, to] : {std::pair(&run_.state.ins, &ins_), std::pair(&run_.state.outs, &outs_)})
    for (const CommunicatorAction& action : *actions) {
      const Communicator& c = graph_.communicators[action.communicator];
      if (c.type->is_deep())
        throw std::invalid_argument("communicator '" + c.name +
                                    "' carries a value of changing size, which threads can't hand over");
      Carried carried;
      carried.communicator = action.communicator;
      carried.action = &action;
      carried.core = carried.outside = Cadence(rounds_of("communicator '" + c.name + "'", c.period));
      carried.terminal = c.distributer && !on_vehicle(action.communicator);
      carried.port = std::make_unique<PushBytesPort>(1, c.type->size);
      carried.room.resize(c.type->size);
      to->push_back(std::move(carried));
    }
  const auto by_name = [](const Carried& a, const Carried& b) { return a.communicator < b.communicator; };
  std::sort(ins_.begin(), ins_.end(), by_name);
  std::sort(outs_.begin(), outs_.end(), by_name);
  for (const std::size_t i : threads_order(graph_)) {
    const Task& task = graph_.tasks[i];
    const Cadence cadence(rounds_of("task '" + task.name + "'", task.period));
    tasks_.push_back({activations[i], publishes[i], cadence, task.period, 0});
  }
}

ThreadsCore::~ThreadsCore() { finish(); }

void ThreadsCore::run_for(Duration end, const std::function<void()>& prepare) {
  try {
    cover(end, prepare);
  } catch (...) {
    finish();
    throw;
  }
  finish();
  throw_failure();
}

void ThreadsCore::throw_failure() {
  const std::lock_guard lock(failure_mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

template <class Work>
void ThreadsCore::begin(Part& part, Signal& signal, const std::function<void()>& prepare, Work work) {
  if (stopped()) return;
  part.signal = &signal;
  try {
    part.thread = std::thread([this, &part, prepare, work] {
      set_floating_point_control(default_floating_point_control());
      try {
        prepare();
        work();
      } catch (...) { fail(std::current_exception()); }
      part.ended.store(1, std::memory_order_release);
      Futex::wake_all(part.ended);
    });
  } catch (const std::system_error& error) {
    fail(std::make_exception_ptr(std::runtime_error("there is no thread to be had: " + std::string(error.what()))));
  }
}

void ThreadsCore::cover(Duration end, const std::function<void()>& prepare) {
  begin(core_, core_signal_, prepare, [this] { run_core(); });
  begin(actuator_, actuator_signal_, prepare, [this] { run_actuator(); });
  begin(terminal_, terminal_signal_, prepare, [this] { run_terminal(); });
  begin(sensor_, start_signal_, prepare, [this, end] {
    if (start_signal_.await() == Awaiting::signalled) run_sensor(end);
  });
  // the clock starts when all wait to be signalled
  for (const Signal* signal : {&core_signal_, &actuator_signal_, &terminal_signal_, &start_signal_})
    while (!stopped() && signal->waiting() == 0) std::this_thread::yield();
  try {
    if (!stopped()) prepare();
  } catch (...) { fail(std::current_exception()); }
  if (!stopped()) {
    trigger_.emplace(period_);
    static_cast<void>(start_signal_.signal());
  }
  constexpr auto look = std::chrono::milliseconds(10);
  while (!interrupted_.load(std::memory_order_relaxed) && !stopped()) std::this_thread::sleep_for(look);
  throw_failure();
}

Finish ThreadsCore::finish(std::optional<Futex::Time> patience) {
  // in the order of the flow: what was sensed is still computed, and what was computed handed over
  if (trigger_) trigger_->stop();
  for (Part* part : {&sensor_, &core_, &actuator_, &terminal_}) {
    if (!part->thread.joinable()) continue;
    part->signal->interrupt();
    while (part->ended.load(std::memory_order_acquire) == 0) {
      if (Futex::wait(part->ended, 0, patience)) continue;
      Finish finish{.done = false};
      if (auto hanging = running()) finish.hanging.push_back(std::move(*hanging));
      return finish;
    }
    part->thread.join();
  }
  run_.report.non_finite_inputs = refused_inputs_;
  for (const auto& channels : channels_) run_.report.non_finite_inputs += channels->non_finite_inputs();
  run_.report.simulated = now();
  // the instant at which a run is broken off was run
  run_.report.covered = now() + Duration(reached_end_ || threads_report_.rounds == 0 ? 0 : 1);
  return {};
}

namespace {
// Tries again and again: the thread sanitizer does not know a mutex that is waited for until a time.
bool lock_until(std::unique_lock<std::mutex>& lock, Futex::Time patience) {
  while (!lock.try_lock()) {
    if (std::chrono::steady_clock::now() >= patience) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return true;
}
}  // namespace

// From here on the threads that carry values find nothing to do.
void ThreadsCore::close(Futex::Time patience) {
  interrupt();
  if (closed_.exchange(true)) return;
  const Duration time = now();
  std::vector<std::unique_lock<std::mutex>> locks;
  for (const auto& mutex : channel_mutexes_)
    if (!lock_until(locks.emplace_back(*mutex, std::defer_lock), patience)) {
      safe_commands_.fail_at_end(channels_, time, false, busy_link_text);
      return;
    }
  safe_commands_.hand_over_at_end(channels_, time, false);
}

std::optional<HangingTask> ThreadsCore::running() const {
  const Counted* const task = running_.task.load(std::memory_order_acquire);
  if (task == nullptr) return std::nullopt;
  return HangingTask{graph_.tasks[task->activation->task].name, running_.activation.load(std::memory_order_relaxed),
                     Duration(running_.instant.load(std::memory_order_relaxed))};
}

// Nobody looks whether it comes in time, but it holds up the core.
std::optional<Holdup> ThreadsCore::holdup() const {
  const Counted* const task = running_.task.load(std::memory_order_acquire);
  std::optional<HangingTask> hanging = running();
  if (task == nullptr || !hanging) return std::nullopt;
  const Duration late = now() - hanging->instant - task->period;
  return Holdup{.task = std::move(*hanging), .late = late, .stops = false};
}

void ThreadsCore::fail(std::exception_ptr failure) {
  const std::lock_guard lock(failure_mutex_);
  if (!failure_) failure_ = std::move(failure);
  stopped_.store(true, std::memory_order_release);
}

std::optional<RestReport> ThreadsCore::rest() const {
  if (!resting()) return std::nullopt;
  const Duration begun = rest_from_.load() * period_;
  return RestReport{begun, std::max(begun, now()), rest_reached_.load() >= 0, rest_->was_heard()};
}

// What is reached, if the run ends before that round. After the last round of `end` the vehicle comes to rest, for so
// many rounds more at most.
std::optional<Duration> ThreadsCore::end_at(std::int64_t round, std::int64_t& last, Duration end) {
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
void ThreadsCore::run_sensor(Duration end) {
  TimeTrigger& trigger = *trigger_;
  std::int64_t rounds = end / period_ + (end % period_ != Duration{} ? 1 : 0);
  for (std::int64_t next = 0; !stopped() && trigger.await() == Awaiting::signalled;) {
    const std::int64_t round = std::min(trigger.ticks() - 1, rounds);
    threads_report_.unawaited_ticks += static_cast<std::uint64_t>(round - next);
    next = round + 1;
    if (const std::optional<Duration> reached = end_at(round, rounds, end)) {
      now_.store(reached->count(), std::memory_order_relaxed);
      reached_end_ = rest_reached_.load(std::memory_order_relaxed) < 0;
      stopped_.store(true, std::memory_order_release);
      return;
    }
    now_.store(round * period_.count(), std::memory_order_relaxed);
    const std::int64_t tick = Duration(trigger.time_of(round).time_since_epoch()).count();
    threads_report_.lateness.add(RealClock::monotonic() - tick);
    tick_.store(tick, std::memory_order_relaxed);
    sense(false, round);
    rounds_begun_.store(next, std::memory_order_release);
    if (core_signal_.signal() != Signalling::done) ++threads_report_.core_busy;
  }
}

// Values from outside into the ports of one side.
void ThreadsCore::sense(bool terminal, std::int64_t round) {
  const Duration now(round * period_.count());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (graph_.distributers[i].distributer_class->is_vehicle == terminal) continue;
    const std::lock_guard lock(*channel_mutexes_[i]);
    if (closed_.load(std::memory_order_relaxed)) return;
    channels_[i]->reach(now);
    for (const auto& vehicle : watched_) {
      if (vehicle->distributer != i) continue;
      channels_[i]->copy_true_values(vehicle->outside.data());
      vehicle->port.write(vehicle->outside.data());
    }
    for (Carried& in : ins_) {
      const Communicator& c = graph_.communicators[in.communicator];
      if (c.distributer != i || !in.outside.due(round) || !channels_[i]->take(c.channel, in.room.data())) continue;
      if (c.type->finite(in.room.data()))
        in.port->write(in.room.data());
      else
        refused_inputs_.fetch_add(1, std::memory_order_relaxed);
    }
  }
}

void ThreadsCore::run_core() {
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

void ThreadsCore::run_round(std::int64_t round) {
  const Duration instant = round * period_;
  const Now now = run_.publisher.at(instant);
  ++run_.report.instants;
  if (!watched_.empty()) record_true_values(instant);
  const std::int64_t rest_from = rest_from_.load(std::memory_order_acquire);
  const bool rests = rest_from >= 0 && round >= rest_from;
  if (rests) rest_->begin();
  for (Carried& in : ins_) {
    if (!in.core.due(round)) continue;
    const std::optional<std::size_t>& distributer = graph_.communicators[in.communicator].distributer;
    const bool over = rests && distributer && rest_->is_mission(*distributer);
    while (!over && in.port->read(in.action->value)) safe_commands_.took(in.communicator, instant);
    if (rests && rest_->command(in.communicator, in.action->value)) safe_commands_.took(in.communicator, instant);
    run_.publisher.publish(in.action->publish, now);
  }
  for (Counted& task : tasks_)
    if (task.cadence.due(round)) run_task(task, now);
  for (Carried& out : outs_) {
    if (!out.core.due(round)) continue;
    const void* const safe = safe_commands_.in_place_of_input(out.communicator, instant);
    copy_value(*graph_.communicators[out.communicator].type, out.action->value,
               safe != nullptr ? safe : out.action->input);
    run_.publisher.publish(out.action->publish, now);
    out.port->write(out.action->value);
  }
  if (rests && rest_reached_.load(std::memory_order_relaxed) < 0 && rest_->is_reached(safe_commands_, instant))
    rest_reached_.store(round, std::memory_order_release);
}

void ThreadsCore::run_task(Counted& task, const Now& now) {
  const Activation& activation = *task.activation;
  const Tick tick{now.instant, task.activations++, task.period};
  const std::int64_t begin = RealClock::monotonic();
  running_.activation.store(tick.activation, std::memory_order_relaxed);
  running_.instant.store(tick.now.count(), std::memory_order_relaxed);
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

void ThreadsCore::record_true_values(Duration instant) {
  for (const auto& vehicle : watched_) {
    const auto output = static_cast<std::uint32_t>(run_.plan.outputs.size() + vehicle->distributer);
    if (vehicle->port.read(vehicle->core.data()))
      record(*run_.publisher.recorder(), output, *vehicle->core.type(), vehicle->core.data(), instant);
  }
}

void ThreadsCore::on_bad(const Activation& activation, const BadActivation& bad) {
  run_.faults.add(activation.task, bad, activation.memory.out);
  if (run_.report.stopped) stopped_.store(true, std::memory_order_release);
  run_.faults.restore(activation);
}

// Values of one side from the ports to the outside.
void ThreadsCore::act(bool terminal) {
  for (Carried& out : outs_) {
    const Communicator& c = graph_.communicators[out.communicator];
    if (!c.distributer || out.terminal != terminal || !out.port->read(out.room.data())) continue;
    const std::lock_guard lock(*channel_mutexes_[*c.distributer]);
    if (closed_.load(std::memory_order_relaxed)) return;
    channels_[*c.distributer]->hand_over(c.channel, out.room.data());
  }
}

void ThreadsCore::run_actuator() {
  for (std::uint64_t seen = 0; await_core(actuator_signal_, seen);) act(false);
}

void ThreadsCore::run_terminal() {
  for (std::uint64_t seen = 0; await_core(terminal_signal_, seen);) {
    sense(true, std::max<std::int64_t>(0, rounds_begun_.load(std::memory_order_acquire) - 1));
    act(true);
  }
}

// Until the core has done another round; false at the end.
bool ThreadsCore::await_core(Signal& signal, std::uint64_t& seen) const {
  const auto ready = [&] { return rounds_done_.load(std::memory_order_seq_cst) != seen; };
  for (bool over = false; !ready();) {
    if (over) return false;
    over = signal.await_unless(ready) == Awaiting::interrupted;
  }
  seen = rounds_done_.load(std::memory_order_acquire);
  return true;
}

}  // namespace jarol
