#include "vehicles/submarine/sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"
#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"
#include "vehicles/sea/sea_water.h"

namespace jarol::vehicles {
namespace {

namespace imc = messages::imc;

constexpr double air_pressure = 1013.25;                       // hPa
constexpr double longest_range = 100.0, shortest_range = 0.1;  // m, of the altimeter

messages::Message report_entity_labels(std::uint8_t leaks, std::uint8_t hull_temperatures) {
  imc::EntityList entities;
  entities.op = imc::EntityList::Op::REPORT;
  for (std::size_t i = 0; i < 4; ++i) {
    entities.list += fmt::format("{}Leak Sensor {}={}", i == 0 ? "" : ";", i, leaks + i);
    entities.list += fmt::format(";Hull Temperature {}={}", i, hull_temperatures + i);
  }
  return messages::Message(messages::refer_to(entities));
}

messages::Message report_beacons_of(const SeaParameters& sea) {
  const EarthRadii radii = earth_radii(sea.latitude);
  const BeaconParameters* const all[] = {&sea.beacons.first, &sea.beacons.second};
  constexpr std::string_view names[] = {"first", "second"};
  imc::LblConfig config;
  config.op = imc::LblConfig::Op::CUR_CFG;
  for (std::size_t k = 0; k < 2; ++k) {
    imc::LblBeacon beacon;
    beacon.beacon = names[k];
    beacon.lat = sea.latitude + all[k]->north / radii.north;
    beacon.lon = wrapped(sea.longitude + all[k]->east / radii.east);
    beacon.depth = static_cast<float>(all[k]->depth);
    messages::InlineMessage packed;
    messages::put_inline(messages::refer_to(beacon), packed);
    config.beacons.push_back(packed);
  }
  return messages::Message(messages::refer_to(config));
}

}  // namespace

SubmarineSensors::SubmarineSensors(const SubmarineSensorParameters& p, const SeaParameters& sea, double floating_depth,
                                   std::uint64_t seed)
    : sea_(sea),
      antenna_depth_(floating_depth + 0.1),
      conductivity_(calc_conductivity(sea.temperature, sea.salinity)),
      depth_(p.depth, "depth", seed),
      pressure_(p.pressure, "pressure", seed),
      conductivity_cell_(p.conductivity, "conductivity", seed),
      water_temperature_(p.water_temperature, "water_temperature", seed),
      attitude_(p.imu_attitude, "imu_attitude", seed, 3),
      rates_(p.imu_rates, "imu_rates", seed, 3),
      forces_(p.imu_forces, "imu_forces", seed, 3),
      compass_(p.compass, "compass", seed),
      speed_(p.speed_log, "speed_log", seed, 3),
      rpm_(p.rpm, "rpm", seed),
      gps_(p.gps, "gps", seed, 2),
      altitude_(p.altitude, "altitude", seed),
      voltage_(p.voltage, "voltage", seed),
      current_(p.current, "current", seed),
      leaks_{Sensor(p.leak, "leak", seed), Sensor(p.leak1, "leak1", seed), Sensor(p.leak2, "leak2", seed),
             Sensor(p.leak3, "leak3", seed)},
      hull_temperatures_{Sensor(p.hull_temperature, "hull_temperature", seed),
                         Sensor(p.hull_temperature1, "hull_temperature1", seed),
                         Sensor(p.hull_temperature2, "hull_temperature2", seed),
                         Sensor(p.hull_temperature3, "hull_temperature3", seed)},
      ranges_{Sensor(p.range, "range_first", seed), Sensor(p.range, "range_second", seed)},
      servos_{Sensor(p.servos, "servo0", seed), Sensor(p.servos, "servo1", seed), Sensor(p.servos, "servo2", seed),
              Sensor(p.servos, "servo3", seed)},
      entities_(report_entity_labels(leak_entity, hull_temperature_entity)),
      beacons_(report_beacons_of(sea)) {}

void SubmarineSensors::serialize(Archive& archive) {
  archive(seconds_, depth_, pressure_, conductivity_cell_, water_temperature_, attitude_, rates_, forces_, compass_,
          speed_, rpm_, gps_, altitude_, leaks_, hull_temperatures_, voltage_, current_, ranges_, servos_, step_,
          readings_);
}

void SubmarineSensors::step(std::int64_t step, const SubmarineScene& scene) {
  using Values = Sensor::Values;
  const fossen::Vector6 &eta = scene.at.eta, &nu = scene.at.nu, &nu_dot = scene.at.nu_dot;
  const fossen::Vector3 down_b = down_in_body(eta[3], eta[4]);
  seconds_ = static_cast<double>(step) * SubmarineMotion::step_seconds;
  step_ = step;

  // both gauges feel pressure
  const double head = std::max(eta[2] + scene.head, 0.0);
  depth_.step(step, Values{scene.depth > 0.0 ? head : scene.depth});
  pressure_.step(step, Values{air_pressure + 0.01 * sea_.density * sea_.gravity * (scene.depth > 0.0 ? head : 0.0)});
  conductivity_cell_.step(step, Values{conductivity_});
  water_temperature_.step(step, Values{sea_.temperature});

  // what an accelerometer at the origin feels: acceleration less gravity
  const fossen::Vector3 turning = fossen::cross({nu[3], nu[4], nu[5]}, {nu[0], nu[1], nu[2]});
  Values force{}, through_water{};
  for (std::size_t i = 0; i < 3; ++i) {
    force[i] = nu_dot[i] + turning[i] - sea_.gravity * down_b[i];
    through_water[i] = nu[i] - scene.water_b[i];
  }
  attitude_.step(step, Values{eta[3], eta[4], eta[5]});
  rates_.step(step, Values{nu[3], nu[4], nu[5]});
  forces_.step(step, force);
  compass_.step(step, Values{eta[5]});
  speed_.step(step, through_water);
  rpm_.step(step, Values{scene.rpm});

  const bool surfaced = scene.depth < antenna_depth_;
  gps_.step(step, surfaced ? std::optional(Values{scene.north, scene.east}) : std::nullopt);
  const double range = (sea_.floor - eta[2]) / std::max(down_b[2], 1e-3);
  const bool echo = range > shortest_range && range < longest_range;
  altitude_.step(step, echo ? std::optional(Values{range}) : std::nullopt);

  const BeaconParameters* const beacons[] = {&sea_.beacons.first, &sea_.beacons.second};
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    const BeaconParameters& b = *beacons[k];
    const double away = std::hypot(b.north - scene.north, b.east - scene.east, b.depth - eta[2]);
    ranges_[k].step(step, away < sea_.beacons.reach ? std::optional(Values{away}) : std::nullopt);
  }

  for (Sensor& leak : leaks_) leak.step(step, Values{scene.leak ? 1.0 : 0.0});
  for (Sensor& thermometer : hull_temperatures_) thermometer.step(step, Values{sea_.temperature + scene.hull_warmth});
  voltage_.step(step, Values{scene.voltage});
  current_.step(step, Values{scene.current});
  for (std::size_t i = 0; i < servos_.size(); ++i) servos_[i].step(step, Values{scene.servos[i]});
  note();
}

void SubmarineSensors::note() {
  SubmarineReadings& r = readings_;
  r.depth = depth_.value();
  r.pressure = pressure_.value();
  r.conductivity = conductivity_cell_.value();
  r.water_temperature = water_temperature_.value();
  r.salinity = calc_salinity(r.conductivity, r.water_temperature);
  r.sound_speed = calc_sound_speed(r.water_temperature, r.salinity,
                                   (r.pressure - air_pressure) / (0.01 * sea_.density * sea_.gravity));
  r.phi = attitude_.values()[0];
  r.theta = attitude_.values()[1];
  r.psi = wrapped(attitude_.values()[2]);
  r.p = rates_.values()[0];
  r.q = rates_.values()[1];
  r.r = rates_.values()[2];
  r.f_x = forces_.values()[0];
  r.f_y = forces_.values()[1];
  r.f_z = forces_.values()[2];
  r.heading = wrapped(compass_.value());
  r.u = speed_.values()[0];
  r.v = speed_.values()[1];
  r.w = speed_.values()[2];
  r.rpm = rpm_.value();
  r.gps_north = gps_.values()[0];
  r.gps_east = gps_.values()[1];
  r.altitude = altitude_.value();
  r.leak = leaks_[0].value();
  r.hull_temperature = hull_temperatures_[0].value();
  r.voltage = voltage_.value();
  r.current = current_.value();
  r.range_first = ranges_[0].value();
  r.range_second = ranges_[1].value();
}

SubmarineHullReadings SubmarineSensors::hull_readings() const {
  return {leaks_[1].value(),
          leaks_[2].value(),
          leaks_[3].value(),
          hull_temperatures_[1].value(),
          hull_temperatures_[2].value(),
          hull_temperatures_[3].value()};
}

}  // namespace jarol::vehicles
