#include "vehicles/submarine/sensor.h"

#include <cmath>
#include <limits>

#include "graph/text/errors.h"
#include "graph/values/seed.h"

namespace jarol::vehicles {
namespace {

constexpr Duration grid = std::chrono::milliseconds(10);
constexpr Duration longest_delay = std::chrono::minutes(1);  // what was measured meanwhile is kept

std::int64_t steps_of(Duration duration, const std::string& what) {
  if (duration < Duration{} || duration % grid != Duration{})
    throw InputError("submarine: " + what + " must be a multiple of the vehicle's steps of 10ms");
  return duration / grid;
}

}  // namespace

Sensor::Sensor(const Errors& errors, Duration period, Duration delay, const std::string& name, std::uint64_t seed,
               std::size_t width)
    : errors_(errors),
      period_(steps_of(period, "sensors." + name + ".period")),
      delay_(steps_of(delay, "sensors." + name + ".delay")),
      width_(width),
      noise_(spread_seed(seed, name)),
      drift_noise_(spread_seed(seed, name + ".drift")),
      failing_(errors.failure, spread_seed(seed, name + ".failure")) {
  if (period_ == 0) throw InputError("submarine: sensors." + name + ".period must be above zero");
  if (delay > longest_delay) throw InputError("submarine: sensors." + name + ".delay is longer than a minute");
  if (!(errors.noise >= 0.0)) throw InputError("submarine: sensors." + name + ".noise is below zero");
  if (!(errors.drift >= 0.0)) throw InputError("submarine: sensors." + name + ".drift is below zero");
  if (!(errors.resolution >= 0.0)) throw InputError("submarine: sensors." + name + ".resolution is below zero");
  pending_.resize(static_cast<std::size_t>(delay_ / period_) + 1);
  values_.fill(std::numeric_limits<double>::quiet_NaN());
}

void Sensor::measure(const Values& truth, const FailingSensor::Error& error) {
  Values values{};
  for (std::size_t i = 0; i < width_; ++i) {
    values[i] = truth[i] + errors_.bias + wandered_[i] + error.bias;
    if (errors_.noise > 0.0) values[i] += error.noise * errors_.noise * noise_.normal();
    if (errors_.resolution > 0.0) values[i] = errors_.resolution * std::round(values[i] / errors_.resolution);
  }
  measured_ = values;
}

// By all the time since it measured last.
void Sensor::wander(std::int64_t step) {
  const double seconds = std::chrono::duration<double>((step - wandered_to_) * grid).count();
  wandered_to_ = step;
  if (errors_.drift == 0.0) return;
  for (std::size_t i = 0; i < width_; ++i)
    wandered_[i] += errors_.drift * std::sqrt(seconds / 100.0) * drift_noise_.normal();
}

// The ring from its first reading on.
void Sensor::serialize(Archive& archive) {
  archive(drift_noise_, wandered_, wandered_to_);
  archive(noise_, failing_, measured_, reported_, values_, count_);
  archive.require(count_ <= pending_.size(), "has more readings than a sensor keeps");
  if (archive.restores()) first_ = 0;
  for (std::size_t i = 0; i < count_; ++i) archive(pending_[(first_ + i) % pending_.size()]);
}

void Sensor::step(std::int64_t step, const std::optional<Values>& truth) {
  if (step % period_ == 0 && truth) {
    wander(step);
    const double seconds = 1e-9 * static_cast<double>((step * grid).count());
    const FailureKind failure = failing_.now(seconds);
    if (failure != FailureKind::lost && failure != FailureKind::stuck) measure(*truth, failing_.error(seconds));
    if (failure != FailureKind::lost && measured_)
      pending_[(first_ + count_++) % pending_.size()] = {step + delay_, *measured_};
  }
  reported_ = count_ > 0 && pending_[first_].step <= step;
  if (!reported_) return;
  values_ = pending_[first_].values;
  first_ = (first_ + 1) % pending_.size();
  --count_;
}

}  // namespace jarol::vehicles
