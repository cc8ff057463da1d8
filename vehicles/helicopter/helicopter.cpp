#include "vehicles/helicopter/helicopter.h"

#include <algorithm>
#include <cmath>

#include "distributers/messages/javiator_units.h"
#include "graph/math/euler_angles.h"
#include "graph/math/rotations.h"
#include "graph/values/seed.h"
#include "vehicles/helicopter/coefficients.h"
#include "vehicles/helicopter/plant.h"
#include "vehicles/helicopter/rigid_plant.h"

namespace jarol::vehicles {
namespace {

double setting_of(const HelicopterParameters& p, double signal, double voltage) {
  return signal / max_signal * voltage / p.rotors.reference_voltage;
}

std::unique_ptr<HelicopterDynamics> make_plant(const HelicopterParameters& p, const HelicopterMotion& start) {
  const double setting = setting_of(p, p.start.signal, p.rotors.reference_voltage);
  const std::array<double, 4> settings{setting, setting, setting, setting};
  if (p.dynamics == Dynamics::rigid) return std::make_unique<RigidHelicopter>(make_body(p), start, settings);
  return std::make_unique<HelicopterPlant>(make_body(p), start, settings);
}

HelicopterReadings readings_of(const messages::javiator::JaviatorData& data) {
  namespace javiator = messages::javiator;
  HelicopterReadings r;
  r.roll = javiator::radians_per_count * data.roll;
  r.pitch = javiator::radians_per_count * data.pitch;
  r.yaw = javiator::radians_per_count * data.yaw;
  r.droll = javiator::radians_per_second_per_count * data.droll;
  r.dpitch = javiator::radians_per_second_per_count * data.dpitch;
  r.dyaw = javiator::radians_per_second_per_count * data.dyaw;
  r.ddx = javiator::newtons_per_kilogram_per_count * data.ddx;
  r.ddy = javiator::newtons_per_kilogram_per_count * data.ddy;
  r.ddz = javiator::newtons_per_kilogram_per_count * data.ddz;
  r.sonar = javiator::sonar_metres_per_count * data.sonar;
  r.x_laser = javiator::metres_of(data.x_pos);
  r.y_laser = javiator::metres_of(data.y_pos);
  r.pressure = javiator::pascals_per_count * data.maps;
  r.temperature = javiator::celsius_of(data.temp);
  r.voltage = javiator::volts_per_count * data.batt;
  return r;
}

}  // namespace

Helicopter::Helicopter(const HelicopterParameters& parameters, std::uint64_t seed)
    : parameters_(parameters),
      plant_(make_plant(parameters, make_start(parameters))),
      battery_(parameters.battery),
      wind_(parameters.air, spread_seed(seed, "wind")),
      sensors_(parameters, seed),
      signals_(parameters.packets, spread_seed(seed, "packets.signals")),
      answers_(parameters.packets, spread_seed(seed, "packets.answers")),
      sonars_(parameters.packets, spread_seed(seed, "packets.sonars")),
      voltage_(battery_.calc_voltage(0.0)),
      judge_(parameters, plant_->motion()),
      seed_(seed),
      motors_{FailingActuator(parameters.failures.front, spread_seed(seed, "front.failure")),
              FailingActuator(parameters.failures.right, spread_seed(seed, "right.failure")),
              FailingActuator(parameters.failures.rear, spread_seed(seed, "rear.failure")),
              FailingActuator(parameters.failures.left, spread_seed(seed, "left.failure"))},
      payload_until_(draw_begin(parameters.payload.at, parameters.payload.chance, spread_seed(seed, "payload"))) {
  sensors_.sample(0, scene());
  sensors_.sample_imu(0, scene());
  report_outputs(0.0);
}

Helicopter::~Helicopter() = default;

std::chrono::nanoseconds Helicopter::grid() const {
  return std::chrono::nanoseconds(HelicopterDynamics::step_nanoseconds);
}

const HelicopterMotion& Helicopter::motion() const { return plant_->motion(); }

HelicopterSensors::Scene Helicopter::scene() const { return {plant_->motion(), plant_->specific_force(), voltage_}; }

HelicopterSensors::Scene Helicopter::scene_without_force() const { return {plant_->motion(), {}, voltage_}; }

void Helicopter::accept(messages::MessageRef command) {
  if (const auto* signals = command.as<messages::javiator::MotorSignals>()) {
    signals_.send(*signals, nanoseconds_);
    hear_signals();
  } else if (!parameters_.packets.is_cut(1e-9 * static_cast<double>(nanoseconds_))) {
    robostix_.accept(command);
  }
}

void Helicopter::hear_signals() {
  for (const auto& packet : signals_.arrive(nanoseconds_)) robostix_.accept(messages::refer_to(packet.message));
}

void Helicopter::step() {
  hear_signals();
  constexpr double seconds = 1e-9 * HelicopterDynamics::step_nanoseconds;
  wind_.step(seconds);
  HelicopterCommand command;
  command.wind_n = wind_.now(-plant_->motion().p_n[2]);
  const double time = 1e-9 * static_cast<double>(nanoseconds_);
  for (std::size_t i = 0; i < 4; ++i) {
    const double signal = std::max(motors_[i].command(time, robostix_.signals()[i], max_signal), 0.0);
    if (!motors_[i].is_stuck(time)) settings_[i] = setting_of(parameters_, signal, voltage_);
    const double part = motors_[i].part(time);
    const double slower = part == 1.0 ? 1.0 : std::pow(part, 1.0 / parameters_.rotors.thrust_exponent);
    command.settings[i] = slower * settings_[i];
  }
  command.payload = time < payload_until_ ? parameters_.payload.mass : 0.0;
  plant_->step(command);
  nanoseconds_ += HelicopterDynamics::step_nanoseconds;
  judge_.look(std::chrono::nanoseconds(nanoseconds_), plant_->motion(), plant_->settings());

  const double current = battery_.calc_current(plant_->thrusts());
  battery_.draw(current, seconds);
  voltage_ = battery_.calc_voltage(current);
  report_outputs(current);

  sensors_.sample(nanoseconds_, scene_without_force());
  robostix_.step();
  if (robostix_.answers()) {
    answer_ = sensors_.answer(robostix_.id());
    const bool is_new = (answer_.flags & messages::javiator::JaviatorData::Flags::SONAR) != 0;
    if (is_new && robostix_.reports_each_sonar() && parameters_.sensors.sonars == 4)
      sonars_.send(sensors_.each_sonar(robostix_.id()), nanoseconds_);
    answers_.send(answer_, nanoseconds_);
    outputs_.sensors = readings_of(answer_);
    sensors_.sample_imu(nanoseconds_, scene());
  }
  sonars_.arrive(nanoseconds_);
  answers_.arrive(nanoseconds_);
}

void Helicopter::report_outputs(double current) {
  const std::array<double, 4>& reached = plant_->settings();
  outputs_.rotors = {max_signal * reached[0], max_signal * reached[1], max_signal * reached[2],
                     max_signal * reached[3]};
  outputs_.battery = {voltage_, current};
}

void Helicopter::serialize(Archive& archive) {
  plant_->serialize(archive);
  archive(robostix_, battery_, wind_, sensors_, voltage_, outputs_, judge_, settings_, nanoseconds_);
  archive.bytes(&answer_, sizeof answer_);
  archive(signals_, answers_, sonars_);
}

VehicleState Helicopter::state() const {
  const HelicopterMotion m = plant_->motion();
  const EulerAngles attitude = euler_angles_of(m.R_nb);
  return {m.p_n[0], m.p_n[1], m.p_n[2], attitude.roll, attitude.pitch, attitude.yaw,
          m.v_b[0], m.v_b[1], m.v_b[2], m.omega_b[0],  m.omega_b[1],   m.omega_b[2]};
}

void Helicopter::place(const VehicleState& s) {
  HelicopterMotion motion;
  motion.p_n = {s.x, s.y, s.z};
  const Eigen::Matrix3d R_nb = rotation_of(s.phi, s.theta, s.psi);
  for (int i = 0; i < 3; ++i) motion.R_nb[static_cast<std::size_t>(i)] = {R_nb(i, 0), R_nb(i, 1), R_nb(i, 2)};
  motion.v_b = {s.u, s.v, s.w};
  motion.omega_b = {s.p, s.q, s.r};
  plant_ = make_plant(parameters_, motion);
  judge_ = HelicopterJudge(parameters_, motion);
  // what the sensors report at the start; they begin anew
  sensors_ = HelicopterSensors(parameters_, seed_);
  sensors_.sample(0, scene());
  sensors_.sample_imu(0, scene());
}

void Helicopter::command(const void* inputs) {
  namespace javiator = messages::javiator;
  const auto& in = *static_cast<const HelicopterInputs*>(inputs);
  const auto signal = [](double value) { return static_cast<std::int16_t>(std::lround(value)); };
  robostix_.accept(messages::refer_to(javiator::SwitchState{}));
  robostix_.accept(messages::refer_to(
      javiator::MotorSignals{signal(in.front), signal(in.right), signal(in.rear), signal(in.left), 0}));
}

void Helicopter::sense(messages::Receiver& receiver) const {
  for (const auto& packet : sonars_.arrived()) receiver.receive(messages::refer_to(packet.message));
  for (const auto& packet : answers_.arrived()) receiver.receive(messages::refer_to(packet.message));
}

}  // namespace jarol::vehicles
