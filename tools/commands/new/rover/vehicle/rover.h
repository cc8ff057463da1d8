// A rover with two driven wheels, on even ground: its motors follow their commands with a lag, wheels don't slip.
#pragma once

#include <jarol/vehicle.h>

class Rover : public jarol::vehicles::Vehicle {
 public:
  static constexpr std::string_view name = "rover";
  static constexpr std::string_view summary = "two driven wheels on even ground";
  static const jarol::messages::MessageSet& message_set();

  struct Parameters {
    double lag = 0.2;
    static constexpr auto fields() {
      return jarol::describe(jarol::field<&Parameters::lag>("s", "time constant of the motors"));
    }
  };
  struct Inputs {
    double speed = 0;
    double turn = 0;
    static constexpr auto fields() {
      return jarol::describe(jarol::field<&Inputs::speed>("m/s", "forward"),
                             jarol::field<&Inputs::turn>("rad/s", "clockwise, seen from above"));
    }
    static std::vector<jarol::vehicles::Range> ranges() { return {{-1, 1}, {-2, 2}}; }
  };
  struct Motors {
    double speed = 0;
    double turn = 0;
    static constexpr auto fields() {
      return jarol::describe(jarol::field<&Motors::speed>("m/s", "forward"),
                             jarol::field<&Motors::turn>("rad/s", "clockwise, seen from above"));
    }
  };
  struct Outputs {
    Motors motors;
    static constexpr auto fields() { return jarol::describe(jarol::field<&Outputs::motors>("", "what the wheels do")); }
  };
  struct Truth {
    double north = 0;
    double east = 0;
    double heading = 0;
    static constexpr auto fields() {
      using jarol::field;
      return jarol::describe(field<&Truth::north>("m", "of the start"), field<&Truth::east>("m", "of the start"),
                             field<&Truth::heading>("rad", "from north to east"));
    }
  };

  explicit Rover(const Parameters& parameters, std::uint64_t seed = 0);

  std::chrono::nanoseconds grid() const override;
  void accept(jarol::messages::MessageRef command) override;
  void step() override;
  void sense(jarol::messages::Receiver& receiver) const override;
  const jarol::Type* true_type() const override;
  const void* true_values() const override { return &truth_; }
  void serialize(jarol::Archive& archive) override;
  jarol::vehicles::VehicleState state() const override;
  void place(const jarol::vehicles::VehicleState& state) override;
  void command(const void* inputs) override;
  const void* outputs() const override { return &outputs_; }

 private:
  Parameters parameters_;
  Inputs inputs_;
  Outputs outputs_;
  Truth truth_;
};
