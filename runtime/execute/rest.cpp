#include "runtime/execute/rest.h"

#include <cstring>

namespace jarol {

Rest::Rest(const Graph& graph, const Plan& plan, const std::vector<std::unique_ptr<Channels>>& channels)
    : at_end_(*graph.at_end),
      plan_(plan),
      commands_(graph.communicators.size()),
      signals_(graph.at_end->until.signals.size()) {
  for (std::size_t i = 0; i < channels.size(); ++i)
    missions_.push_back(!graph.distributers[i].distributer_class->is_vehicle && channels[i]->end().has_value());
  for (const EndCommand& command : at_end_.commands) commands_[command.communicator] = &command;
}

bool Rest::command(std::size_t communicator, void* value) const {
  const EndCommand* const command = commands_[communicator];
  if (command == nullptr) return false;
  for (const Leaf& leaf : command->stated)
    std::memcpy(static_cast<std::byte*>(value) + leaf.offset,
                static_cast<const std::byte*>(command->value.data()) + leaf.offset, leaf.type->size);
  return true;
}

bool Rest::is_reached() {
  const expect::Condition& until = at_end_.until;
  for (std::size_t i = 0; i < signals_.size(); ++i)
    signals_[i] = expect::read_number(*until.signals[i].leaf.type, plan_.taps[i]);
  return expect::holds(until.comparison, expect::calc_value(until.metric.value, signals_));
}

}  // namespace jarol
