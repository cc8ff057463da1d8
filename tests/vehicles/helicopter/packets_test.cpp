// The radio between the helicopter and its flight controller: what is lost, arrives twice, or late.
#include "vehicles/helicopter/packets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "vehicles/helicopter/helicopter.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
namespace javiator = messages::javiator;

constexpr int sent = 20000;
constexpr std::int64_t millisecond = 1'000'000;

// When each of so many packets, one each 100 ms, arrived after it was sent, in ms.
std::multimap<int, std::int64_t> delays_of(const PacketParameters& parameters, std::uint64_t seed = 1) {
  PacketLine<int> line(parameters, seed);
  std::multimap<int, std::int64_t> all;
  for (int i = 0; i < sent; ++i) {
    line.send(i, i * 100 * millisecond);
    for (int waited = 0; waited < 100; ++waited)
      for (const auto& packet : line.arrive((i * 100 + waited) * millisecond)) all.emplace(packet.message, waited);
  }
  return all;
}

struct PacketAnswers : messages::Receiver {
  void receive(messages::MessageRef message) override { ids.push_back(message.as<javiator::JaviatorData>()->id); }
  std::vector<int> ids;
};

// Ids of the answers to signals that are sent every 15 ms.
std::vector<int> answers_over(const PacketParameters& packets, int count, std::uint64_t seed = 1) {
  HelicopterParameters parameters;
  parameters.dynamics = Dynamics::rigid;
  parameters.packets = packets;
  Helicopter helicopter(parameters, seed);
  PacketAnswers answers;
  for (int i = 0; i < 3 * count; ++i) {
    if (i % 3 == 0)
      helicopter.accept(messages::refer_to(javiator::MotorSignals{0, 0, 0, 0, static_cast<std::uint16_t>(i / 3)}));
    helicopter.step();
    helicopter.sense(answers);
  }
  return answers.ids;
}
}  // namespace

TEST_SUITE("vehicles/packets") {
  TEST_CASE("where nothing is said of its packets each arrives at once, and once") {
    const auto all = delays_of({});
    CHECK(all.size() == std::size_t{sent});
    for (const auto& [number, delay] : all) CHECK(delay == 0);
  }

  TEST_CASE("so many are lost, twice there and held up for so long, each by chance, and the others delayed by less") {
    const auto all = delays_of({.loss = 0.1, .repeated = 0.05, .held = 0.2, .held_time = 0.03, .delay = 0.008});
    int there = 0, twice = 0, held = 0;
    double delay = 0;
    for (int i = 0; i < sent; ++i) {
      there += all.count(i) > 0;
      twice += all.count(i) == 2;
      CHECK(all.count(i) <= 2);
    }
    for (const auto& [number, waited] : all) {
      CHECK((waited <= 8 || (waited >= 30 && waited <= 38)));
      held += waited >= 30;
      delay += static_cast<double>(waited % 30) / static_cast<double>(all.size());
    }
    CHECK(there == doctest::Approx(0.9 * sent).scale(0).epsilon(0.01));
    CHECK(twice == doctest::Approx(0.05 * there).scale(0).epsilon(0.1));
    CHECK(held == doctest::Approx(0.2 * static_cast<double>(all.size())).scale(0).epsilon(0.05));
    CHECK(delay == doctest::Approx(4.5).scale(0).epsilon(0.02));  // waited for a whole number of them
    CHECK(delays_of({.loss = 0.5}, 7) == delays_of({.loss = 0.5}, 7));
    CHECK(delays_of({.loss = 0.5}, 7) != delays_of({.loss = 0.5}, 8));
  }

  TEST_CASE("while the radio is cut off nothing passes, and what was sent before and after does") {
    const std::vector<int> answers = answers_over({.cut_at = 0.3, .cut_time = 0.6}, 100);
    std::vector<int> all;
    for (int i = 0; i < 100; ++i)
      if (i < 20 || i >= 60) all.push_back(i);  // one each 15 ms
    CHECK(answers == all);
  }

  TEST_CASE("what was held up arrives after what was sent later, and what arrives at one time in the order sent") {
    PacketLine<int> line({.delay = 0.008}, 1);
    for (int i = 0; i < 100; ++i) line.send(i, i * millisecond);
    std::int64_t due = 0;
    std::vector<int> numbers;
    for (const auto& packet : line.arrive(200 * millisecond)) {
      CHECK(packet.due >= due);
      due = packet.due;
      numbers.push_back(packet.message);
    }
    CHECK(numbers.size() == 100);
    CHECK_FALSE(std::is_sorted(numbers.begin(), numbers.end()));

    PacketLine<int> at_once({}, 1);
    for (int i = 0; i < 3; ++i) at_once.send(i, 0);
    const auto& arrived = at_once.arrive(0);
    CHECK((arrived.size() == 3 && arrived[0].message == 0 && arrived[2].message == 2));
    CHECK(at_once.arrived().size() == 3);
    CHECK(at_once.arrive(0).empty());
  }

  TEST_CASE("what is on its way is saved, and arrives") {
    PacketLine<int> line({.loss = 0.3, .held = 0.5}, 1);
    for (int i = 0; i < 100; ++i) line.send(i, 0);
    line.arrive(0);
    Archive::Bytes bytes;
    Archive to = Archive::to(bytes);
    line.serialize(to);
    PacketLine<int> restored({.loss = 0.3, .held = 0.5}, 1);
    Archive from = Archive::from(bytes);
    restored.serialize(from);
    CHECK(restored.arrived().size() == line.arrived().size());
    for (int i = 100; i < 200; ++i) {
      line.send(i, 1);
      restored.send(i, 1);
    }
    const auto &a = line.arrive(100 * millisecond), &b = restored.arrive(100 * millisecond);
    REQUIRE(a.size() == b.size());
    CHECK(a.size() > 80);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK((a[i].due == b[i].due && a[i].message == b[i].message));
  }

  TEST_CASE("a helicopter that is asked for each sonar reports it before the answer that says that it is new") {
    struct Order : messages::Receiver {
      void receive(messages::MessageRef message) override {
        if (const auto* sonars = message.as<javiator::SonarData>()) {
          all += 's';
          id = sonars->id;
        } else if (const auto* data = message.as<javiator::JaviatorData>()) {
          const bool is_new = (data->flags & javiator::JaviatorData::Flags::SONAR) != 0;
          all += is_new ? 'N' : '-';
          if (all.ends_with("sN")) CHECK(data->id == id);
        }
      }
      std::string all;
      int id = -1;
    };
    const auto order_of = [](std::uint8_t sonars, bool asks, FailureKind failure = FailureKind::none) {
      HelicopterParameters parameters;
      parameters.dynamics = Dynamics::rigid;
      parameters.sensors.sonars = sonars;
      parameters.failures.sonar.kind = failure;
      parameters.failures.sonar.at = 0;
      Helicopter helicopter(parameters, 1);
      Order order;
      if (asks) helicopter.accept(messages::refer_to(javiator::EnSensors{javiator::EnSensors::Enable::EACH_SONAR}));
      for (int i = 0; i < 30; ++i) {
        if (i % 3 == 0)
          helicopter.accept(messages::refer_to(javiator::MotorSignals{0, 0, 0, 0, static_cast<std::uint16_t>(i)}));
        helicopter.step();
        helicopter.sense(order);
      }
      return order.all;
    };
    CHECK(order_of(4, true) == "sN--sN--sN--sN");
    CHECK(order_of(4, false) == "N--N--N--N");
    CHECK(order_of(1, true) == "N--N--N--N");
    CHECK(order_of(4, true, FailureKind::lost) == "----------");
  }

  TEST_CASE("signals and answers of a helicopter are lost on their way, and answered twice where they come twice") {
    CHECK(answers_over({}, 10) == std::vector{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    CHECK(answers_over({.loss = 1}, 100).empty());
    CHECK(static_cast<double>(answers_over({.loss = 0.1}, 5000).size()) ==
          doctest::Approx(0.9 * 0.9 * 5000).scale(0).epsilon(0.02));
    // a signal that comes twice at once is answered once
    CHECK(static_cast<double>(answers_over({.repeated = 1}, 1000).size()) == 2000);
    const std::vector<int> late = answers_over({.held = 0.1}, 1000);
    // one that comes with another is answered with it
    CHECK(static_cast<double>(late.size()) == doctest::Approx(910).scale(0).epsilon(0.02));
    CHECK_FALSE(std::is_sorted(late.begin(), late.end()));
  }

  TEST_CASE("switches are not lost by chance, but where the radio is cut off") {
    HelicopterParameters parameters;
    parameters.packets = {.loss = 1};
    parameters.start = {.altitude = 10, .signal = 8000};
    Helicopter helicopter(parameters, 1);
    helicopter.accept(messages::refer_to(javiator::SwitchState{}));
    const HelicopterInputs hover{8000, 8000, 8000, 8000};
    helicopter.command(&hover);
    helicopter.accept(messages::refer_to(javiator::ShutDown{}));
    for (int i = 0; i < 200; ++i) helicopter.step();
    CHECK(static_cast<const HelicopterOutputs*>(helicopter.outputs())->rotors.front < 1);

    parameters.packets = {.cut_at = 0, .cut_time = 1};
    Helicopter cut_off(parameters, 1);
    cut_off.accept(messages::refer_to(javiator::ShutDown{}));
    CHECK(static_cast<const HelicopterOutputs*>(cut_off.outputs())->rotors.front > 7000);
  }
}
