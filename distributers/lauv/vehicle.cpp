#include "distributers/lauv/vehicle.h"

#include <algorithm>
#include <cmath>

#include "distributers/lauv/messages.h"

namespace jarol::distributers {

using tasks::Instruments;

namespace {

// what a device does not measure it writes as no number beside what it does
bool measured(std::initializer_list<double> values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
}

}  // namespace

void LauvVehicle::note(tasks::Reading Instruments::*reading, double value) {
  if (!all_finite({value})) return;
  tasks::Reading& r = in.instruments.renew().*reading;
  r = {value, r.count + 1};
}

void LauvVehicle::note(tasks::VectorReading Instruments::*reading, double x, double y, double z) {
  if (!all_finite({x, y, z})) return;
  tasks::VectorReading& r = in.instruments.renew().*reading;
  r = {x, y, z, r.count + 1};
}

bool LauvVehicle::all_finite(std::initializer_list<double> values) {
  const bool good = std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (!good) ++non_finite_inputs_;
  return good;
}

void LauvVehicle::simulated_state(const imc::SimulatedState& m) {
  in.motion = {m.x, m.y, m.z, m.phi, m.theta, m.psi, m.u, m.v, m.w, m.p, m.q, m.r};
}

void LauvVehicle::estimated_state(const imc::EstimatedState& m) {
  in.motion = {m.x, m.y, m.depth, m.phi, m.theta, m.psi, m.u, m.v, m.w, m.p, m.q, m.r};
}

void LauvVehicle::angles(const imc::EulerAngles& m) {
  const bool attitude = measured({m.phi, m.theta, m.psi}), heading = measured({m.psi_magnetic});
  if (attitude || !heading) note(&Instruments::attitude, m.phi, m.theta, m.psi);
  if (heading || !attitude) note(&Instruments::heading, m.psi_magnetic);
}

void LauvVehicle::fix(const imc::GpsFix& m) {
  if ((m.validity & imc::GpsFix::Validity::VALID_POS) != 0) place(m.lat, m.lon);
}

void LauvVehicle::distance(const imc::Distance& m) {
  if (m.validity == imc::Distance::Validity::VALID) note(&Instruments::altitude, m.value);
}

void LauvVehicle::entity(const imc::EntityState& m) {
  note(&Instruments::leak, m.state == imc::EntityState::State::FAILURE ? 1 : 0);
}

// offsets from the first fix along meridian and parallel, WGS-84
void LauvVehicle::place(double latitude, double longitude) {
  if (!all_finite({latitude, longitude})) return;
  if (in.instruments->place.count == 0) {
    latitude_ = latitude;
    longitude_ = longitude;
  }
  constexpr double equatorial_radius = 6378137.0, eccentricity_squared = 6.69437999014e-3;
  const double s = std::sin(latitude_), w = 1 - eccentricity_squared * s * s;
  const double east_radius = equatorial_radius / std::sqrt(w);
  note(&Instruments::place, (latitude - latitude_) * east_radius * (1 - eccentricity_squared) / w,
       (longitude - longitude_) * east_radius * std::cos(latitude_), 0);
}

void LauvVehicle::announce(Duration instant, messages::Receiver& all) {
  if (announced_ && instant - *announced_ < announce_period) return;
  announced_ = instant;
  all.receive(messages::refer_to(make_announce({.name = "jarol", .type = imc::SystemType::CCU, .address = address_})));
}

void LauvVehicle::send_actuation(const tasks::Actuation& actuation, messages::Receiver& system) {
  system.receive(messages::refer_to(imc::SetThrusterActuation{0, static_cast<float>(actuation.thruster)}));
  for (std::uint8_t i = 0; i < actuation.fins.size(); ++i)
    system.receive(messages::refer_to(imc::SetServoPosition{i, static_cast<float>(actuation.fins[i])}));
}

}  // namespace jarol::distributers
