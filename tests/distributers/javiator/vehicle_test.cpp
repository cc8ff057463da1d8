#include "distributers/javiator/vehicle.h"

#include <doctest/doctest.h>

#include <algorithm>

#include <string>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/messages/javiator.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace javiator = messages::javiator;
using Flags = javiator::JaviatorData::Flags;

// What went out, in its order.
struct SentInOrder : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (const auto* motors = message.as<javiator::MotorSignals>()) {
      order += "m";
      signals.push_back(*motors);
    } else if (message.as<javiator::SwitchState>() != nullptr) {
      order += "u";
    } else if (message.as<javiator::ShutDown>() != nullptr) {
      order += "s";
    } else if (const auto* sensors = message.as<javiator::EnSensors>()) {
      order += "e" + std::to_string(sensors->enable);
    }
  }
  std::string order;
  std::vector<javiator::MotorSignals> signals;
};

struct Vehicle {
  Typed<JaviatorVehicle> distributer{};
  tasks::JaviatorSensors sensors{};

  void hear(std::uint16_t flags, std::uint16_t id = 0) {
    javiator::JaviatorData data;
    data.flags = flags;
    data.id = id;
    distributer.receive(messages::refer_to(data));
  }
  std::string take() {
    if (!distributer.take<&JaviatorVehicle::In::sensors>(sensors)) return "nothing";
    return std::string(sensors.new_imu ? "i" : "") + (sensors.new_bmu ? "b" : "") + (sensors.new_sonar ? "s" : "") +
           (sensors.new_x ? "x" : "") + (sensors.new_y ? "y" : "");
  }
  void command(SentInOrder& sent, bool unlocked, std::array<double, 4> signals, std::uint32_t number = 0) {
    const tasks::MotorCommand motors{.signals = signals, .unlocked = unlocked, .number = number};
    distributer.hand_over<&JaviatorVehicle::Out::motors>(motors, sent);
  }
};
}  // namespace

TEST_SUITE("distributers/javiator_vehicle") {
  TEST_CASE("what is new in one of two answers is new when both are taken together, and no longer after that") {
    Vehicle v;
    CHECK(v.take() == "nothing");
    v.hear(Flags::IMU | Flags::SONAR);
    v.hear(Flags::IMU | Flags::X_POS);
    CHECK(v.take() == "isx");
    CHECK(v.sensors.answers == 2);
    CHECK(v.take() == "nothing");
    v.hear(Flags::IMU);
    CHECK(v.take() == "i");
  }

  TEST_CASE(
      "an answer to earlier signals than the last answer's is late, and left out; numbers begin again after 65535") {
    Vehicle v;
    SentInOrder sent;
    for (int i = 0; i < 3; ++i) v.command(sent, true, {});
    v.hear(Flags::IMU, 2);
    CHECK(v.take() == "i");
    v.hear(Flags::SONAR, 1);
    CHECK(v.take() == "nothing");
    v.hear(Flags::SONAR, 2);  // the network doubles signals: they are answered twice
    CHECK(v.take() == "s");
    v.hear(Flags::BMU, 3);
    CHECK(v.take() == "b");
    CHECK(v.sensors.answers == 3);
    for (int i = 3; i < 65538; ++i) v.command(sent, true, {});
    CHECK(sent.signals.back().id == 2);
    v.hear(Flags::IMU, 65534);
    CHECK(v.take() == "i");
    v.hear(Flags::BMU, 1);
    CHECK(v.take() == "b");
    v.hear(Flags::IMU, 65535);
    CHECK(v.take() == "nothing");
  }

  TEST_CASE("after any time without answers those that come again are not late") {
    for (const int silent : {1, 999, 30000, 32768, 40000, 65535, 70000}) {
      Vehicle v;
      SentInOrder sent;
      v.command(sent, true, {});
      v.hear(Flags::IMU, 1);
      for (int i = 0; i < silent; ++i) v.command(sent, true, {});
      v.hear(Flags::SONAR, sent.signals.back().id);
      CHECK(v.take() == "is");
      v.hear(Flags::IMU, static_cast<std::uint16_t>(sent.signals.back().id - 1));
      CHECK(v.take() == "nothing");
    }
  }

  TEST_CASE("an answer to signals that were not sent yet is believed, but nothing after it is late for that") {
    Vehicle v;
    SentInOrder sent;
    v.command(sent, true, {});
    v.hear(Flags::IMU, 700);  // to a controller that flew it before
    CHECK(v.take() == "i");
    v.hear(Flags::SONAR, 1);
    CHECK(v.take() == "s");
  }

  TEST_CASE("an answer has the number of the command that it answers, 0 where that is not known") {
    Vehicle v;
    SentInOrder sent;
    const auto answered = [&](int id) {
      v.hear(Flags::IMU, static_cast<std::uint16_t>(id));
      REQUIRE(v.take() == "i");
      return v.sensors.answered;
    };
    for (std::uint32_t number = 70000; number < 70010; ++number) v.command(sent, true, {}, number);
    CHECK(answered(3) == 70002);
    CHECK(answered(10) == 70009);
    CHECK(answered(500) == 0);  // to a controller that flew it before
    v.command(sent, true, {});
    CHECK(answered(11) == 0);  // it had none
  }

  TEST_CASE("each flag stands for its own sensor") {
    Vehicle v;
    for (const auto& [flag, name] : std::vector<std::pair<std::uint16_t, std::string>>{
             {Flags::IMU, "i"}, {Flags::BMU, "b"}, {Flags::SONAR, "s"}, {Flags::X_POS, "x"}, {Flags::Y_POS, "y"}}) {
      v.hear(flag);
      CHECK(v.take() == name);
    }
  }

  TEST_CASE("motors are unlocked before the first signals and about once a second, and shut down likewise after that") {
    Vehicle v;
    SentInOrder sent;
    v.command(sent, false, {});
    v.command(sent, true, {});
    v.command(sent, true, {});
    v.command(sent, false, {});
    v.command(sent, false, {});
    CHECK(sent.order == "mummsmm");
    sent.order.clear();
    Vehicle guarded;  // one that takes over unlocks nothing
    guarded.distributer.take_over();
    guarded.command(sent, true, {});
    CHECK(sent.order == "m");
    sent.order.clear();
    for (int i = 0; i < 150; ++i) v.command(sent, true, {});
    CHECK(std::count(sent.order.begin(), sent.order.end(), 'm') == 150);
    CHECK(std::count(sent.order.begin(), sent.order.end(), 'u') == 3);
    sent.order.clear();
    for (int i = 0; i < 150; ++i) v.command(sent, false, {});
    CHECK(std::count(sent.order.begin(), sent.order.end(), 's') == 3);
    CHECK(std::count(sent.order.begin(), sent.order.end(), 'u') == 0);
  }

  TEST_CASE("each sonar is asked for before the first signals and about once a second, by who wants it") {
    SentInOrder sent;
    const auto fly = [&](Vehicle& v, int times) {
      sent.order.clear();
      for (int i = 0; i < times; ++i) v.command(sent, false, {});
      return sent.order;
    };
    Vehicle as_ever, v{.distributer = Typed<JaviatorVehicle>({.each_sonar = true})};
    CHECK(fly(as_ever, 150).find('e') == std::string::npos);
    CHECK(fly(v, 3) == "e1mmm");
    const std::string order = fly(v, 150);
    CHECK(std::count(order.begin(), order.end(), 'e') == 2);
  }

  TEST_CASE("the ranges of the sonars come in m, each once, and none that was held up or comes twice") {
    Vehicle v;
    SentInOrder sent;
    for (int i = 0; i < 5; ++i) v.command(sent, true, {});
    tasks::SonarRanges sonars;
    const auto hear = [&](std::uint16_t id) {
      v.distributer.receive(messages::refer_to(javiator::SonarData{1023, 512, 256, 0, id}));
      return v.distributer.take<&JaviatorVehicle::In::sonars>(sonars);
    };
    CHECK(hear(3));
    CHECK(sonars.ranges == std::array{1023 * 3.0 / 1024, 1.5, 0.75, 0.0});
    CHECK(sonars.readings == 1);
    CHECK_FALSE(hear(3));
    CHECK_FALSE(hear(2));
    CHECK(hear(5));
    CHECK(sonars.readings == 2);
    CHECK(v.take() == "nothing");  // they are no answer
  }

  TEST_CASE("signals are whole numbers from 0 to 16000, each command has the next number") {
    Vehicle v;
    SentInOrder sent;
    v.command(sent, true, {-1, 0.999, 16000, 16001});
    v.command(sent, true, {1, 2, 3, 4});
    REQUIRE(sent.signals.size() == 2);
    CHECK(sent.signals[0].front == 0);
    CHECK(sent.signals[0].right == 0);
    CHECK(sent.signals[0].rear == 16000);
    CHECK(sent.signals[0].left == 16000);
    CHECK(sent.signals[0].id == 1);
    CHECK(sent.signals[1].front == 1);
    CHECK(sent.signals[1].right == 2);
    CHECK(sent.signals[1].rear == 3);
    CHECK(sent.signals[1].left == 4);
    CHECK(sent.signals[1].id == 2);
  }
}
