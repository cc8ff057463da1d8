#include "distributers/lauv/vehicle.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "distributers/lauv/messages.h"
#include "distributers/messages/imc.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

// what a device does not measure it writes as no number beside what it does
bool measured(std::initializer_list<double> values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
}

}  // namespace

DistributerClass LauvVehicle::describe_class() {
  return {"LauvVehicle",
          "the submarine, over IMC",
          {{"motion", Direction::in, &type_of<tasks::Motion>(), "position, attitude and velocities"},
           {"actuation", Direction::out, &type_of<tasks::Actuation>(), "commands for propeller and fins"},
           {"instruments", Direction::in, &type_of<tasks::Instruments>(), "what the instruments tell"}},
          true};
}

const messages::MessageSet& LauvVehicle::message_set() const { return imc::message_set(); }

void LauvVehicle::receive(messages::MessageRef message) {
  receive_motion(message);
  receive_hull(message);
}

void LauvVehicle::note(tasks::Reading& reading, double value) {
  if (!all_finite({value})) return;
  reading = {value, reading.count + 1};
  instruments_fresh_ = true;
}

void LauvVehicle::note(tasks::VectorReading& reading, double x, double y, double z) {
  if (!all_finite({x, y, z})) return;
  reading = {x, y, z, reading.count + 1};
  instruments_fresh_ = true;
}

bool LauvVehicle::all_finite(std::initializer_list<double> values) {
  const bool good = std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (!good) ++non_finite_inputs_;
  return good;
}

void LauvVehicle::receive_motion(messages::MessageRef message) {
  tasks::Instruments& i = instruments_;
  if (const auto* s = message.as<imc::SimulatedState>()) {
    motion_ = {s->x, s->y, s->z, s->phi, s->theta, s->psi, s->u, s->v, s->w, s->p, s->q, s->r};
    motion_fresh_ = true;
  } else if (const auto* e = message.as<imc::EstimatedState>()) {
    motion_ = {e->x, e->y, e->depth, e->phi, e->theta, e->psi, e->u, e->v, e->w, e->p, e->q, e->r};
    motion_fresh_ = true;
  } else if (const auto* angles = message.as<imc::EulerAngles>()) {
    const bool attitude = measured({angles->phi, angles->theta, angles->psi}),
               heading = measured({angles->psi_magnetic});
    if (attitude || !heading) note(i.attitude, angles->phi, angles->theta, angles->psi);
    if (heading || !attitude) note(i.heading, angles->psi_magnetic);
  } else if (const auto* rates = message.as<imc::AngularVelocity>()) {
    note(i.rates, rates->x, rates->y, rates->z);
  } else if (const auto* force = message.as<imc::Acceleration>()) {
    note(i.forces, force->x, force->y, force->z);
  } else if (const auto* speed = message.as<imc::WaterVelocity>()) {
    note(i.velocity, speed->x, speed->y, speed->z);
  } else if (const auto* rpm = message.as<imc::Rpm>()) {
    note(i.rpm, rpm->value);
  } else if (const auto* fix = message.as<imc::GpsFix>()) {
    if ((fix->validity & imc::GpsFix::Validity::VALID_POS) != 0) place(fix->lat, fix->lon);
  }
}

void LauvVehicle::receive_hull(messages::MessageRef message) {
  tasks::Instruments& i = instruments_;
  if (const auto* depth = message.as<imc::Depth>()) {
    note(i.depth, depth->value);
  } else if (const auto* pressure = message.as<imc::Pressure>()) {
    note(i.pressure, pressure->value);
  } else if (const auto* conductivity = message.as<imc::Conductivity>()) {
    note(i.conductivity, conductivity->value);
  } else if (const auto* temperature = message.as<imc::Temperature>()) {
    note(i.water_temperature, temperature->value);
  } else if (const auto* range = message.as<imc::Distance>()) {
    if (range->validity == imc::Distance::Validity::VALID) note(i.altitude, range->value);
  } else if (const auto* entity = message.as<imc::EntityState>()) {
    note(i.leak, entity->state == imc::EntityState::State::FAILURE ? 1 : 0);
  } else if (const auto* voltage = message.as<imc::Voltage>()) {
    note(i.voltage, voltage->value);
  } else if (const auto* current = message.as<imc::Current>()) {
    note(i.current, current->value);
  }
}

// offsets from the first fix along meridian and parallel, WGS-84
void LauvVehicle::place(double latitude, double longitude) {
  if (!all_finite({latitude, longitude})) return;
  if (instruments_.place.count == 0) {
    latitude_ = latitude;
    longitude_ = longitude;
  }
  constexpr double equatorial_radius = 6378137.0, eccentricity_squared = 6.69437999014e-3;
  const double s = std::sin(latitude_), w = 1 - eccentricity_squared * s * s;
  const double east_radius = equatorial_radius / std::sqrt(w);
  note(instruments_.place, (latitude - latitude_) * east_radius * (1 - eccentricity_squared) / w,
       (longitude - longitude_) * east_radius * std::cos(latitude_), 0);
}

// DUNE listens to systems that have announced themselves only.
void LauvVehicle::announce(Duration instant, messages::Receiver& all) {
  if (announced_ && instant - *announced_ < announce_period) return;
  announced_ = instant;
  all.receive(messages::refer_to(make_announce({.name = "jarol", .type = imc::SystemType::CCU, .address = address_})));
}

bool LauvVehicle::take(std::size_t channel, void* value) {
  bool& fresh = channel == 0 ? motion_fresh_ : instruments_fresh_;
  if (!fresh) return false;
  if (channel == 0)
    *static_cast<tasks::Motion*>(value) = motion_;
  else
    *static_cast<tasks::Instruments*>(value) = instruments_;
  fresh = false;
  return true;
}

void LauvVehicle::hand_over(std::size_t, const void* value, messages::Receiver& system) {
  const auto& actuation = *static_cast<const tasks::Actuation*>(value);
  system.receive(messages::refer_to(imc::SetThrusterActuation{0, static_cast<float>(actuation.thruster)}));
  for (std::uint8_t i = 0; i < actuation.fins.size(); ++i)
    system.receive(messages::refer_to(imc::SetServoPosition{i, static_cast<float>(actuation.fins[i])}));
}

}  // namespace jarol::distributers
