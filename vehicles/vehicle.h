// A simulated vehicle as the rest of Jarol sees it: messages in, messages out, one grid step at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "distributers/messages/message.h"

namespace jarol::vehicles {

/// Stands at a whole number of its own grid steps since the start. Who looks, or how often, changes nothing.
class Vehicle {
 public:
  virtual ~Vehicle() = default;

  /// Length of one step; instants at which anything touches the vehicle are multiples of it.
  virtual std::chrono::nanoseconds grid() const = 0;

  /// Takes a command; it is held until the next of its kind. Others than the vehicle's own are ignored.
  virtual void accept(messages::MessageRef command) = 0;

  /// Advances by one grid step with the commands it holds.
  virtual void step() = 0;

  /// Sends what its sensors sample at the present instant.
  virtual void sense(messages::Receiver& receiver) const = 0;
};

/// A kind of vehicle, by the name that its parameter files give.
struct VehicleClass {
  std::string name;
  std::string summary;
  const Type* parameters = nullptr;
  std::unique_ptr<Vehicle> (*make)(const void* parameters) = nullptr;  // from a value of that type
};

}  // namespace jarol::vehicles
