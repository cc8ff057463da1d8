#include "vehicles/helicopter.h"

#include <cmath>

#include "vehicles/helicopter_coefficients.h"
#include "vehicles/helicopter_plant.h"

namespace jarol::vehicles {
namespace {

constexpr double most_signal = 16000.0;

double setting_of(const HelicopterParameters& p, double signal, double voltage) {
  return signal / most_signal * voltage / p.rotors.reference_voltage;
}

std::unique_ptr<HelicopterPlant> make_plant(const HelicopterParameters& p) {
  const double setting = setting_of(p, p.start.signal, p.rotors.reference_voltage);
  return std::make_unique<HelicopterPlant>(make_body(p), make_start(p),
                                           std::array<double, 4>{setting, setting, setting, setting});
}

}  // namespace

Helicopter::Helicopter(const HelicopterParameters& parameters)
    : parameters_(parameters),
      plant_(make_plant(parameters)),
      battery_(parameters.battery),
      wind_(parameters.air),
      sensors_(parameters.sensors),
      voltage_(battery_.calc_voltage(0.0)) {
  sensors_.sample(0, scene());
  sensors_.sample_imu(scene());
}

Helicopter::~Helicopter() = default;

std::chrono::nanoseconds Helicopter::grid() const {
  return std::chrono::nanoseconds(HelicopterPlant::step_nanoseconds);
}

HelicopterMotion Helicopter::motion() const { return plant_->motion(); }

HelicopterSensors::Scene Helicopter::scene() const { return {plant_->motion(), plant_->specific_force(), voltage_}; }

void Helicopter::step() {
  constexpr double seconds = 1e-9 * HelicopterPlant::step_nanoseconds;
  wind_.step(seconds);
  HelicopterCommand command;
  command.wind_n = wind_.now();
  for (std::size_t i = 0; i < 4; ++i) command.settings[i] = setting_of(parameters_, robostix_.signals()[i], voltage_);
  plant_->step(command);
  nanoseconds_ += HelicopterPlant::step_nanoseconds;

  // a rotor's thrust as a part of its full thrust
  std::array<double, 4> thrusts = plant_->settings();
  for (double& part : thrusts) part = std::pow(part, parameters_.rotors.thrust_exponent);
  const double current = battery_.calc_current(thrusts);
  battery_.draw(current, seconds);
  voltage_ = battery_.calc_voltage(current);

  sensors_.sample(nanoseconds_, scene());
  robostix_.step();
  if (!robostix_.answers()) return;
  answer_ = sensors_.answer(robostix_.id());
  sensors_.sample_imu(scene());
}

void Helicopter::sense(messages::Receiver& receiver) const {
  if (robostix_.answers()) receiver.receive(messages::refer_to(answer_));
}

}  // namespace jarol::vehicles
