#include "distributers/javiator/operator.h"

#include <algorithm>
#include <cmath>

#include "graph/math/rotations.h"

namespace jarol::distributers {
namespace {

// its numbers have 16 bits and no fractions
std::int16_t to_wire(double value) {
  return static_cast<std::int16_t>(std::clamp(std::trunc(value), -32768.0, 32767.0));
}

std::int16_t milli(double value) { return to_wire(1e3 * value); }

// the low 16 bits, as it sends them
std::int16_t low_word(double value) { return static_cast<std::int16_t>(static_cast<std::int64_t>(value) & 0xffff); }

// it knows no landing: as long as it may be in the air, it flies
std::uint8_t state_of(tasks::FlightState state) {
  using Shown = javiator::StateMode::State;
  switch (state) {
    case tasks::FlightState::halt: return Shown::SHUTDOWN;
    case tasks::FlightState::ground: return Shown::GROUND;
    case tasks::FlightState::starting:
    case tasks::FlightState::flying:
    case tasks::FlightState::landing: break;
  }
  return Shown::FLYING;
}

javiator::MotorOffsets effort(const std::array<double, 4>& signals) {
  const auto [front, right, rear, left] = signals;
  return {to_wire((left - right) / 2), to_wire((front - rear) / 2), to_wire((right + left - front - rear) / 4),
          to_wire((front + right + rear + left) / 4)};
}

// all of them are reported as thousandths
template <class Params>
tasks::ReceivedGains gains_of(const Params& p) {
  return {{1e-3 * p.kp, 1e-3 * p.ki, 1e-3 * p.kd, 1e-3 * p.kdd}, true};
}

std::uint32_t clock_of(Duration instant) { return static_cast<std::uint32_t>(instant.count() / 1000 % 1'000'000'000); }

}  // namespace

JaviatorOperator::JaviatorOperator(const JaviatorOperatorParameters& parameters)
    : trim_file_(parameters.trim_file.view()), state_(state_of(tasks::FlightState::halt)) {
  if (!trim_file_.empty()) kept_ = trim_ = read_trim(trim_file_);
  command_.kept_trim_roll = kept_.roll;
  command_.kept_trim_pitch = kept_.pitch;
}

void JaviatorOperator::lean_gains(const javiator::RollPitchParams& p) { in.gains.renew().lean = gains_of(p); }

void JaviatorOperator::yaw_gains(const javiator::YawParams& p) { in.gains.renew().yaw = gains_of(p); }

void JaviatorOperator::altitude_gains(const javiator::AltParams& p) { in.gains.renew().altitude = gains_of(p); }

void JaviatorOperator::position_gains(const javiator::XYParams& p) { in.gains.renew().position = gains_of(p); }

void JaviatorOperator::idle_limit(const javiator::IdleLimit& limit) {
  in.gains.renew().idle = {static_cast<double>(limit.idle), true};
}

// The same two numbers say how it shall lean, or where it shall be.
void JaviatorOperator::command_data(const javiator::CommandData& c) {
  command_.roll = 1e-3 * c.roll;
  command_.pitch = 1e-3 * c.pitch;
  command_.y = command_.roll;
  command_.x = command_.pitch;
  command_.yaw = 1e-3 * c.yaw;
  command_.altitude = 1e-3 * c.z;
  command_.heard = true;
  hello_due_ = false;
}

void JaviatorOperator::switch_state(const javiator::SwitchState&) {
  if (!hello_due_) ++command_.state_switches;
  hello_due_ = false;
}

void JaviatorOperator::finish() {
  if (!trim_file_.empty() && std::exchange(kept_, trim_) != trim_) write_trim(trim_file_, trim_);
}

tasks::PilotCommand JaviatorOperator::take_command() {
  const tasks::PilotCommand taken = command_;
  command_.heard = false;
  period_ = now_ - taken_;
  taken_ = now_;
  return taken;
}

void JaviatorOperator::send_report(const tasks::HelicopterReport& report, messages::Receiver& system) {
  const Eigen::Vector3d rates = 1e3 * euler_rates(report.roll, report.pitch, {report.p, report.q, report.r});  // mrad/s
  // what it calls acceleration is less than a third of it at 15 ms
  const auto gain = [&](Eigen::Index axis) { return to_wire(19.79 * (rates[axis] - rates_[axis])); };
  const auto& signals = report.signals;
  const std::uint8_t state = state_of(report.state);
  const javiator::GroundReport shown{
      .sensors = {.roll = milli(report.roll),
                  .pitch = milli(report.pitch),
                  .yaw = milli(report.yaw),
                  .droll = to_wire(rates[0]),
                  .dpitch = to_wire(rates[1]),
                  .dyaw = to_wire(rates[2]),
                  .ddroll = gain(0),
                  .ddpitch = gain(1),
                  .ddyaw = gain(2),
                  .x = milli(report.x),
                  .y = milli(report.y),
                  .z = milli(report.altitude),
                  .dx = milli(report.v_x),
                  .dy = milli(report.v_y),
                  .dz = milli(report.climb),
                  .ddx = milli(report.a_x),
                  .ddy = milli(report.a_y),
                  .ddz = milli(report.a_up),
                  .maps = low_word(1e3 * report.pressure),
                  .temp = to_wire(100 * report.temperature),
                  .batt = milli(report.battery)},
      .signals = {to_wire(signals[0]), to_wire(signals[1]), to_wire(signals[2]), to_wire(signals[3]), ++reports_},
      .offsets = effort(signals),
      .state_mode = {state, command_.mode_switches % 2 == 1 ? javiator::StateMode::Mode::POSITION
                                                            : javiator::StateMode::Mode::MANUAL}};
  // logical time: what a period does, it does at its instants of input and output
  const javiator::TraceData trace{.cmd_roll = milli(report.roll_goal),
                                  .cmd_pitch = milli(report.pitch_goal),
                                  .period_ms = to_wire(1e-6 * static_cast<double>(period_.count())),
                                  .state = state_,
                                  .t_loop_start = clock_of(taken_),
                                  .t_sent_to_plant = clock_of(taken_),
                                  .t_data_from_plant = clock_of(taken_),
                                  .t_terminal_input = clock_of(taken_),
                                  .t_control = clock_of(now_),
                                  .t_report = clock_of(reported_)};
  trim_ = {report.trim_roll, report.trim_pitch};
  system.receive(messages::refer_to(shown));
  system.receive(messages::refer_to(trace));
  rates_ = rates;
  state_ = state;
  reported_ = now_;
}

}  // namespace jarol::distributers
