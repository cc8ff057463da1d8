#include "vehicle/rover.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "messages/rover.h"

using namespace std::chrono_literals;
namespace messages = jarol::messages;

const messages::MessageSet& Rover::message_set() { return messages::rover::message_set(); }

Rover::Rover(const Parameters& parameters, std::uint64_t) : parameters_(parameters) {
  if (!(parameters.lag > 0)) throw std::runtime_error("'lag' is not above zero");
}

std::chrono::nanoseconds Rover::grid() const { return 10ms; }

void Rover::accept(messages::MessageRef command) {
  const auto* drive = command.as<messages::rover::Drive>();
  if (drive == nullptr || !std::isfinite(drive->speed) || !std::isfinite(drive->turn)) return;
  inputs_.speed = std::clamp<double>(drive->speed, -1, 1);
  inputs_.turn = std::clamp<double>(drive->turn, -2, 2);
}

void Rover::step() {
  const double step = 0.01;
  Motors& motors = outputs_.motors;
  // a first-order lag, its exact solution over a step
  const double share = 1 - std::exp(-step / parameters_.lag);
  motors.speed += share * (inputs_.speed - motors.speed);
  motors.turn += share * (inputs_.turn - motors.turn);
  truth_.heading = std::remainder(truth_.heading + step * motors.turn, 2 * M_PI);
  truth_.north += step * motors.speed * std::cos(truth_.heading);
  truth_.east += step * motors.speed * std::sin(truth_.heading);
}

void Rover::sense(messages::Receiver& receiver) const {
  const messages::rover::Pose pose{.x = static_cast<float>(truth_.north),
                                   .y = static_cast<float>(truth_.east),
                                   .heading = static_cast<float>(truth_.heading)};
  receiver.receive(messages::refer_to(pose));
}

const jarol::Type* Rover::true_type() const { return &jarol::type_of<Truth>(); }

void Rover::serialize(jarol::Archive& archive) {
  archive(inputs_.speed, inputs_.turn, outputs_.motors.speed, outputs_.motors.turn, truth_.north, truth_.east,
          truth_.heading);
}

jarol::vehicles::VehicleState Rover::state() const {
  return {.x = truth_.north,
          .y = truth_.east,
          .psi = truth_.heading,
          .u = outputs_.motors.speed,
          .r = outputs_.motors.turn};
}

void Rover::place(const jarol::vehicles::VehicleState& state) {
  truth_ = {.north = state.x, .east = state.y, .heading = state.psi};
  outputs_.motors = {.speed = state.u, .turn = state.r};
}

void Rover::command(const void* inputs) { inputs_ = *static_cast<const Inputs*>(inputs); }
