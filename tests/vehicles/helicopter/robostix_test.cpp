#include "vehicles/helicopter/robostix.h"

#include <doctest/doctest.h>

#include "distributers/messages/javiator.h"

namespace {
using namespace jarol;
namespace javiator = messages::javiator;

void send(vehicles::Robostix& robostix, std::int16_t signal, std::uint16_t id = 0) {
  robostix.accept(messages::refer_to(javiator::MotorSignals{signal, signal, signal, signal, id}));
}

void switch_state(vehicles::Robostix& robostix) { robostix.accept(messages::refer_to(javiator::SwitchState{})); }
}  // namespace

TEST_SUITE("vehicles/robostix") {
  TEST_CASE("motors are locked until the state is switched, and again after a shut-down") {
    vehicles::Robostix robostix;
    send(robostix, 8000);
    CHECK(robostix.signals()[0] == 0);
    switch_state(robostix);
    send(robostix, 8000);
    CHECK(robostix.signals()[3] == 8000);
    robostix.accept(messages::refer_to(javiator::ShutDown{}));
    CHECK(robostix.signals()[0] == 0);
    send(robostix, 8000);
    CHECK(robostix.signals()[0] == 0);
  }

  TEST_CASE("motor signals are answered in the next step, with their id, locked or not") {
    vehicles::Robostix robostix;
    CHECK_FALSE(robostix.answers());
    send(robostix, 0, 77);
    CHECK_FALSE(robostix.answers());
    robostix.step();
    CHECK(robostix.answers());
    CHECK(robostix.id() == 77);
    robostix.step();
    CHECK_FALSE(robostix.answers());
  }

  TEST_CASE("without motor signals for 100 ms the signals fall by 5 each 100 ms, down to zero") {
    vehicles::Robostix robostix;
    switch_state(robostix);
    send(robostix, 12);
    for (int i = 0; i < 19; ++i) robostix.step();
    CHECK(robostix.signals()[0] == 12);
    robostix.step();
    CHECK(robostix.signals()[0] == 7);
    for (int i = 0; i < 20; ++i) robostix.step();
    CHECK(robostix.signals()[0] == 2);
    for (int i = 0; i < 20; ++i) robostix.step();
    CHECK(robostix.signals()[0] == 0);
    send(robostix, 12);
    for (int i = 0; i < 19; ++i) robostix.step();
    CHECK(robostix.signals()[0] == 12);
  }

  TEST_CASE("each sonar is reported for 4 s after an EnSensors that asks for it, or until one that does not") {
    vehicles::Robostix robostix;
    const auto enable = [&](std::uint8_t what) { robostix.accept(messages::refer_to(javiator::EnSensors{what})); };
    CHECK_FALSE(robostix.reports_each_sonar());
    enable(javiator::EnSensors::Enable::EACH_SONAR);
    robostix.accept(messages::refer_to(javiator::ShutDown{}));
    for (int i = 0; i < 799; ++i) robostix.step();
    CHECK(robostix.reports_each_sonar());
    robostix.step();
    CHECK_FALSE(robostix.reports_each_sonar());
    enable(javiator::EnSensors::Enable::EACH_SONAR);
    CHECK(robostix.reports_each_sonar());
    enable(0xFF & ~javiator::EnSensors::Enable::EACH_SONAR);
    CHECK_FALSE(robostix.reports_each_sonar());
  }

  TEST_CASE("signals beyond 0 to 16000 are cut off, and messages of others ignored") {
    vehicles::Robostix robostix;
    switch_state(robostix);
    robostix.accept(messages::refer_to(javiator::MotorSignals{-1, 16001, 32767, -32768, 0}));
    CHECK(robostix.signals() == std::array<double, 4>{0, 16000, 16000, 0});
    robostix.accept(messages::refer_to(javiator::JaviatorData{}));
    CHECK(robostix.signals() == std::array<double, 4>{0, 16000, 16000, 0});
  }
}
