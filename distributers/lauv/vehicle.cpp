#include "distributers/lauv/vehicle.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "distributers/lauv/messages.h"
#include "distributers/messages/payload.h"
#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"

namespace jarol::distributers {

using tasks::Instruments;

namespace {

// well below the time after which an instrument that was not heard is lost
constexpr Duration ask_period = std::chrono::seconds(1);
// DUNE says it each second
constexpr Duration state_patience = std::chrono::seconds(5);
// DUNE says each second which of its loops are on; a plant of it that has none never does
constexpr Duration state_period = std::chrono::seconds(2);
constexpr double flat_earth = 100e3;  // m from the origin, as far as plans go

using P = LauvVehicleParameters;
constexpr std::array leak_parameters{&P::leak, &P::leak1, &P::leak2, &P::leak3};
constexpr std::array hull_parameters{&P::hull_temperature, &P::hull_temperature1, &P::hull_temperature2,
                                     &P::hull_temperature3};

// what a device does not measure it writes as no number beside what it does
bool measured(std::initializer_list<double> values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
}

}  // namespace

LauvVehicle::LauvVehicle(const Param& parameters) : parameters_(parameters) {
  using I = Instruments;
  Instruments& all = in.instruments.value;
  all.latitude = parameters.latitude;
  all.longitude = parameters.longitude;
  const auto leave_out = [&](const LauvInstrument& instrument, auto& reading) {
    if (!instrument.fitted) reading.count = -1;
  };
  constexpr std::tuple readings{std::pair{&P::depth, &I::depth},
                                std::pair{&P::pressure, &I::pressure},
                                std::pair{&P::attitude, &I::attitude},
                                std::pair{&P::rates, &I::rates},
                                std::pair{&P::forces, &I::forces},
                                std::pair{&P::heading, &I::heading},
                                std::pair{&P::velocity, &I::velocity},
                                std::pair{&P::rpm, &I::rpm},
                                std::pair{&P::place, &I::place},
                                std::pair{&P::altitude, &I::altitude},
                                std::pair{&P::conductivity, &I::conductivity},
                                std::pair{&P::water_temperature, &I::water_temperature},
                                std::pair{&P::voltage, &I::voltage},
                                std::pair{&P::current, &I::current}};
  std::apply([&](auto... pair) { (leave_out(parameters_.*(pair.first), all.*(pair.second)), ...); }, readings);
  for (std::size_t k = 0; k < tasks::hull_sensors; ++k) {
    leave_out(parameters_.*leak_parameters[k], all.*tasks::leak_readings[k]);
    leave_out(parameters_.*hull_parameters[k], all.*tasks::hull_readings[k]);
  }
  for (tasks::BeaconReading& beacon : all.beacons) leave_out(parameters_.ranges, beacon);
  for (tasks::ServoReading& servo : in.servos.value.fins) leave_out(parameters_.servos, servo);
}

bool LauvVehicle::is(const LauvInstrument& instrument, const messages::MessageRef& from) {
  if (!instrument.fitted) return false;
  const std::uint8_t sender = Entities::sender_of(from);
  if (sender == Entities::nobody) return true;
  if (!met_) met_ = reached_;
  if (instrument.entity.view() != "*" && !entities_.has_label(sender)) label_lacks_ = true;
  return entities_.is(sender, instrument.entity.view());
}

void LauvVehicle::note(tasks::Reading Instruments::*reading, const LauvInstrument& instrument,
                       const messages::MessageRef& from, double value) {
  if (!is(instrument, from)) return;
  if (Entities::sender_of(from) != Entities::nobody) value *= instrument.scale;
  if (!all_finite({value})) return;
  tasks::Reading& r = in.instruments.renew().*reading;
  r = {value, std::max<std::int64_t>(r.count, 0) + 1};
}

void LauvVehicle::note(tasks::VectorReading Instruments::*reading, const LauvInstrument& instrument,
                       const messages::MessageRef& from, double x, double y, double z) {
  if (!is(instrument, from)) return;
  if (Entities::sender_of(from) != Entities::nobody)
    for (double* part : {&x, &y, &z}) *part *= instrument.scale;
  if (!all_finite({x, y, z})) return;
  tasks::VectorReading& r = in.instruments.renew().*reading;
  r = {x, y, z, std::max<std::int64_t>(r.count, 0) + 1};
}

void LauvVehicle::reach(Duration instant, messages::Receiver& system) {
  reached_ = instant;
  if (!label_lacks_ || (asked_ && instant - *asked_ < ask_period)) return;
  asked_ = instant;
  label_lacks_ = false;
  system.receive(messages::refer_to(imc::EntityList{imc::EntityList::Op::QUERY, ""}));
}

void LauvVehicle::peer_changed() {
  entities_.forget();
  leaks_ = {};
  steers_itself_.reset();
  met_.reset();
  has_said_ = false;
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

void LauvVehicle::angles(const imc::EulerAngles& m, const messages::MessageRef& from) {
  const bool attitude = measured({m.phi, m.theta, m.psi}), heading = measured({m.psi_magnetic});
  if (attitude || !heading) note(&Instruments::attitude, parameters_.attitude, from, m.phi, m.theta, m.psi);
  if (heading || !attitude) note(&Instruments::heading, parameters_.heading, from, m.psi_magnetic);
}

void LauvVehicle::rates(const imc::AngularVelocity& m, const messages::MessageRef& from) {
  note(&Instruments::rates, parameters_.rates, from, m.x, m.y, m.z);
}

// specific force: what is felt, acceleration less gravity
void LauvVehicle::forces(const imc::Acceleration& m, const messages::MessageRef& from) {
  std::array<double, 3> down_b{};
  if (!parameters_.gravity && Entities::sender_of(from) != Entities::nobody) {
    const tasks::VectorReading& at = in.instruments->attitude;
    if (at.count < 1) return;  // without it nobody knows where down is
    down_b = down_in_body(at.x, at.y);
  }
  note(&Instruments::forces, parameters_.forces, from, m.x - gravity * down_b[0], m.y - gravity * down_b[1],
       m.z - gravity * down_b[2]);
}

void LauvVehicle::velocity(const imc::WaterVelocity& m, const messages::MessageRef& from) {
  note(&Instruments::velocity, parameters_.velocity, from, m.x, m.y, m.z);
}

void LauvVehicle::rpm(const imc::Rpm& m, const messages::MessageRef& from) {
  note(&Instruments::rpm, parameters_.rpm, from, m.value);
  // where others drive it, it turns as they want
  if (!steers_itself() && is(parameters_.rpm, from))
    in.servos.renew().propeller = {in.instruments->rpm.value, sent_.thruster, in.instruments->rpm.count};
}

void LauvVehicle::fix(const imc::GpsFix& m, const messages::MessageRef& from) {
  if ((m.validity & imc::GpsFix::Validity::VALID_POS) != 0 && is(parameters_.place, from)) place(m.lat, m.lon);
}

void LauvVehicle::depth(const imc::Depth& m, const messages::MessageRef& from) {
  note(&Instruments::depth, parameters_.depth, from, m.value);
}

void LauvVehicle::pressure(const imc::Pressure& m, const messages::MessageRef& from) {
  note(&Instruments::pressure, parameters_.pressure, from, m.value);
}

void LauvVehicle::conductivity(const imc::Conductivity& m, const messages::MessageRef& from) {
  note(&Instruments::conductivity, parameters_.conductivity, from, m.value);
}

// Of the hull only by the label of who sends it: a message of no entity is of the water, and that of an entity whose
// label is not known yet may be of the hull.
void LauvVehicle::temperature(const imc::Temperature& m, const messages::MessageRef& from) {
  const std::uint8_t sender = Entities::sender_of(from);
  bool may_be_of_hull = false;
  for (std::size_t k = 0; k < tasks::hull_sensors; ++k) {
    const LauvInstrument& sensor = parameters_.*hull_parameters[k];
    if (sender == Entities::nobody || !sensor.fitted) continue;
    if (is(sensor, from)) return note(tasks::hull_readings[k], sensor, from, m.value);
    may_be_of_hull = !entities_.has_label(sender);
  }
  if (!may_be_of_hull) note(&Instruments::water_temperature, parameters_.water_temperature, from, m.value);
}

void LauvVehicle::distance(const imc::Distance& m, const messages::MessageRef& from) {
  if (m.validity == imc::Distance::Validity::VALID) note(&Instruments::altitude, parameters_.altitude, from, m.value);
}

void LauvVehicle::voltage(const imc::Voltage& m, const messages::MessageRef& from) {
  note(&Instruments::voltage, parameters_.voltage, from, m.value);
}

void LauvVehicle::current(const imc::Current& m, const messages::MessageRef& from) {
  note(&Instruments::current, parameters_.current, from, m.value);
}

void LauvVehicle::entity(const imc::EntityState& m, const messages::MessageRef& from) {
  for (std::size_t k = 0; k < leaks_.size(); ++k)
    if (is(parameters_.*leak_parameters[k], from))
      leaks_[k].note(Entities::sender_of(from), m.state == imc::EntityState::State::FAILURE,
                     in.instruments.renew().*tasks::leak_readings[k]);
}

// offsets from the origin along meridian and parallel, the shorter way around the Earth
std::pair<double, double> LauvVehicle::from_origin(double latitude, double longitude) const {
  const Instruments& i = *in.instruments;
  const EarthRadii radii = earth_radii(i.latitude);
  return {(latitude - i.latitude) * radii.north, wrapped(longitude - i.longitude) * radii.east};
}

void LauvVehicle::place(double latitude, double longitude) {
  if (!all_finite({latitude, longitude})) return;
  auto [north, east] = from_origin(latitude, longitude);
  if (in.instruments->place.count < 1 && std::hypot(north, east) > flat_earth) {
    in.instruments.renew().latitude = latitude;
    in.instruments.renew().longitude = longitude;
    north = east = 0;
  }
  tasks::VectorReading& r = in.instruments.renew().place;
  r = {north, east, 0, std::max<std::int64_t>(r.count, 0) + 1};
}

// the configuration that the vehicle has or gets, by the order in it
void LauvVehicle::beacons(const imc::LblConfig& m) {
  if (m.op == imc::LblConfig::Op::GET_CFG) return;
  for (std::size_t k = 0; k < beacons_.size(); ++k) {
    beacons_[k] = {};
    messages::Message message;
    if (k >= m.beacons.size() || !messages::take_inline(imc::message_set(), m.beacons[k], message)) continue;
    if (const auto* b = message.as<imc::LblBeacon>(); b != nullptr && all_finite({b->lat, b->lon, b->depth}))
      beacons_[k] = {true, b->lat, b->lon, b->depth};
  }
}

// of a beacon whose place is known
void LauvVehicle::range(const imc::LblRange& m, const messages::MessageRef& from) {
  if (m.id >= beacons_.size() || !beacons_[m.id].known || !is(parameters_.ranges, from)) return;
  double range = m.range;
  if (Entities::sender_of(from) != Entities::nobody) range *= parameters_.ranges.scale;
  if (!all_finite({range})) return;
  const Beacon& b = beacons_[m.id];
  const auto [north, east] = from_origin(b.latitude, b.longitude);
  tasks::BeaconReading& r = in.instruments.renew().beacons[m.id];
  r = {north, east, b.depth, range, std::max<std::int64_t>(r.count, 0) + 1};
}

// Of one fin, beside where it was sent last.
void LauvVehicle::servo(const imc::ServoPosition& m, const messages::MessageRef& from) {
  if (m.id >= sent_.fins.size() || !is(parameters_.servos, from)) return;
  double angle = m.value;
  if (Entities::sender_of(from) != Entities::nobody) angle *= parameters_.servos.scale;
  if (!all_finite({angle})) return;
  tasks::ServoReading& r = in.servos.renew().fins[m.id];
  // where others send it, it goes as they want
  r = {angle, steers_itself() ? angle : sent_.fins[m.id], std::max<std::int64_t>(r.count, 0) + 1};
}

void LauvVehicle::announce(Duration instant, messages::Receiver& all) {
  if (!announce_timer_.is_due(instant)) return;
  all.receive(
      messages::refer_to(imc::make_announce({.name = "jarol", .type = imc::SystemType::CCU, .address = address_})));
}

void LauvVehicle::vehicle_state(const imc::VehicleState& m) {
  using Loops = imc::CLoopsMask;
  const bool own_loops = (m.control_loops & ~(Loops::EXTERNAL | Loops::NO_OVERRIDE)) != 0;
  steers_itself_ = own_loops ? std::optional(reached_) : std::nullopt;
  has_said_ = true;
}

// What goes on is known at once; what is off the next VehicleState says, as others may be on.
void LauvVehicle::control_loops(const imc::ControlLoops& m) {
  using Loops = imc::CLoopsMask;
  if (m.enable != imc::ControlLoops::Enable::ENABLE || (m.mask & ~(Loops::EXTERNAL | Loops::NO_OVERRIDE)) == 0) return;
  steers_itself_ = reached_;
  has_said_ = true;
}

bool LauvVehicle::steers_itself() const {
  if (steers_itself_) return reached_ - *steers_itself_ < state_patience;
  return met_ && !has_said_ && reached_ - *met_ < state_period;
}

void LauvVehicle::send_actuation(const tasks::Actuation& actuation, messages::Receiver& system) {
  if (steers_itself()) return;
  system.receive(messages::refer_to(imc::SetThrusterActuation{0, static_cast<float>(actuation.thruster)}));
  sent_ = actuation;
  for (std::uint8_t i = 0; i < actuation.fins.size(); ++i)
    system.receive(messages::refer_to(imc::SetServoPosition{i, static_cast<float>(actuation.fins[i])}));
}

}  // namespace jarol::distributers
