// Which entity of the submarine is which leak sensor and which temperature of its hull.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/imc_entity.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;
using State = imc::EntityState::State;

struct Asked : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (message.as<imc::EntityList>() != nullptr) ++count;
  }
  int count = 0;
};

// A vehicle that names its entities.
struct Named {
  explicit Named(const LauvVehicleParameters& parameters = {}, std::string_view labels = "") : adapter(parameters) {
    imc::EntityList list;
    list.list = labels;
    adapter.receive(messages::refer_to(list));
  }
  void info(std::uint8_t entity, const char* label) {
    imc::EntityInfo one;
    one.id = entity;
    one.label = label;
    adapter.receive(messages::refer_to(one));
  }
  void state(std::uint8_t entity, bool failed) {
    imc::EntityState state;
    state.state = failed ? State::FAILURE : State::NORMAL;
    imc::send_from(entity, state, adapter);
  }
  void temperature(std::uint8_t entity, float value) { imc::send_from(entity, imc::Temperature{value}, adapter); }
  tasks::Instruments instruments() {
    tasks::Instruments i;
    adapter.take<&LauvVehicle::In::instruments>(i);
    return i;
  }
  Typed<LauvVehicle> adapter;
};

using Readings = std::array<tasks::Reading, tasks::hull_sensors>;
bool are(const Readings& a, const Readings& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const auto& x, const auto& y) { return x.value == y.value && x.count == y.count; });
}
Readings leaks_of(const tasks::Instruments& i) { return {i.leak, i.leak1, i.leak2, i.leak3}; }
Readings hull_of(const tasks::Instruments& i) {
  return {i.hull_temperature, i.hull_temperature1, i.hull_temperature2, i.hull_temperature3};
}

LauvVehicleParameters of_two() {
  LauvVehicleParameters parameters;
  parameters.leak.entity = "Leak Sensor - Nose";
  parameters.leak1.entity = "Leak Sensor - Tail";
  parameters.leak2.fitted = parameters.leak3.fitted = false;
  return parameters;
}
const std::string two = "Leak Simulator=16;Leak Sensor - Tail=17;Leak Sensor - Nose=18";
}  // namespace

TEST_SUITE("distributers/lauv_hull") {
  TEST_CASE("each leak sensor is the entity of its label, and what is not fitted says so") {
    Named vehicle(of_two(), two);
    vehicle.state(17, true);
    vehicle.state(18, false);
    vehicle.state(18, false);
    vehicle.state(16, true);  // the task that simulates them
    CHECK(are(leaks_of(vehicle.instruments()), {{{0, 2}, {1, 1}, {0, -1}, {0, -1}}}));
    vehicle.state(17, false);
    CHECK(vehicle.instruments().leak1.value == 0);
  }

  TEST_CASE(
      "labels that come one by one, as each entity says its own, are taken as those of a list, the last one counts") {
    Named vehicle(of_two());
    Asked asked;
    vehicle.info(16, "Leak Simulator");
    vehicle.info(17, "Leak Sensor - Tail");
    vehicle.info(18, "Leak Sensor - Nose");
    vehicle.info(Entities::nobody, "Leak Sensor - Nose");
    vehicle.state(17, true);
    vehicle.state(18, false);
    vehicle.state(18, false);
    vehicle.state(16, true);
    CHECK(are(leaks_of(vehicle.instruments()), {{{0, 2}, {1, 1}, {0, -1}, {0, -1}}}));
    vehicle.adapter.reach(std::chrono::milliseconds(50), asked);
    CHECK(asked.count == 0);
    vehicle.info(18, "Leak Sensor - Tail");
    vehicle.info(17, "Leak Sensor - Nose");
    vehicle.state(17, true);
    CHECK(vehicle.instruments().leak.value == 1);
  }

  TEST_CASE("unless parameters say which is which each is any whose label begins so: one in FAILURE is a leak") {
    Named vehicle({}, two);
    vehicle.state(17, true);
    vehicle.state(18, false);
    CHECK(are(leaks_of(vehicle.instruments()), {{{1, 1}, {1, 1}, {1, 1}, {1, 1}}}));
    vehicle.state(17, false);  // and a new reading only when both have reported
    CHECK(are(leaks_of(vehicle.instruments()), {{{0, 2}, {0, 2}, {0, 2}, {0, 2}}}));
  }

  TEST_CASE("a state of no entity is that of all leak sensors, a temperature of none is of the water alone") {
    Named vehicle;
    vehicle.state(Entities::nobody, true);
    vehicle.temperature(Entities::nobody, 12);
    const tasks::Instruments i = vehicle.instruments();
    CHECK(are(leaks_of(i), {{{1, 1}, {1, 1}, {1, 1}, {1, 1}}}));
    CHECK(are(hull_of(i), {}));
    CHECK((i.water_temperature.value == 12 && i.water_temperature.count == 1));
  }

  TEST_CASE("a temperature of the hull is that of its label, and none of the water's") {
    LauvVehicleParameters parameters;
    parameters.hull_temperature1.scale = 2;
    parameters.hull_temperature3.fitted = false;
    Named vehicle(parameters, "Hull Temperature 0=5;Hull Temperature 1=6;Hull Temperature 2=7;CTD=9");
    vehicle.temperature(5, 20);
    vehicle.temperature(6, 21);
    vehicle.temperature(7, 22);
    vehicle.temperature(7, 23);
    vehicle.temperature(9, 12);
    const tasks::Instruments i = vehicle.instruments();
    CHECK(are(hull_of(i), {{{20, 1}, {42, 1}, {23, 2}, {0, -1}}}));
    CHECK((i.water_temperature.value == 12 && i.water_temperature.count == 1));
  }

  TEST_CASE("a temperature of an entity whose label is not known yet is taken for none, and its label is asked for") {
    Named vehicle;
    vehicle.temperature(5, 20);
    vehicle.temperature(9, 12);
    const tasks::Instruments unnamed = vehicle.instruments();
    CHECK(are(hull_of(unnamed), {}));
    CHECK(unnamed.water_temperature.count == 0);
    Asked asked;
    vehicle.adapter.reach(std::chrono::milliseconds(50), asked);
    CHECK(asked.count == 1);
    imc::EntityList list;
    list.list = "Hull Temperature 0=5;CTD=9";
    vehicle.adapter.receive(messages::refer_to(list));
    vehicle.temperature(5, 21);
    vehicle.temperature(9, 13);
    const tasks::Instruments i = vehicle.instruments();
    CHECK(are(hull_of(i), {{{21, 1}, {}, {}, {}}}));
    CHECK((i.water_temperature.value == 13 && i.water_temperature.count == 1));
  }

  TEST_CASE(
      "of a vehicle without thermometers in its hull a temperature is of the water, whatever its entity's label") {
    LauvVehicleParameters parameters;
    for (LauvInstrument* hull : {&parameters.hull_temperature, &parameters.hull_temperature1,
                                 &parameters.hull_temperature2, &parameters.hull_temperature3})
      hull->fitted = false;
    Named vehicle(parameters);
    vehicle.temperature(9, 12);
    const tasks::Reading water = vehicle.instruments().water_temperature;
    CHECK((water.value == 12 && water.count == 1));
  }

  TEST_CASE("a vehicle whose labels are not known is asked for them") {
    Named vehicle(of_two());
    Asked asked;
    vehicle.state(17, true);
    vehicle.adapter.reach(std::chrono::milliseconds(50), asked);
    CHECK(asked.count == 1);
    CHECK(are(leaks_of(vehicle.instruments()), Readings{}));
  }
}
