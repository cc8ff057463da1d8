#include "distributers/links/simulation.h"

#include <doctest/doctest.h>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/imc.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;

// A vehicle whose depth is the number of its steps plus what its servo 0 was sent in the step before.
class Steps : public vehicles::Vehicle {
 public:
  Duration grid() const override { return 10ms; }
  void accept(messages::MessageRef command) override {
    if (const auto* servo = command.as<imc::SetServoPosition>(); servo != nullptr && servo->id == 0)
      held_ = servo->value;
  }
  void step() override { depth_ += 1 + held_; }
  void sense(messages::Receiver& receiver) const override {
    imc::SimulatedState state;
    state.z = depth_;
    receiver.receive(messages::refer_to(state));
  }
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return nullptr; }

 private:
  float depth_ = 0;
  float held_ = 0;
};

// One that can be neither saved nor restored.
class Unsaved : public Steps {
 public:
  void serialize(Archive&) override { throw std::logic_error("ser broke"); }
};

SimulatedSystem make() { return {std::make_unique<Steps>(), std::make_unique<Typed<LauvVehicle>>()}; }

double depth_of(SimulatedSystem& system) {
  tasks::Motion motion;
  CHECK(system.take(0, &motion));
  return motion.z;
}
}  // namespace

TEST_SUITE("distributers/links/simulation") {
  TEST_CASE("the vehicle steps on its own grid, whoever looks and how often") {
    auto seldom = make(), often = make();
    seldom.reach(100ms);
    for (Duration t{}; t <= 100ms; t += 5ms) often.reach(t);
    CHECK(depth_of(seldom) == 10);
    CHECK(depth_of(often) == 10);
  }

  TEST_CASE("at the start there is something to sense") {
    auto system = make();
    system.reach(0ms);
    CHECK(depth_of(system) == 0);
  }

  TEST_CASE("a command at an instant does not change what is sensed at it, and is held from then on") {
    auto system = make();
    system.reach(10ms);
    const tasks::Actuation actuation{0, {4, 0, 0, 0}};
    system.hand_over(3, &actuation);  // after motion, instruments and servos
    CHECK(depth_of(system) == 1);
    system.reach(30ms);
    CHECK(depth_of(system) == 11);
  }

  TEST_CASE("what a vehicle throws when it is saved or restored is said to be of it") {
    Archive::Bytes bytes;
    Archive archive = Archive::to(bytes);
    CHECK_THROWS_WITH_AS(make().serialize(archive), "its vehicle has no serialize(Archive&)", NotSaveable);
    SimulatedSystem system(std::make_unique<Unsaved>(), std::make_unique<Typed<LauvVehicle>>());
    bytes.clear();
    CHECK_THROWS_WITH_AS(system.serialize(archive), "its vehicle's serialize(Archive&) throws: ser broke", NotSaveable);
    Archive from = Archive::from(bytes);
    CHECK_THROWS_WITH_AS(system.serialize(from),
                         "can't be restored, as its vehicle's serialize(Archive&) throws: ser broke", ArchiveError);
  }
}
