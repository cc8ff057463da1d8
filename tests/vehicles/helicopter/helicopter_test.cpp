// The helicopter as a vehicle: messages in, messages out, and what its battery and the wind do to it.
#include "vehicles/helicopter/helicopter.h"

#include <doctest/doctest.h>

#include <cmath>

#include "graph/text/errors.h"
#include "vehicles/air/wind.h"
#include "vehicles/catalogue.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
namespace javiator = messages::javiator;

struct Answers : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (const auto* d = message.as<javiator::JaviatorData>()) {
      data = *d;
      ++count;
    }
  }
  javiator::JaviatorData data;
  int count = 0;
};

void command(Helicopter& helicopter, std::array<std::int16_t, 4> s, std::uint16_t id = 0) {
  helicopter.accept(messages::refer_to(javiator::MotorSignals{s[0], s[1], s[2], s[3], id}));
}

void command(Helicopter& helicopter, std::int16_t signal) { command(helicopter, {signal, signal, signal, signal}); }

// As specs/vehicles/helicopter_v2.yaml has it.
HelicopterParameters v2() {
  HelicopterParameters p;
  p.frame = {.mass = 2.2, .I_x = 0.033, .I_y = 0.033, .I_z = 0.066};
  p.rotors.arm = 0.40;
  p.rotors.full_thrust = 13.885;
  p.rotors.thrust_exponent = 0.977;
  p.rotors.reference_voltage = 15.806;
  p.rotors.full_speed = 303;
  p.battery.full_current = 50.45;
  p.battery.current_exponent = 1.824;
  return p;
}

// Acceleration upwards at that signal, high in the air, once the rotors have followed it.
double acceleration_at(HelicopterParameters p, std::int16_t signal) {
  p.start.altitude = 500;
  p.start.signal = signal;
  Helicopter helicopter(p);
  helicopter.accept(messages::refer_to(javiator::SwitchState{}));
  command(helicopter, signal);
  for (int i = 0; i < 40; ++i) helicopter.step();
  const double before = -helicopter.motion().v_b[2];
  for (int i = 0; i < 4; ++i) helicopter.step();
  return (-helicopter.motion().v_b[2] - before) / 0.02;
}
}  // namespace

TEST_SUITE("vehicles/helicopter") {
  TEST_CASE("its step is 5 ms") { CHECK(Helicopter({}).grid() == std::chrono::milliseconds(5)); }

  TEST_CASE("the V1 hovers at signal 8000, the original's idle") {
    CHECK(std::abs(acceleration_at({}, 8000)) < 0.02);
    CHECK(acceleration_at({}, 8400) > 0.5);
    CHECK(acceleration_at({}, 7600) < -0.5);
  }

  TEST_CASE("the V2 hovers at 38 % of signal and lifts 5.4 kg at full thrust, within 5 %") {
    CHECK(std::abs(acceleration_at(v2(), 6080)) < 0.05 * 9.81);
    HelicopterParameters loaded = v2();
    loaded.frame.mass = 5.4;
    CHECK(std::abs(acceleration_at(loaded, 16000)) < 0.05 * 9.81);
  }

  TEST_CASE("the right rotor slower and the left one faster rolls it to the right") {
    HelicopterParameters p;
    p.start.altitude = 10;
    p.start.signal = 8000;
    Helicopter helicopter(p);
    helicopter.accept(messages::refer_to(javiator::SwitchState{}));
    command(helicopter, {8000, 7900, 8000, 8100});
    for (int i = 0; i < 20; ++i) helicopter.step();
    CHECK(helicopter.motion().omega_b[0] > 0.1);
    CHECK(std::abs(helicopter.motion().omega_b[1]) < 0.01);
  }

  TEST_CASE("front and rear turn clockwise: faster, they turn the hull to the left") {
    HelicopterParameters p;
    p.start.altitude = 10;
    p.start.signal = 8000;
    Helicopter helicopter(p);
    helicopter.accept(messages::refer_to(javiator::SwitchState{}));
    command(helicopter, {8200, 7800, 8200, 7800});
    for (int i = 0; i < 40; ++i) helicopter.step();
    CHECK(helicopter.motion().omega_b[2] < -0.05);
    CHECK(std::abs(helicopter.motion().omega_b[0]) < 0.01);
  }

  TEST_CASE("an answer comes 5 ms after motor signals, with IMU values measured when the answer before was sent") {
    HelicopterParameters p;
    p.start.altitude = 100;
    p.start.signal = 8000;  // not unlocked, the rotors run down
    Helicopter helicopter(p);
    Answers answers;
    const auto step = [&] {
      helicopter.step();
      helicopter.sense(answers);
    };
    step();
    CHECK(answers.count == 0);
    command(helicopter, 0);
    step();
    CHECK(answers.count == 1);
    CHECK(answers.data.ddz < -4600);  // measured at the start
    for (int i = 0; i < 2; ++i) step();
    CHECK(answers.count == 1);
    command(helicopter, {0, 0, 0, 0}, 9);
    step();
    CHECK(answers.count == 2);
    CHECK(answers.data.id == 9);
    CHECK(answers.data.ddz > -4300);
  }

  TEST_CASE("the battery sags with the current and with the charge used") {
    const BatteryParameters p;
    Battery battery(p);
    const double idle = battery.calc_current({0, 0, 0, 0}), full = battery.calc_current({1, 1, 1, 1});
    CHECK(idle == doctest::Approx(0.7));
    CHECK(full == doctest::Approx(28.4));
    CHECK(battery.calc_voltage(0) == 16);
    CHECK(battery.calc_voltage(full) == doctest::Approx(16 - 0.02 * 28.4));
    battery.draw(6.3, 1800);  // half of it
    CHECK(battery.calc_voltage(0) == doctest::Approx(14.6));
    CHECK(battery.calc_voltage(1e6) == 0);
  }

  TEST_CASE("a battery whose charge is used up disconnects itself, and the rotors stop") {
    const BatteryParameters p;
    Battery battery(p);
    battery.draw(6.3, 3599);
    CHECK(battery.calc_voltage(0) == doctest::Approx(13.2).scale(0).epsilon(0.002));
    battery.draw(6.3, 1);
    CHECK(battery.calc_voltage(0) == 0);

    HelicopterParameters parameters;
    parameters.battery.capacity = 6 * 2 / 3600.0;  // some two seconds of hover
    parameters.start.altitude = 50;
    parameters.start.signal = 8000;
    Helicopter helicopter(parameters);
    const auto* out = static_cast<const HelicopterOutputs*>(helicopter.outputs());
    const HelicopterInputs hover{.front = 8000, .right = 8000, .rear = 8000, .left = 8000};
    const auto run = [&](int steps) {
      for (int i = 0; i < steps; ++i) {
        helicopter.command(&hover);
        helicopter.step();
      }
    };
    run(200);
    CHECK(out->rotors.front > 7000);
    run(600);
    CHECK(out->battery.voltage == 0);
    CHECK(out->rotors.front < 1e-3);
  }

  TEST_CASE("so the same signal lifts less after ten minutes") {
    HelicopterParameters p;
    CHECK(acceleration_at(p, 8000) > -0.02);
    p.battery.full -= 2.8 * 600 * 6 / 3600 / 6.3;  // ten minutes of 6 A
    CHECK(acceleration_at(p, 8000) < -0.2);
  }

  TEST_CASE("gusts have the mean and the deviation they are given, and change slowly") {
    AirParameters air;
    air.north = 3;
    air.gusts = 1.5;
    Wind wind(air, 7);
    double sum = 0, squares = 0, product = 0, last = 0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) {
      wind.step(0.1);
      const double gust = wind.now(1)[0] - 3;
      sum += gust;
      squares += gust * gust;
      product += gust * last;
      last = gust;
    }
    CHECK(std::abs(sum / n) < 0.05);
    CHECK(std::sqrt(squares / n) == doctest::Approx(1.5).scale(0).epsilon(0.03));
    CHECK(product / squares == doctest::Approx(std::exp(-0.1)).scale(0).epsilon(0.01));
  }

  TEST_CASE("the same seed gives the same bits whoever looks, another seed other ones") {
    HelicopterParameters p;
    p.noise.rate = 0.01;
    p.air.gusts = 1;
    p.start.altitude = 50;
    Helicopter seen(p, 1), unseen(p, 1), other(p, 2);
    Answers by_seen, by_unseen, by_other;
    for (int i = 0; i < 400; ++i) {
      for (Helicopter* each : {&seen, &unseen, &other}) {
        command(*each, 8000);
        each->step();
      }
      Answers looks;
      for (int look = 0; look < i % 4; ++look) seen.sense(looks);
    }
    seen.sense(by_seen);
    unseen.sense(by_unseen);
    other.sense(by_other);
    CHECK(seen.motion().p_n == unseen.motion().p_n);
    CHECK(by_seen.data.droll == by_unseen.data.droll);
    CHECK(by_seen.data.x_pos == by_unseen.data.x_pos);
    CHECK(seen.motion().p_n != other.motion().p_n);
    CHECK(by_seen.data.droll != by_other.data.droll);
  }

  TEST_CASE("parameters that no helicopter can have are reported") {
    HelicopterParameters p;
    p.frame.I_z = 1;
    CHECK_THROWS_WITH_AS(Helicopter{p}, "none of its moments of inertia can exceed the sum of the other two",
                         InputError);
    p = {};
    p.sensors.sonars = 3;
    CHECK_THROWS_WITH_AS(Helicopter{p}, "it has one sonar or four", InputError);
    p = {};
    p.battery.empty = 20;
    CHECK_THROWS_WITH_AS(Helicopter{p}, "battery.empty must not be above battery.full, and is 20 V where that is 16 V",
                         InputError);
    p = {};
    p.battery.resistance = -1;
    CHECK_THROWS_WITH_AS(Helicopter{p}, "its battery's resistance can't be below zero", InputError);
    for (const double direction : {0, 1}) {
      p = {};
      (direction == 0 ? p.sensors.wall_north : p.sensors.wall_east) = -12;
      CHECK_THROWS_WITH_AS(
          Helicopter{p},
          direction == 0
              ? "the wall in the north must lie north of that in the south, and that in the east east of that "
                "in the west; they are -12 m north, 12 m south, 8 m east and 12 m west of the origin"
              : "the wall in the north must lie north of that in the south, and that in the east east of that "
                "in the west; they are 8 m north, 12 m south, -12 m east and 12 m west of the origin",
          InputError);
    }
  }

  TEST_CASE("it stands in the catalogue under its name") {
    NamedList<VehicleClass> known;
    add_vehicles(known);
    const VehicleClass* found = known.find("helicopter");
    REQUIRE(found != nullptr);
    CHECK(found->parameters == &type_of<HelicopterParameters>());
  }

  TEST_CASE("placed elsewhere its sensors measure there at once") {
    Helicopter helicopter{HelicopterParameters{}};
    helicopter.place({.x = 3, .y = -2, .z = -1.2});
    const HelicopterInputs hover{8000, 8000, 8000, 8000};
    helicopter.command(&hover);
    helicopter.step();
    const HelicopterReadings& reported = static_cast<const HelicopterOutputs*>(helicopter.outputs())->sensors;
    CHECK(reported.x_laser == doctest::Approx(8 - (3 - 0.070)).scale(0).epsilon(1e-3));
    CHECK(reported.y_laser == doctest::Approx(8 - (-2 - 0.077)).scale(0).epsilon(1e-3));
    CHECK(reported.sonar == doctest::Approx(1.2 - 0.055).scale(0).epsilon(0.01));
    CHECK(reported.pressure == doctest::Approx(101325 - 12).scale(0).epsilon(1e-5));  // 1 m above where it stands
  }
}
