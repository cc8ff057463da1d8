// What the submarine's servos report, beside what they were sent, and what is not fitted.
#include <doctest/doctest.h>

#include <limits>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using In = LauvVehicle::In;
namespace imc = messages::imc;

struct Ignored : messages::Receiver {
  void receive(messages::MessageRef) override {}
};
}  // namespace

TEST_SUITE("distributers/lauv_servos") {
  TEST_CASE("a servo's position becomes a reading of that fin, beside where it was sent last") {
    Typed<LauvVehicle> adapter;
    Ignored sent;
    tasks::Servos servos;
    CHECK_FALSE(adapter.take<&In::servos>(servos));
    adapter.receive(messages::refer_to(imc::ServoPosition{2, 0.05F}));
    adapter.hand_over<&LauvVehicle::Out::actuation>(tasks::Actuation{0.5, {0.1, 0.2, 0.3, 0.4}}, sent);
    adapter.receive(messages::refer_to(imc::ServoPosition{0, 0.25F}));
    adapter.receive(messages::refer_to(imc::ServoPosition{3, 0.5F}));
    adapter.receive(messages::refer_to(imc::ServoPosition{3, 0.75F}));
    adapter.receive(messages::refer_to(imc::ServoPosition{4, 0.5F}));  // there is no such fin
    adapter.receive(messages::refer_to(imc::ServoPosition{1, std::numeric_limits<float>::infinity()}));
    CHECK(adapter.take<&In::servos>(servos));
    CHECK(servos.fins[0].angle == 0.25);
    CHECK(servos.fins[0].commanded == 0.1);
    CHECK(servos.fins[0].count == 1);
    CHECK(servos.fins[1].count == 0);
    CHECK(servos.fins[2].angle == static_cast<double>(0.05F));
    CHECK(servos.fins[2].commanded == 0);  // it came before any command
    CHECK(servos.fins[3].angle == 0.75);
    CHECK(servos.fins[3].commanded == 0.4);
    CHECK(servos.fins[3].count == 2);
    CHECK(adapter.non_finite_inputs() == 1);
  }

  TEST_CASE("the propeller's speed becomes a reading beside what it was sent last, but not where others drive it") {
    Typed<LauvVehicle> adapter;
    Ignored sent;
    tasks::Servos servos;
    const auto report = [&](std::int16_t rpm) {
      imc::Rpm message;
      message.value = rpm;
      adapter.receive(messages::refer_to(message));
    };
    report(100);
    adapter.hand_over<&LauvVehicle::Out::actuation>(tasks::Actuation{0.5, {}}, sent);
    CHECK(adapter.take<&In::servos>(servos));
    CHECK(servos.propeller.speed == 100);
    CHECK(servos.propeller.commanded == 0);  // it came before any command
    CHECK(servos.propeller.count == 1);
    report(-1200);
    adapter.take<&In::servos>(servos);
    CHECK(servos.propeller.speed == -1200);
    CHECK(servos.propeller.commanded == 0.5);
    CHECK(servos.propeller.count == 2);
    imc::VehicleState steers_itself;
    steers_itself.control_loops = imc::CLoopsMask::SPEED;
    adapter.receive(messages::refer_to(steers_itself));
    report(0);
    adapter.take<&In::servos>(servos);
    CHECK(servos.propeller.count == 2);
  }

  TEST_CASE("servos that are not fitted say so") {
    LauvVehicleParameters parameters;
    parameters.servos.fitted = false;
    const LauvVehicle vehicle(parameters);
    for (const tasks::ServoReading& servo : vehicle.in.servos->fins) CHECK(servo.count == -1);
  }

  TEST_CASE("a reading of what is not fitted is not taken") {
    LauvVehicleParameters parameters;
    parameters.voltage.fitted = false;
    Typed<LauvVehicle> adapter(parameters);
    imc::Voltage voltage;
    voltage.value = 24;
    imc::Current current;
    current.value = 1;
    adapter.receive(messages::refer_to(voltage));
    adapter.receive(messages::refer_to(current));
    tasks::Instruments i;
    CHECK(adapter.take<&In::instruments>(i));
    CHECK(i.voltage.count == -1);
    CHECK(i.voltage.value == 0);
    CHECK(i.current.count == 1);
  }
}
