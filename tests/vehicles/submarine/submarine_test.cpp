#include "vehicles/submarine/submarine.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "distributers/messages/imc.h"
#include "graph/text/errors.h"
#include "vehicles/catalogue.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
namespace imc = messages::imc;

struct Sensed : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (const auto* s = message.as<imc::SimulatedState>()) state = *s;
  }
  imc::SimulatedState state;
};

imc::SimulatedState sense(const Submarine& submarine) {
  Sensed sensed;
  submarine.sense(sensed);
  return sensed.state;
}

void command(Submarine& submarine, float thruster, const std::array<float, 4>& fins) {
  submarine.accept(messages::refer_to(imc::SetThrusterActuation{0, thruster}));
  for (std::uint8_t i = 0; i < 4; ++i) submarine.accept(messages::refer_to(imc::SetServoPosition{i, fins[i]}));
}

// Ten seconds at speed in the deep with these fins.
imc::SimulatedState after_ten_seconds(const std::array<float, 4>& fins) {
  SubmarineParameters parameters;
  parameters.start.depth = 20;
  parameters.start.surge = 1.2;
  parameters.command_timeout = {};  // commanded once
  Submarine submarine(parameters);
  command(submarine, 0.6F, fins);
  for (int i = 0; i < 1000; ++i) submarine.step();
  return sense(submarine);
}
}  // namespace

TEST_SUITE("vehicles/submarine") {
  TEST_CASE("its step is 10 ms") { CHECK(Submarine({}).grid() == std::chrono::milliseconds(10)); }

  TEST_CASE("it does not start in the sea floor") {
    SubmarineParameters parameters;
    parameters.start.depth = parameters.sea.floor;
    CHECK_THROWS_WITH_AS(Submarine(parameters, 0),
                         "submarine: start.depth must lie above sea.floor, and is 50 m where that is 50 m", InputError);
    parameters.start.depth = parameters.sea.floor - 0.3;
    CHECK(Submarine(parameters, 0).mishap() == std::nullopt);
  }

  TEST_CASE("it is no thicker than it is long") {
    SubmarineParameters parameters;
    parameters.hull.length = 0.1;
    CHECK_THROWS_WITH_AS(Submarine(parameters, 0),
                         "submarine: hull.diameter must not be above hull.length, and is 0.15 m where that is 0.1 m",
                         InputError);
  }

  TEST_CASE("positive angles on fins 0 and 3 turn to port, negative ones to starboard") {
    CHECK(after_ten_seconds({0.2F, 0, 0, 0.2F}).psi < -0.1F);
    CHECK(after_ten_seconds({-0.2F, 0, 0, -0.2F}).psi > 0.1F);
  }

  TEST_CASE("positive angles on fins 1 and 2 nose down, negative ones up") {
    const auto neutral = after_ten_seconds({});
    CHECK(after_ten_seconds({0, 0.1F, 0.1F, 0}).theta < neutral.theta - 0.05F);
    CHECK(after_ten_seconds({0, -0.1F, -0.1F, 0}).theta > neutral.theta + 0.05F);
  }

  TEST_CASE("port and starboard are mirror images") {
    const auto port = after_ten_seconds({0.2F, 0, 0, 0.2F}), starboard = after_ten_seconds({-0.2F, 0, 0, -0.2F});
    CHECK(port.psi == doctest::Approx(-starboard.psi).scale(0).epsilon(1e-5));
    CHECK(port.y == doctest::Approx(-starboard.y).scale(0).epsilon(1e-5));
    CHECK(port.z == doctest::Approx(starboard.z).scale(0).epsilon(1e-6));
  }

  TEST_CASE("a command is held until the next, and what is not finite or not its own is not taken") {
    SubmarineParameters parameters;
    parameters.start.depth = 20;
    parameters.command_timeout = {};
    Submarine once(parameters), often(parameters);
    command(once, 0.5F, {0.1F, 0, 0, 0.1F});
    for (int i = 0; i < 300; ++i) {
      command(often, 0.5F, {0.1F, 0, 0, 0.1F});
      once.accept(messages::refer_to(imc::SetThrusterActuation{0, std::numeric_limits<float>::quiet_NaN()}));
      once.accept(messages::refer_to(imc::SetThrusterActuation{1, 1.0F}));
      once.accept(messages::refer_to(imc::SetServoPosition{4, 1.0F}));
      once.accept(messages::refer_to(imc::SimulatedState{}));
      once.step();
      often.step();
    }
    CHECK(sense(once).x == sense(often).x);
    CHECK(sense(once).psi == sense(often).psi);
    CHECK(sense(once).x > 0.5F);
  }

  TEST_CASE("each servo reports where it is at every step, as its sensor measures, also of a fin that is broken off") {
    SubmarineParameters parameters;
    parameters.failures.fin1 = {.kind = ActuatorFailureKind::lost};
    parameters.failures.fin2 = {.kind = ActuatorFailureKind::stuck};
    parameters.sensors.servos.bias = 0.01;
    Submarine submarine(parameters);
    struct Servos : messages::Receiver {
      void receive(messages::MessageRef message) override {
        const auto* servo = message.as<imc::ServoPosition>();
        if (servo == nullptr) return;
        angles[servo->id] = servo->value;
        ++count;
      }
      std::array<float, 4> angles{};
      int count = 0;
    } servos;
    command(submarine, 0.5F, {0.1F, 0.2F, 0.3F, -0.1F});
    for (int i = 0; i < 50; ++i) {
      submarine.step();
      submarine.sense(servos);
    }
    CHECK(servos.count == 200);
    const float expected[] = {0.11F, 0.21F, 0.01F, -0.09F};
    for (std::size_t i = 0; i < 4; ++i) CHECK(servos.angles[i] == doctest::Approx(expected[i]));
  }

  TEST_CASE("without commands for the time-out the propeller stops and the fins go to neutral, each on its own") {
    SubmarineParameters parameters;
    parameters.start.depth = 20;
    parameters.command_timeout = std::chrono::milliseconds(500);
    Submarine submarine(parameters);
    const auto* out = static_cast<const SubmarineOutputs*>(submarine.outputs());
    command(submarine, 0.5F, {0.2F, 0.1F, 0.1F, 0.2F});
    for (int i = 0; i < 50; ++i) submarine.step();
    CHECK(out->actuators.fin0 == doctest::Approx(0.2));
    CHECK(out->actuators.propeller == doctest::Approx(130.9).scale(0).epsilon(0.001));
    submarine.accept(messages::refer_to(imc::SetServoPosition{1, 0.1F}));
    for (int i = 0; i < 40; ++i) submarine.step();
    CHECK(out->actuators.fin0 == 0);
    CHECK(out->actuators.fin1 == doctest::Approx(0.1));
    CHECK(out->actuators.propeller < 1);
  }

  TEST_CASE("actuators rest from the first step after the time-out on, and not before") {
    SubmarineParameters parameters;
    parameters.start.depth = 20;
    parameters.command_timeout = std::chrono::milliseconds(500);
    Submarine submarine(parameters);
    const auto* out = static_cast<const SubmarineOutputs*>(submarine.outputs());
    command(submarine, 0, {0.02F, 0, 0, 0});
    for (int i = 0; i < 50; ++i) submarine.step();  // 0.5 s
    CHECK(out->actuators.fin0 == doctest::Approx(0.02));
    submarine.step();
    CHECK(out->actuators.fin0 == 0);
  }

  TEST_CASE("when the battery's charge is used up the propeller stops, and it comes up") {
    SubmarineParameters parameters;
    parameters.start.depth = 3;
    parameters.power.charge = 0.0003;  // 6 mA h
    Submarine submarine(parameters);
    const auto* out = static_cast<const SubmarineOutputs*>(submarine.outputs());
    const auto run = [&](int steps) {
      for (int i = 0; i < steps; ++i) {
        command(submarine, 0.5F, {});
        submarine.step();
      }
    };
    // 1 A, and 6/8 A by the propeller: 12.3 s
    run(1200);
    CHECK(out->actuators.propeller == doctest::Approx(130.9));
    run(100);
    CHECK(out->actuators.propeller < 1e-3);
    CHECK(out->sensors.current == 0);
    CHECK(out->sensors.voltage == 0);
    run(12000);
    CHECK(sense(submarine).z < 0.3F);
    CHECK(std::abs(sense(submarine).u) < 0.05F);
  }

  TEST_CASE("with a rudder stuck to starboard it turns there, whatever is commanded") {
    SubmarineParameters parameters;
    parameters.start.depth = 20;
    parameters.start.surge = 1.2;
    parameters.failures.fin3 = {.kind = ActuatorFailureKind::stuck, .at = 1};
    Submarine submarine(parameters, 1);
    for (int i = 0; i < 1000; ++i) {
      const float rudder = i < 100 ? -0.2F : 0.0F;
      command(submarine, 0.6F, {rudder, 0, 0, rudder});
      submarine.step();
    }
    CHECK(sense(submarine).psi > 0.5F);
    CHECK(static_cast<const SubmarineOutputs*>(submarine.outputs())->actuators.fin3 == doctest::Approx(-0.2));
  }

  TEST_CASE("a command that is no number changes nothing") {
    Submarine submarine({});
    const auto* out = static_cast<const SubmarineOutputs*>(submarine.outputs());
    command(submarine, 0, {0.02F, 0, 0, 0});
    for (int i = 0; i < 10; ++i) submarine.step();
    submarine.accept(messages::refer_to(imc::SetServoPosition{0, std::numeric_limits<float>::quiet_NaN()}));
    for (int i = 0; i < 10; ++i) submarine.step();
    CHECK(out->actuators.fin0 == doctest::Approx(0.02));
  }

  TEST_CASE("fins slew no faster than their servos and no further than their limit") {
    Submarine submarine({});
    const auto* out = static_cast<const SubmarineOutputs*>(submarine.outputs());
    command(submarine, 0, {2.0F, 0, 0, 0});
    submarine.step();
    CHECK(out->actuators.fin0 == doctest::Approx(3.333 * degree));
    for (int i = 0; i < 20; ++i) submarine.step();
    CHECK(out->actuators.fin0 == doctest::Approx(45 * degree));
  }

  TEST_CASE("results do not depend on who looks or how often, with noise and waves neither") {
    SubmarineParameters parameters;
    parameters.sensors.depth.noise = 0.1;
    parameters.sensors.imu_rates.noise = 0.01;
    parameters.sea.wave_height = 0.3;
    Submarine seen(parameters, 5), unseen(parameters, 5);
    command(seen, 1.0F, {});
    command(unseen, 1.0F, {});
    for (int i = 0; i < 500; ++i) {
      seen.step();
      unseen.step();
      for (int look = 0; look < i % 4; ++look) static_cast<void>(sense(seen)), static_cast<void>(seen.state());
    }
    CHECK(sense(seen).x == sense(unseen).x);
    CHECK(sense(seen).theta == sense(unseen).theta);
    const Type& type = type_of<SubmarineOutputs>();
    CHECK(type.hash_words(seen.outputs()) == type.hash_words(unseen.outputs()));
  }

  TEST_CASE("what is no number is not taken as a command, and a state without numbers ends it, for good") {
    for (const bool vsim : {false, true}) {
      CAPTURE(vsim);
      SubmarineParameters parameters;
      parameters.vsim_compatible = vsim;
      Submarine submarine(parameters);
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const SubmarineInputs inputs{nan, nan, nan, nan, nan};
      submarine.command(&inputs);
      for (int i = 0; i < 10; ++i) submarine.step();
      CHECK(std::isfinite(submarine.state().x));
      Submarine gone(parameters);
      VehicleState beyond;
      beyond.u = 1e200;
      gone.place(beyond);
      CHECK_THROWS_AS(gone.step(), NoState);
      CHECK_THROWS_AS(gone.step(), NoState);
    }
  }

  TEST_CASE("VSIM's plant knows no waves") {
    SubmarineParameters parameters;
    parameters.vsim_compatible = true;
    parameters.sea.wave_height = 0.3;
    CHECK_THROWS_WITH_AS(Submarine{parameters},
                         "submarine: with vsim_compatible there are no waves; sea.wave_height has to be 0", InputError);
  }

  TEST_CASE("a current carries it along and is reported, velocities stay those through the water") {
    SubmarineParameters parameters;
    parameters.sea.current_east = 0.25;
    Submarine submarine(parameters);
    for (int i = 0; i < 400; ++i) submarine.step();
    CHECK(sense(submarine).y == doctest::Approx(1.0));
    CHECK(sense(submarine).svy == 0.25F);
    CHECK(sense(submarine).v == doctest::Approx(0.0));
  }

  TEST_CASE("it stands in the catalogue under its name") {
    NamedList<VehicleClass> known;
    add_vehicles(known);
    const VehicleClass* found = known.find("submarine");
    REQUIRE(found != nullptr);
    CHECK(found->parameters == &type_of<SubmarineParameters>());
    const SubmarineParameters parameters;
    CHECK(found->make(&parameters, 0)->grid() == std::chrono::milliseconds(10));
    CHECK(known.find("airship") == nullptr);
  }
}
