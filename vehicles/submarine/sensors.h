// The submarine's instruments: what each measures, and the messages in which it reports.
#pragma once

#include <array>

#include "distributers/messages/message.h"
#include "vehicles/sea/sea_parameters.h"
#include "vehicles/submarine/io.h"
#include "vehicles/submarine/motion.h"
#include "vehicles/submarine/sensor.h"

namespace jarol::vehicles {

/// What there is to measure.
struct SubmarineScene {
  PlantState at;
  double north = 0.0, east = 0.0;  // over ground
  double depth = 0.0;              // below the surface as it is there
  double head = 0.0;               // of the waves' pressure
  fossen::Vector3 water_b{};       // velocity of the water
  double rpm = 0.0;
  bool leak = false;
  double hull_warmth = 0.0;  // K above the water
  double voltage = 0.0, current = 0.0;
  std::array<double, 4> servos{};
};

class SubmarineSensors {
 public:
  /// The antenna reaches out of the water where the hull floats. Throws InputError for what no sensor can be.
  SubmarineSensors(const SubmarineSensorParameters& parameters, const SeaParameters& sea, double floating_depth,
                   std::uint64_t seed);

  /// At a step of the vehicle, each once.
  void step(std::int64_t step, const SubmarineScene& scene);

  const SubmarineReadings& readings() const { return readings_; }
  SubmarineHullReadings hull_readings() const;

  void serialize(Archive& archive);

  /// Sends the readings that came at this step.
  void report(messages::Receiver& receiver) const;

 private:
  // of the first; several report the same, and so are entities of their own, where all else comes from none
  static constexpr std::uint8_t leak_entity = 1, hull_temperature_entity = 5;

  void note();
  void report_entities(messages::Receiver& receiver) const;
  void report_motion(messages::Receiver& receiver) const;
  void report_water(messages::Receiver& receiver) const;
  void report_servos(messages::Receiver& receiver) const;
  void report_hull(messages::Receiver& receiver) const;
  void report_place(messages::Receiver& receiver) const;
  void report_beacons(messages::Receiver& receiver) const;

  SeaParameters sea_;
  double antenna_depth_ = 0.0;
  double conductivity_ = 0.0;
  double seconds_ = 0.0;
  std::int64_t step_ = 0;
  Sensor depth_, pressure_, conductivity_cell_, water_temperature_, attitude_, rates_, forces_, compass_, speed_, rpm_,
      gps_, altitude_, voltage_, current_;
  std::array<Sensor, 4> leaks_, hull_temperatures_;
  std::array<Sensor, 2> ranges_;
  std::array<Sensor, 4> servos_;
  messages::Message entities_;  // their labels
  messages::Message beacons_;   // where they lie
  SubmarineReadings readings_;
};

}  // namespace jarol::vehicles
