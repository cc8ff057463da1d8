#include "runtime/execute/rest.h"

#include <algorithm>
#include <cstring>

namespace jarol {

Rest::Rest(RunState& state, const std::vector<std::unique_ptr<ExternalSystem>>& systems)
    : at_end_(*state.plan.graph.at_end),
      state_(state),
      commands_(state.plan.graph.communicators.size()),
      signals_(at_end_.until.signals.size()) {
  const Graph& graph = state.plan.graph;
  for (std::size_t i = 0; i < systems.size(); ++i)
    missions_.push_back(!graph.distributers[i].distributer_class->is_vehicle && systems[i]->end().has_value());
  std::vector<Ins> all(systems.size());
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& c = graph.communicators[i];
    systems_.push_back(c.distributer ? systems[*c.distributer].get() : nullptr);
    if (c.direction != Direction::in || !c.distributer ||
        !graph.distributers[*c.distributer].distributer_class->is_vehicle)
      continue;
    Ins& ins = all[*c.distributer];
    (c.timeout ? ins.with_timeout : ins.others).push_back(i);
  }
  for (Ins& ins : all)
    if (!ins.with_timeout.empty() || !ins.others.empty()) vehicles_.push_back(std::move(ins));
  for (const EndCommand& command : at_end_.commands) commands_[command.communicator] = &command;
}

bool Rest::command(std::size_t communicator, void* value) const {
  const EndCommand* const command = commands_[communicator];
  if (command == nullptr) return false;
  if (const ExternalSystem* const system = systems_[communicator]; system != nullptr && system->overrides_end())
    return false;
  for (const Leaf& leaf : command->stated)
    std::memcpy(static_cast<std::byte*>(value) + leaf.offset,
                static_cast<const std::byte*>(command->value.data()) + leaf.offset, leaf.type->size);
  return true;
}

void Rest::begin() {
  if (begun_) return;
  begun_ = true;
  std::fill(state_.tap_news.begin(), state_.tap_news.end(), std::byte{});
}

bool Rest::hears_vehicles(const Failsafe& inputs, Duration instant) const {
  const auto hears = [&](std::size_t in) { return inputs.hears(in, instant); };
  return std::all_of(vehicles_.begin(), vehicles_.end(), [&](const Ins& ins) {
    return ins.with_timeout.empty() ? std::any_of(ins.others.begin(), ins.others.end(), hears)
                                    : std::all_of(ins.with_timeout.begin(), ins.with_timeout.end(), hears);
  });
}

bool Rest::is_reached(const Failsafe& inputs, Duration instant) {
  heard_ = hears_vehicles(inputs, instant);
  const auto& news = state_.tap_news;
  if (!heard_ || std::find(news.begin(), news.end(), std::byte{}) != news.end()) return false;
  const expect::Condition& until = at_end_.until;
  for (std::size_t i = 0; i < signals_.size(); ++i)
    signals_[i] = expect::read_number(*until.signals[i].leaf.type, state_.taps[i]);
  return expect::holds(until.comparison, expect::calc_value(until.metric.value, signals_));
}

}  // namespace jarol
