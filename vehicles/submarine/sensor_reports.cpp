// The messages in which the submarine's instruments report.
#include <algorithm>
#include <cmath>

#include "distributers/messages/imc.h"
#include "distributers/messages/imc_entity.h"
#include "graph/math/geometry.h"
#include "vehicles/submarine/sensors.h"

namespace jarol::vehicles {
namespace {

namespace imc = messages::imc;

constexpr std::int64_t beacons_period = 1000;  // steps between two messages that report where they lie
constexpr std::int64_t entities_period = 100;  // likewise, of the labels of entities

template <class Message>
void report_value(messages::Receiver& receiver, const Sensor& sensor) {
  if (!sensor.reported()) return;
  Message message;
  message.value = static_cast<decltype(message.value)>(sensor.value());
  receiver.receive(messages::refer_to(message));
}

template <class Message>
void report_vector(messages::Receiver& receiver, const Sensor& sensor, Message message) {
  if (!sensor.reported()) return;
  message.x = sensor.values()[0];
  message.y = sensor.values()[1];
  message.z = sensor.values()[2];
  receiver.receive(messages::refer_to(message));
}

}  // namespace

void SubmarineSensors::report(messages::Receiver& receiver) const {
  report_entities(receiver);
  report_motion(receiver);
  report_servos(receiver);
  report_water(receiver);
  report_hull(receiver);
  report_place(receiver);
  report_beacons(receiver);
}

// One with entities might steer itself, as DUNE does: this one does not, and says so before any of them is heard.
void SubmarineSensors::report_entities(messages::Receiver& receiver) const {
  if (step_ % entities_period != 0) return;
  imc::VehicleState state;
  state.maneuver_type = state.maneuver_eta = 0xffff;
  receiver.receive(messages::refer_to(state));
  receiver.receive(entities_);
}

void SubmarineSensors::report_motion(messages::Receiver& receiver) const {
  // the IMU reports true north, the compass the magnetic one; here they are the same. What a device does not measure is
  // no number
  if (attitude_.reported() || compass_.reported()) {
    constexpr double unknown = SubmarineReadings::unknown;
    imc::EulerAngles angles;
    angles.time = seconds_;
    angles.phi = attitude_.reported() ? readings_.phi : unknown;
    angles.theta = attitude_.reported() ? readings_.theta : unknown;
    angles.psi = attitude_.reported() ? readings_.psi : unknown;
    angles.psi_magnetic = compass_.reported() ? readings_.heading : unknown;
    receiver.receive(messages::refer_to(angles));
  }
  imc::AngularVelocity rates;
  rates.time = seconds_;
  report_vector(receiver, rates_, rates);
  imc::Acceleration force;
  force.time = seconds_;
  report_vector(receiver, forces_, force);
  imc::WaterVelocity velocity;
  velocity.validity = 7;
  report_vector(receiver, speed_, velocity);
  if (rpm_.reported()) {
    imc::Rpm rpm;
    rpm.value = static_cast<std::int16_t>(std::lround(std::clamp(rpm_.value(), -32768.0, 32767.0)));
    receiver.receive(messages::refer_to(rpm));
  }
}

void SubmarineSensors::report_servos(messages::Receiver& receiver) const {
  for (std::uint8_t i = 0; i < servos_.size(); ++i)
    if (servos_[i].reported())
      receiver.receive(messages::refer_to(imc::ServoPosition{i, static_cast<float>(servos_[i].value())}));
}

void SubmarineSensors::report_water(messages::Receiver& receiver) const {
  report_value<imc::Depth>(receiver, depth_);
  report_value<imc::Pressure>(receiver, pressure_);
  report_value<imc::Conductivity>(receiver, conductivity_cell_);
  report_value<imc::Temperature>(receiver, water_temperature_);
  if (!conductivity_cell_.reported()) return;
  imc::Salinity salinity;
  salinity.value = static_cast<float>(readings_.salinity);
  receiver.receive(messages::refer_to(salinity));
  imc::SoundSpeed speed;
  speed.value = static_cast<float>(readings_.sound_speed);
  receiver.receive(messages::refer_to(speed));
}

void SubmarineSensors::report_hull(messages::Receiver& receiver) const {
  using State = imc::EntityState::State;
  for (std::uint8_t i = 0; i < leaks_.size(); ++i) {
    if (!leaks_[i].reported()) continue;
    imc::EntityState state;
    state.state = leaks_[i].value() > 0.5 ? State::FAILURE : State::NORMAL;
    imc::send_from(leak_entity + i, state, receiver);
  }
  for (std::uint8_t i = 0; i < hull_temperatures_.size(); ++i)
    if (hull_temperatures_[i].reported())
      imc::send_from(hull_temperature_entity + i, imc::Temperature{static_cast<float>(hull_temperatures_[i].value())},
                     receiver);
  report_value<imc::Voltage>(receiver, voltage_);
  report_value<imc::Current>(receiver, current_);
}

void SubmarineSensors::report_place(messages::Receiver& receiver) const {
  if (gps_.reported()) {
    const EarthRadii radii = earth_radii(sea_.latitude);
    imc::GpsFix fix;
    fix.validity = imc::GpsFix::Validity::VALID_POS;
    fix.type = imc::GpsFix::Type::SIMULATION;
    fix.lat = sea_.latitude + gps_.values()[0] / radii.north;
    fix.lon = wrapped(sea_.longitude + gps_.values()[1] / radii.east);
    receiver.receive(messages::refer_to(fix));
  }
  if (altitude_.reported()) {
    imc::Distance distance;
    distance.validity = imc::Distance::Validity::VALID;
    distance.value = static_cast<float>(altitude_.value());
    receiver.receive(messages::refer_to(distance));
  }
}

void SubmarineSensors::report_beacons(messages::Receiver& receiver) const {
  if (sea_.beacons.reach > 0.0 && step_ % beacons_period == 0) receiver.receive(beacons_);
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    if (ranges_[k].reported())
      receiver.receive(messages::refer_to(
          imc::LblRange{static_cast<std::uint8_t>(k), static_cast<float>(std::max(ranges_[k].value(), 0.0))}));
}

}  // namespace jarol::vehicles
