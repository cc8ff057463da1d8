#include "distributers/serve/silence_log.h"

#include "graph/values/bind.h"

namespace jarol {

std::vector<double> actuators_of(const vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class) {
  const TypeField& first = vehicle_class.outputs->fields.front();
  std::vector<double> values;
  for (const TypeField& field : first.type->fields)
    values.push_back(
        read_floating(*field.type, static_cast<const std::byte*>(vehicle.outputs()) + first.offset + field.offset));
  return values;
}

void SilenceLog::add(const VehicleMoment& moment) {
  const std::chrono::nanoseconds before = before_;
  before_ = moment.instant;
  if (moment.heard) {
    heard_ = moment.instant;
    silent_ = false;
    return;
  }
  if (moment.instant - heard_ <= patience) return;
  if (!silent_) {
    ++silences_;
    silent_for_ += before - heard_;
    if (kept_.size() < max_kept) kept_.push_back({heard_, {}, {}, {}});
  }
  silent_ = true;
  silent_for_ += moment.instant - before;
  if (silences_ > max_kept) return;
  kept_.back().to = moment.instant;
  kept_.back().state = moment.vehicle.state();
  kept_.back().actuators = actuators_of(moment.vehicle, class_);
}

}  // namespace jarol
