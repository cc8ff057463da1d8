#include "runtime/jarol/jarol_core.h"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "graph/floating_point.h"
#include "graph/text/errors.h"
#include "runtime/execute/expectations.h"
#include "runtime/jarol/threads_order.h"

namespace jarol {

JarolCore::JarolCore(PlanOfRun plan, std::vector<std::unique_ptr<ExternalSystem>> systems, Recorder* recorder)
    : run_(std::move(plan), {.recorder = recorder, .may_rest = true}),
      graph_(run_.graph),
      systems_(std::move(systems)),
      period_(choose_period()),
      failsafe_(graph_) {
  for (std::size_t i = 0; i < systems_.size(); ++i) system_mutexes_.push_back(std::make_unique<std::mutex>());
  ending_known_.resize(systems_.size());
  threads_report_.execution.resize(graph_.tasks.size());
  gather();
  if (run_.may_rest) rest_ = std::make_unique<Rest>(run_.state, systems_);
  if (recorder == nullptr) return;
  recorder->never_wait();
  for (const std::size_t distributer : watched_vehicles(graph_))
    if (const Type* type = systems_[distributer]->true_type())
      watched_.push_back(std::make_unique<Watched>(distributer, *type));
}

bool JarolCore::on_vehicle(std::size_t communicator) const {
  const auto distributer = graph_.communicators[communicator].distributer;
  return distributer && graph_.distributers[*distributer].distributer_class->is_vehicle;
}

Duration JarolCore::choose_period() const {
  Duration vehicle = Duration::max(), any = Duration::max();
  for (std::size_t i = 0; i < graph_.communicators.size(); ++i) {
    const Duration period = graph_.communicators[i].period;
    any = std::min(any, period);
    if (on_vehicle(i)) vehicle = std::min(vehicle, period);
  }
  for (const Task& task : graph_.tasks) any = std::min(any, task.period);
  if (any == Duration::max()) throw InputError("a graph without tasks and communicators has nothing to run");
  return vehicle != Duration::max() ? vehicle : any;
}

std::int64_t JarolCore::rounds_of(const std::string& what, Duration period) const {
  if (period.count() % period_.count() != 0)
    throw InputError("threads count in periods of the vehicle's channels, " + duration_text(period_) + "; " + what +
                     " has " + duration_text(period) + ", which is no multiple of it");
  return period.count() / period_.count();
}

void JarolCore::gather() {
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
        throw InputError("communicator '" + c.name +
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
    tasks_.push_back({activations[i], publishes[i], cadence, task.period});
  }
}

JarolCore::~JarolCore() { finish(); }

void JarolCore::run_for(Duration end, const std::function<void()>& prepare) {
  try {
    cover(end, prepare);
  } catch (...) {
    finish();
    throw;
  }
  finish();
  throw_failure();
}

void JarolCore::throw_failure() {
  const std::lock_guard lock(failure_mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

template <class Work>
void JarolCore::begin(Part& part, Signal& signal, const std::function<void()>& prepare, Work work) {
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
    fail(std::make_exception_ptr(Unfinished("no thread can be started: " + std::string(error.what()))));
  }
}

void JarolCore::cover(Duration end, const std::function<void()>& prepare) {
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

Finish JarolCore::finish(std::optional<Futex::Time> patience) {
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
  for (const auto& system : systems_) run_.report.non_finite_inputs += system->non_finite_inputs();
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
void JarolCore::close(Futex::Time patience) {
  interrupt();
  if (closed_.exchange(true)) return;
  const Duration time = now();
  std::vector<std::unique_lock<std::mutex>> locks;
  for (const auto& mutex : system_mutexes_)
    if (!lock_until(locks.emplace_back(*mutex, std::defer_lock), patience)) {
      failsafe_.fail_at_end(systems_, time, false, busy_link_text);
      return;
    }
  failsafe_.hand_over_at_end(systems_, time, false);
}

std::optional<HangingTask> JarolCore::running() const {
  const Counted* const task = running_.task.load(std::memory_order_acquire);
  if (task == nullptr) return std::nullopt;
  return HangingTask{graph_.tasks[task->activation->task].name, running_.activation.load(std::memory_order_relaxed),
                     running_.instant.load(std::memory_order_relaxed)};
}

// Nobody looks whether it comes in time, but it holds up the core.
std::optional<Holdup> JarolCore::holdup() const {
  const Counted* const task = running_.task.load(std::memory_order_acquire);
  std::optional<HangingTask> hanging = running();
  if (task == nullptr || !hanging) return std::nullopt;
  const Duration late = now() - hanging->instant - task->period;
  return Holdup{.task = std::move(*hanging), .late = late, .stops = false};
}

void JarolCore::fail(std::exception_ptr failure) {
  const std::lock_guard lock(failure_mutex_);
  if (!failure_) failure_ = std::move(failure);
  stopped_.store(true, std::memory_order_release);
}

std::optional<RestReport> JarolCore::rest() const {
  if (!resting()) return std::nullopt;
  const Duration begun = rest_from_.load() * period_;
  return RestReport{begun, std::max(begun, now()), rest_reached_.load() >= 0, rest_->was_heard()};
}

}  // namespace jarol
