// When a vehicle that is steered from outside was silent, and what its actuators did then.
#include "distributers/serve/silence_log.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "graph/values/type_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Fins {
  double rudder = 0;
  float elevator = 0;
  static constexpr auto fields() { return describe(field<&Fins::rudder>("rad"), field<&Fins::elevator>("rad")); }
};
struct Actuated {
  Fins fins;
  static constexpr auto fields() { return describe(field<&Actuated::fins>()); }
};

// Sinks by one metre in each step of 100 ms, and turns its rudder.
struct Sinker : vehicles::Vehicle {
  std::chrono::nanoseconds grid() const override { return 100ms; }
  void accept(messages::MessageRef) override {}
  void step() override {
    ++steps;
    now.fins = {0.5 * steps, 0.25F};
  }
  void sense(messages::Receiver&) const override {}
  vehicles::VehicleState state() const override { return {.z = static_cast<double>(steps)}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return &now; }
  int steps = 0;
  Actuated now;
};

// 2.4 s, with messages at these steps.
SilenceLog log_of(const std::vector<int>& heard, const vehicles::VehicleClass& vehicle_class) {
  Sinker vehicle;
  SilenceLog log(vehicle_class);
  for (int i = 0; i <= 24; ++i) {
    if (i > 0) vehicle.step();
    log.add({i * 100ms, std::find(heard.begin(), heard.end(), i) != heard.end(), vehicle});
  }
  return log;
}
}  // namespace

TEST_SUITE("distributers/silence_log") {
  TEST_CASE("a peer is silent after half a second without a message, and what the vehicle did until the next is kept") {
    vehicles::VehicleClass sinkers;
    sinkers.outputs = &type_of<Actuated>();

    const SilenceLog silent = log_of({3, 9, 20}, sinkers);
    CHECK(silent.silences() == 1);  // it still was patient at 800 ms
    CHECK(silent.silent_for() == 1000ms);
    REQUIRE(silent.kept().size() == 1);
    CHECK(silent.kept()[0].from == 900ms);
    CHECK(silent.kept()[0].to == 1900ms);
    CHECK(silent.kept()[0].state.z == 19);
    CHECK(silent.kept()[0].actuators == std::vector<double>{9.5, 0.25});

    const SilenceLog twice = log_of({10}, sinkers);
    CHECK(twice.silences() == 2);
    CHECK(twice.silent_for() == 900ms + 1400ms);
    REQUIRE(twice.kept().size() == 2);
    CHECK(twice.kept()[0].from == 0ms);
    CHECK(twice.kept()[1].to == 2400ms);
  }
}
