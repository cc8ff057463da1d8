#include "runtime/execute/communicators.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <thread>
#include <utility>

#include "runtime/execute/expectations.h"

namespace jarol {
namespace {

// Communicators are in order of name in the graph, so their index gives it; few are due at once.
void sort_by_name(std::vector<const CommunicatorAction*>& actions) {
  if (actions.size() < 2) return;
  std::sort(actions.begin(), actions.end(),
            [](const auto* a, const auto* b) { return a->communicator < b->communicator; });
}

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

Communicators::Communicators(Run& run, std::vector<std::unique_ptr<ExternalSystem>> systems, Truth truth,
                             std::span<const expect::Condition> measured)
    : run_(run), systems_(std::move(systems)), failsafe_(run.graph), are_any_(!run.graph.communicators.empty()) {
  assert(systems_.size() == run.graph.distributers.size());
  outs_.reserve(run.plan.outs.size());
  ins_.reserve(run.plan.ins.size());
  if (truth != Truth::none && run.publisher.recorder() != nullptr)
    for (const std::size_t distributer :
         truth == Truth::all ? all_of(systems_.size()) : watched_vehicles(run.graph, measured))
      if (const Type* type = systems_[distributer]->true_type()) watched_.push_back({distributer, Value(*type)});
  if (run.may_rest) rest_ = std::make_unique<Rest>(run.state, systems_);
}

void Communicators::begin(Turn& turn, const Now& now) {
  gather(now);
  if (outs_.empty() && ins_.empty()) return;
  Use free = Use::free;
  turn.uses_ = use_.compare_exchange_strong(free, Use::covering, std::memory_order_acquire);
  turn.closed_ = !turn.uses_;
  if (!turn.uses_) return;
  try {
    reach(now.instant);
  } catch (...) {
    end(turn);  // the turn is not made, and nobody else ends it
    throw;
  }
}

void Communicators::end(Turn& turn) {
  turn.uses_ = false;
  called_.store(0, std::memory_order_relaxed);
  use_.store(Use::free, std::memory_order_release);
}

// The communicators due now, by name.
void Communicators::gather(const Now& now) {
  outs_.clear();
  ins_.clear();
  for (const std::uint32_t g : now.due) {
    const Plan::Group& group = run_.plan.groups[g];
    for (const CommunicatorAction& action : group.outs.of(run_.state.outs)) outs_.push_back(&action);
    for (const CommunicatorAction& action : group.ins.of(run_.state.ins)) ins_.push_back(&action);
  }
  sort_by_name(outs_);
  sort_by_name(ins_);
}

// For a call of it, which whoever attends the run sees until the next one.
ExternalSystem& Communicators::call(std::size_t distributer) {
  called_.store(static_cast<std::uint32_t>(distributer + 1), std::memory_order_relaxed);
  return *systems_[distributer];
}

template <class Do>
void Communicators::attempt(Do act) {
  if (lost_) return;
  try {
    act();
  } catch (...) { lost_ = std::current_exception(); }
}

void Communicators::reach(Duration instant) {
  const MemoryScope outside(nullptr);
  if (resting() && !std::exchange(ending_known_, true))
    for (std::size_t i = 0; i < systems_.size(); ++i) call(i).ending();
  for (std::size_t i = 0; i < systems_.size(); ++i) call(i).reach(instant);
  for (WatchedVehicle& vehicle : watched_) {
    call(vehicle.distributer).copy_true_values(vehicle.values.data());
    const auto output = static_cast<std::uint32_t>(run_.plan.outputs.size() + vehicle.distributer);
    record(*run_.publisher.recorder(), output, *vehicle.values.type(), vehicle.values.data(), instant);
  }
  called_.store(0, std::memory_order_relaxed);
}

void Communicators::act(Turn& turn, const Now& now) {
  for (const CommunicatorAction* out : outs_) {
    hand_over(*out, now.instant);
    run_.publisher.publish(out->publish, now);
  }
  for (const CommunicatorAction* in : ins_) {
    take(*in, now.instant);
    run_.publisher.publish(in->publish, now);
  }
  end(turn);
}

void Communicators::hand_over(const CommunicatorAction& out, Duration instant) {
  const Communicator& communicator = run_.graph.communicators[out.communicator];
  const void* const safe = failsafe_.in_place_of_input(out.communicator, instant);
  copy_value(*communicator.type, out.value, safe != nullptr ? safe : out.input);
  const MemoryScope outside(nullptr);
  if (communicator.distributer)
    attempt([&] { call(*communicator.distributer).hand_over(communicator.channel, out.value); });
}

void Communicators::take(const CommunicatorAction& in, Duration instant) {
  const Communicator& communicator = run_.graph.communicators[in.communicator];
  if (!communicator.distributer) return;
  const MemoryScope outside(nullptr);
  const bool over = resting() && rest_->is_mission(*communicator.distributer);
  bool fresh = false;
  if (!over) attempt([&] { fresh = call(*communicator.distributer).take(communicator.channel, in.taken); });
  if (fresh && !communicator.type->finite(in.taken)) {
    ++refused_;
    fresh = false;
  }
  if (fresh) copy_value(*communicator.type, in.value, in.taken);
  const bool commanded = resting() && rest_->command(in.communicator, in.value);
  if (!fresh && !commanded) return;
  failsafe_.took(in.communicator, instant);
  run_.log.took(in.communicator, in.value, instant);
}

void Communicators::begin_rest(Duration instant) {
  rest_begun_ = instant;
  rest_->begin();
  run_.log.rest(instant);
  run_.publisher.show({.kind = RunEvent::Kind::rest_begun, .instant = instant});
  resting_.store(true);
}

bool Communicators::has_come_to_rest(Duration instant) {
  if (!resting() || !rest_->is_reached(failsafe_, instant)) return false;
  run_.publisher.show({.kind = RunEvent::Kind::at_rest, .instant = instant});
  return rest_reached_ = true;
}

std::optional<RestReport> Communicators::rest(Duration reached) const {
  if (!resting()) return std::nullopt;
  return RestReport{rest_begun_, std::max(rest_begun_, reached), rest_reached_, rest_->was_heard()};
}

void Communicators::close(Futex::Time patience, bool outliving, const std::function<Duration()>& time) {
  Use use = Use::free;
  while (!use_.compare_exchange_strong(use, Use::closed, std::memory_order_acquire)) {
    if (use == Use::closed) return;
    if (Futex::now() >= patience) break;
    use = Use::free;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const MemoryScope outside(nullptr);
  if (use == Use::free)
    failsafe_.hand_over_at_end(systems_, time(), outliving);
  else
    failsafe_.fail_at_end(systems_, time(), outliving, busy_link_text);
}

void Communicators::serialize(Archive& archive) {
  const MemoryScope outside(nullptr);
  archive(refused_);
  failsafe_.serialize(archive);
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    try {
      systems_[i]->serialize(archive);
    } catch (const NotSaveable& error) {
      throw NotSaveable("distributer '" + run_.graph.distributers[i].name + "': " + error.what());
    }
  }
}

std::uint64_t Communicators::non_finite_inputs() const {
  std::uint64_t sum = refused_;
  for (const auto& system : systems_) sum += system->non_finite_inputs();
  return sum;
}

}  // namespace jarol
