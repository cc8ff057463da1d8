// A simulated vehicle as the rest of Jarol sees it: messages in, messages out, one grid step at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "distributers/interfaces/no_state.h"
#include "distributers/messages/message.h"
#include "distributers/messages/message_set.h"
#include "graph/values/archive.h"
#include "graph/values/describe.h"
#include "graph/values/type.h"

namespace jarol::vehicles {

/// Where a vehicle is and how it moves: NED, Euler angles ZYX, velocities in body axes (forward, right, down).
struct VehicleState {
  double x = 0, y = 0, z = 0;
  double phi = 0, theta = 0, psi = 0;
  double u = 0, v = 0, w = 0;
  double p = 0, q = 0, r = 0;

  static constexpr auto fields() {
    using S = VehicleState;
    return describe(field<&S::x>("m", "north of the origin"), field<&S::y>("m", "east of the origin"),
                    field<&S::z>("m", "below the origin"), field<&S::phi>("rad", "roll"),
                    field<&S::theta>("rad", "pitch, nose up"), field<&S::psi>("rad", "yaw, from north to east"),
                    field<&S::u>("m/s", "velocity forward, through what carries the vehicle"),
                    field<&S::v>("m/s", "velocity to the right, likewise"),
                    field<&S::w>("m/s", "velocity down, likewise"), field<&S::p>("rad/s", "roll rate"),
                    field<&S::q>("rad/s", "pitch rate"), field<&S::r>("rad/s", "yaw rate"));
  }
};

/// What no mission wants of a vehicle, and when it was so first.
struct Mishap {
  std::chrono::nanoseconds instant{};
  std::string text;  // "crashed: a foot met the ground at 4.2 m/s"

  void serialize(Archive& archive) { archive(instant, text); }
};

/// What stands at a whole number of its own grid steps since the start. Who looks, or how often, changes nothing.
class SteppedVehicle {
 public:
  virtual ~SteppedVehicle() = default;

  /// Length of one step; instants at which anything touches the vehicle are multiples of it.
  virtual std::chrono::nanoseconds grid() const = 0;

  /// Takes a command; it is held until the next of its kind. Others than the vehicle's own are ignored.
  virtual void accept(messages::MessageRef command) = 0;

  /// Advances by one grid step with the commands it holds. Throws NoState if its state is not finite then.
  virtual void step() = 0;

  /// Sends what its sensors report at the present instant.
  virtual void sense(messages::Receiver& receiver) const = 0;

  /// Describes the true values, a struct of numbers; null: they are not known here.
  virtual const Type* true_type() const { return nullptr; }
  virtual const void* true_values() const { return nullptr; }

  /// All that changes while it moves, between two steps; restored into one of the same parameters, it goes on to the
  /// bit. Throws NotSaveable; what else it throws while it is saved means the same.
  virtual void serialize(Archive&) { throw NotSaveable("its vehicle has no serialize(Archive&)"); }

  /// What has become of it that no mission wants; none: nothing, or it is not known here.
  virtual std::optional<Mishap> mishap() const { return std::nullopt; }

  /// Why it is not at rest by its true state, as in "it is 7.2 m deep"; empty: it is, or it is not known here.
  virtual std::string unrest() const { return {}; }
};

/// A simulated vehicle in this process.
class Vehicle : public SteppedVehicle {
 public:
  /// The true state.
  virtual VehicleState state() const = 0;

  /// Puts it into a state. Only before the first step; throws std::runtime_error if it can't be in it.
  virtual void place(const VehicleState& state) = 0;

  /// Gives all commands at once: a value of its class' type of inputs.
  virtual void command(const void* inputs) = 0;

  /// What its actuators do and its sensors reported last: a value of its class' type of outputs. NaN: never reported.
  virtual const void* outputs() const = 0;
};

/// What a number may be, both ends included.
struct Range {
  double min = 0;
  double max = 0;
};

/// A kind of vehicle, by the name that its parameter files give.
struct VehicleClass {
  std::string name;
  std::string summary;
  const Type* parameters = nullptr;
  const Type* inputs = nullptr;  // a struct of doubles
  std::vector<Range> ranges;     // of each input
  const messages::MessageSet* message_set = nullptr;
  const Type* outputs = nullptr;  // a struct of structs of numbers
  const Type* truth = nullptr;    // of its true values, as operators name them
  // from a value of the type of parameters; throws a std::exception if there can be no such vehicle
  std::unique_ptr<Vehicle> (*make)(const void* parameters, std::uint64_t seed) = nullptr;
  // passes on what the vehicle reports and adds what a peer expects beside it; null: nothing
  std::unique_ptr<messages::Receiver> (*make_telemetry)(const Vehicle& vehicle, messages::Receiver& to) = nullptr;
  const messages::MessageDescriptor* true_state = nullptr;  // the message that reports it; null: there is none
  // what says to those who look for systems that it can be reached at an address, as in "udp://127.0.0.1:6002"; null:
  // nobody looks for it
  messages::Message (*make_announcement)(const Vehicle& vehicle, const std::string& address) = nullptr;
};

}  // namespace jarol::vehicles
