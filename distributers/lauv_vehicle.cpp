#include "distributers/lauv_vehicle.h"

#include <cmath>

#include "distributers/lauv_messages.h"
#include "distributers/messages/imc.h"

namespace jarol::distributers {
namespace imc = messages::imc;
namespace {

void note(bool& fresh, tasks::Reading& reading, double value) {
  if (!std::isfinite(value)) return;
  reading = {value, reading.count + 1};
  fresh = true;
}

void note(bool& fresh, tasks::VectorReading& reading, double x, double y, double z) {
  if (!std::isfinite(x + y + z)) return;
  reading = {x, y, z, reading.count + 1};
  fresh = true;
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

void LauvVehicle::receive_motion(messages::MessageRef message) {
  tasks::Instruments& i = instruments_;
  if (const auto* s = message.as<imc::SimulatedState>()) {
    motion_ = {s->x, s->y, s->z, s->phi, s->theta, s->psi, s->u, s->v, s->w, s->p, s->q, s->r};
    motion_fresh_ = true;
  } else if (const auto* e = message.as<imc::EstimatedState>()) {
    motion_ = {e->x, e->y, e->depth, e->phi, e->theta, e->psi, e->u, e->v, e->w, e->p, e->q, e->r};
    motion_fresh_ = true;
  } else if (const auto* angles = message.as<imc::EulerAngles>()) {
    note(instruments_fresh_, i.attitude, angles->phi, angles->theta, angles->psi);
    note(instruments_fresh_, i.heading, angles->psi_magnetic);
  } else if (const auto* rates = message.as<imc::AngularVelocity>()) {
    note(instruments_fresh_, i.rates, rates->x, rates->y, rates->z);
  } else if (const auto* force = message.as<imc::Acceleration>()) {
    note(instruments_fresh_, i.forces, force->x, force->y, force->z);
  } else if (const auto* speed = message.as<imc::WaterVelocity>()) {
    note(instruments_fresh_, i.velocity, speed->x, speed->y, speed->z);
  } else if (const auto* rpm = message.as<imc::Rpm>()) {
    note(instruments_fresh_, i.rpm, rpm->value);
  } else if (const auto* fix = message.as<imc::GpsFix>()) {
    if ((fix->validity & imc::GpsFix::Validity::VALID_POS) != 0) place(fix->lat, fix->lon);
  }
}

void LauvVehicle::receive_hull(messages::MessageRef message) {
  tasks::Instruments& i = instruments_;
  if (const auto* depth = message.as<imc::Depth>()) {
    note(instruments_fresh_, i.depth, depth->value);
  } else if (const auto* pressure = message.as<imc::Pressure>()) {
    note(instruments_fresh_, i.pressure, pressure->value);
  } else if (const auto* conductivity = message.as<imc::Conductivity>()) {
    note(instruments_fresh_, i.conductivity, conductivity->value);
  } else if (const auto* temperature = message.as<imc::Temperature>()) {
    note(instruments_fresh_, i.water_temperature, temperature->value);
  } else if (const auto* range = message.as<imc::Distance>()) {
    if (range->validity == imc::Distance::Validity::VALID) note(instruments_fresh_, i.altitude, range->value);
  } else if (const auto* entity = message.as<imc::EntityState>()) {
    note(instruments_fresh_, i.leak, entity->state == imc::EntityState::State::FAILURE ? 1 : 0);
  } else if (const auto* voltage = message.as<imc::Voltage>()) {
    note(instruments_fresh_, i.voltage, voltage->value);
  } else if (const auto* current = message.as<imc::Current>()) {
    note(instruments_fresh_, i.current, current->value);
  }
}

// offsets from the first fix along meridian and parallel, WGS-84
void LauvVehicle::place(double latitude, double longitude) {
  if (!std::isfinite(latitude) || !std::isfinite(longitude)) return;
  if (instruments_.place.count == 0) {
    latitude_ = latitude;
    longitude_ = longitude;
  }
  constexpr double equatorial_radius = 6378137.0, eccentricity_squared = 6.69437999014e-3;
  const double s = std::sin(latitude_), w = 1 - eccentricity_squared * s * s;
  const double east_radius = equatorial_radius / std::sqrt(w);
  note(instruments_fresh_, instruments_.place, (latitude - latitude_) * east_radius * (1 - eccentricity_squared) / w,
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
