// Four leak sensors and four temperatures of the hull: each an entity of its own, with a reading and a failure of its
// own.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "distributers/messages/imc.h"
#include "vehicles/submarine/submarine.h"
#include "vehicles/submarine/telemetry.h"

namespace {
using namespace jarol::vehicles;
using namespace std::chrono_literals;
namespace messages = jarol::messages;
namespace imc = messages::imc;
using State = imc::EntityState::State;

// What came from each entity last, and how often.
struct Heard : messages::Receiver {
  void receive(messages::MessageRef message) override {
    names.emplace_back(message.descriptor->name);
    const int from = message.header == nullptr ? 255 : static_cast<const imc::Header*>(message.header)->src_ent;
    if (const auto* m = message.as<imc::EntityState>()) states[from] = m->state, ++counts[from];
    if (const auto* m = message.as<imc::Temperature>()) temperatures[from] = m->value, ++counts[from];
    if (const auto* m = message.as<imc::EntityList>()) labels = m->list.view();
    if (const auto* m = message.as<imc::VehicleState>()) loops = m->control_loops;
  }
  std::vector<std::string> names;
  std::map<int, int> states, counts;
  std::map<int, float> temperatures;
  std::string labels;
  std::uint32_t loops = 1;
};

// What was heard up to then.
Heard heard_in(const SubmarineParameters& parameters, std::chrono::nanoseconds time) {
  Submarine submarine(parameters);
  Heard heard;
  submarine.sense(heard);
  for (auto at = submarine.grid(); at <= time; at += submarine.grid()) {
    submarine.step();
    submarine.sense(heard);
  }
  return heard;
}

using Sensors = SubmarineSensorParameters;
constexpr std::array leaks{&Sensors::leak, &Sensors::leak1, &Sensors::leak2, &Sensors::leak3};
constexpr std::array temperatures{&Sensors::hull_temperature, &Sensors::hull_temperature1, &Sensors::hull_temperature2,
                                  &Sensors::hull_temperature3};
}  // namespace

TEST_SUITE("vehicles/submarine_hull") {
  TEST_CASE("labels come each second before what has them, with the word that it does not steer itself") {
    const Heard heard = heard_in({}, 990ms);
    CHECK(heard.labels ==
          "Leak Sensor 0=1;Hull Temperature 0=5;Leak Sensor 1=2;Hull Temperature 1=6;"
          "Leak Sensor 2=3;Hull Temperature 2=7;Leak Sensor 3=4;Hull Temperature 3=8");
    CHECK(heard.loops == 0);
    REQUIRE(heard.names.size() > 3);
    CHECK(heard.names[0] == "SimulatedState");
    CHECK(heard.names[1] == "VehicleState");
    CHECK(heard.names[2] == "EntityList");
    CHECK(std::count(heard.names.begin(), heard.names.end(), "EntityList") == 1);
    const Heard longer = heard_in({}, 1s);
    CHECK(std::count(longer.names.begin(), longer.names.end(), "EntityList") == 2);
    CHECK(std::count(longer.names.begin(), longer.names.end(), "VehicleState") == 2);
  }

  TEST_CASE("each leak sensor reports its state each second, and water in the hull is at all of them") {
    const auto all_four = [](int state) { return std::map<int, int>{{1, state}, {2, state}, {3, state}, {4, state}}; };
    SubmarineParameters parameters;
    CHECK(heard_in(parameters, 3s).states == all_four(State::NORMAL));
    CHECK(heard_in(parameters, 3s).counts[3] == 4);
    parameters.leak_at = 2s;
    CHECK(heard_in(parameters, 1990ms).states == all_four(State::NORMAL));
    CHECK(heard_in(parameters, 2s).states == all_four(State::FAILURE));
  }

  TEST_CASE("each temperature of the hull is reported each second by its entity, that of the water by none") {
    SubmarineParameters parameters;
    parameters.sensors.hull_temperature2.bias = 3;
    Heard heard = heard_in(parameters, 3s);
    CHECK(heard.temperatures[5] > 14);  // of its 24 W
    CHECK(heard.temperatures[6] == heard.temperatures[5]);
    CHECK(heard.temperatures[7] == doctest::Approx(heard.temperatures[5] + 3));
    CHECK(heard.temperatures[8] == heard.temperatures[5]);
    CHECK(heard.temperatures[255] == 14);
    CHECK(heard.counts.at(8) == 4);
  }

  TEST_CASE("what fails by its name is that sensor alone: `leak` and `hull_temperature` are the first") {
    for (std::size_t i = 0; i < leaks.size(); ++i) {
      CAPTURE(i);
      SubmarineParameters parameters;
      (parameters.sensors.*leaks[i]).failure = {.kind = FailureKind::biased, .at = 1, .by = 1};
      (parameters.sensors.*temperatures[i]).failure = {.kind = FailureKind::lost, .at = 1.5};
      Heard heard = heard_in(parameters, 3s);
      for (int k = 0; k < 4; ++k) {
        const bool fails = k == static_cast<int>(i);
        CHECK(heard.states.at(1 + k) == (fails ? State::FAILURE : State::NORMAL));
        CHECK(heard.counts.at(5 + k) == (fails ? 2 : 4));
      }
    }
  }

  TEST_CASE("a leak that the first sensor does not see, as it is stuck, the others do") {
    SubmarineParameters parameters;
    parameters.leak_at = 2s;
    parameters.sensors.leak.failure = {.kind = FailureKind::stuck, .at = 1};
    CHECK(heard_in(parameters, 3s).states ==
          std::map<int, int>{{1, State::NORMAL}, {2, State::FAILURE}, {3, State::FAILURE}, {4, State::FAILURE}});
  }

  TEST_CASE("the outputs have a reading of each") {
    SubmarineParameters parameters;
    const auto biases = {0.0, 1.0, 2.0, 3.0};
    std::size_t i = 0;
    for (const double bias : biases) {
      (parameters.sensors.*leaks[i]).bias = bias;
      (parameters.sensors.*temperatures[i++]).bias = bias;
    }
    const Submarine submarine(parameters);
    const auto& out = *static_cast<const SubmarineOutputs*>(submarine.outputs());
    CHECK(std::array{out.sensors.leak, out.hull.leak1, out.hull.leak2, out.hull.leak3} ==
          std::array{0.0, 1.0, 2.0, 3.0});
    CHECK(std::array{out.sensors.hull_temperature, out.hull.hull_temperature1, out.hull.hull_temperature2,
                     out.hull.hull_temperature3} == std::array{14.0, 15.0, 16.0, 17.0});
  }

  TEST_CASE("noise of one changes no other") {
    SubmarineParameters noisy;
    noisy.sensors.hull_temperature1.noise = 0.1;
    const Heard with = heard_in(noisy, 1s), without = heard_in({}, 1s);
    for (const int entity : {5, 7, 8}) CHECK(with.temperatures.at(entity) == without.temperatures.at(entity));
    CHECK(with.temperatures.at(6) != without.temperatures.at(6));
  }

  TEST_CASE("to a peer each goes out as its own entity, and none takes the place of another or of the water's") {
    SubmarineParameters parameters;
    parameters.sensors.leak1.failure = {.kind = FailureKind::biased, .at = 0, .by = 1};
    Submarine submarine(parameters);
    Heard heard;
    SubmarineTelemetry telemetry(heard);
    for (int i = 0; i < 100; ++i) {
      submarine.sense(telemetry);
      submarine.step();
    }
    CHECK(heard.states ==
          std::map<int, int>{{1, State::NORMAL}, {2, State::FAILURE}, {3, State::NORMAL}, {4, State::NORMAL}});
    CHECK(heard.counts == std::map<int, int>{{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}, {6, 1}, {7, 1}, {8, 1}, {255, 7}});
    CHECK(heard.temperatures.at(255) == 14);
  }
}
