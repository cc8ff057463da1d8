// A vehicle and a distributer of this program, in a closed loop with a task of it.
#include <doctest/doctest.h>
#include <jarol/distributers/interfaces/typed.h>
#include <jarol/distributers/interfaces/vehicle_class.h>
#include <jarol/distributers/messages/imc.h>
#include <jarol/session.h>
#include <jarol/tools/library/built_in.h>

#include <algorithm>

using namespace std::chrono_literals;
using jarol::describe, jarol::field, jarol::Tick;
namespace imc = jarol::messages::imc;

namespace {

// A balloon in water: its pump makes it lighter or heavier, drag slows it.
class Balloon : public jarol::vehicles::Vehicle {
 public:
  struct Parameters {
    double mass = 2;
    double drag = 4;
    static constexpr auto fields() {
      using P = Parameters;
      return describe(field<&P::mass>("kg", "of the balloon"), field<&P::drag>("kg/s", "force by speed"));
    }
  };
  struct Inputs {
    double pump = 0;
    static constexpr auto fields() { return describe(field<&Inputs::pump>("", "-1 (up) to 1 (down)")); }
    static std::vector<jarol::vehicles::Range> ranges() { return {{-1, 1}}; }
  };
  struct Gauge {
    double depth = 0;
    static constexpr auto fields() { return describe(field<&Gauge::depth>("m", "below the surface")); }
  };
  struct Outputs {
    Gauge gauge;
    static constexpr auto fields() { return describe(field<&Outputs::gauge>("", "the only instrument")); }
  };
  using Truth = Gauge;

  Balloon(const Parameters& parameters, std::uint64_t) : parameters_(parameters) {}
  std::chrono::nanoseconds grid() const override { return 10ms; }
  void accept(jarol::messages::MessageRef command) override {
    if (const auto* thrust = command.as<imc::SetThrusterActuation>()) inputs_.pump = thrust->value;
  }
  void step() override {
    const double w = state_.w, force = 10 * inputs_.pump - parameters_.drag * w;
    state_.w += 0.01 * force / parameters_.mass;
    state_.z += 0.01 * state_.w;
    outputs_.gauge.depth = truth_.depth = state_.z;
  }
  void sense(jarol::messages::Receiver& receiver) const override {
    imc::Depth depth;
    depth.value = static_cast<float>(state_.z);
    receiver.receive(jarol::messages::refer_to(depth));
  }
  const jarol::Type* true_type() const override { return &jarol::type_of<Truth>(); }
  const void* true_values() const override { return &truth_; }
  jarol::vehicles::VehicleState state() const override { return state_; }
  void place(const jarol::vehicles::VehicleState& state) override { state_ = state; }
  void command(const void* inputs) override { inputs_ = *static_cast<const Inputs*>(inputs); }
  const void* outputs() const override { return &outputs_; }

 private:
  Parameters parameters_;
  Inputs inputs_;
  Outputs outputs_;
  Truth truth_;
  jarol::vehicles::VehicleState state_;
};

// Its messages on one side, plain numbers on the other.
class BalloonGauge {
 public:
  static constexpr std::string_view summary = "a balloon with a pump, over IMC";
  static constexpr bool is_vehicle = true;
  struct In {
    jarol::distributers::Newest<double> depth;
    static constexpr auto fields() { return describe(jarol::distributers::channel<&In::depth>("below the surface")); }
  };
  struct Out {
    double pump = 0;
    static constexpr auto fields() { return describe(jarol::distributers::channel<&Out::pump>("-1 (up) to 1 (down)")); }
  };
  static const jarol::messages::MessageSet& message_set() { return imc::message_set(); }
  static constexpr auto handlers() {
    return jarol::distributers::handle(jarol::distributers::on<imc::Depth>(&BalloonGauge::depth),
                                       jarol::distributers::send<&Out::pump>(&BalloonGauge::pump));
  }
  In in;

  void depth(const imc::Depth& message) { in.depth = message.value; }
  void pump(const double& actuation, jarol::messages::Receiver& system) {
    imc::SetThrusterActuation command;
    command.value = static_cast<float>(actuation);
    system.receive(jarol::messages::refer_to(command));
  }
};

// A law for it.
struct HoldDepth {
  static constexpr std::string_view summary = "holds a depth";
  struct Param {
    double depth = 2;
    static constexpr auto fields() { return describe(field<&Param::depth>("m", "to be held")); }
  };
  struct In {
    double depth = 0;
    static constexpr auto fields() { return describe(field<&In::depth>("m", "measured")); }
  };
  struct State {
    double before = 0;
    static constexpr auto fields() { return describe(field<&State::before>("m", "the depth before")); }
  };
  struct Out {
    double pump = 0;
    static constexpr auto fields() { return describe(field<&Out::pump>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
    const double speed = (in.depth - state.before) / std::chrono::duration<double>(tick.period).count();
    state.before = in.depth;
    out.pump = std::clamp(0.5 * (p.depth - in.depth) - 0.4 * speed, -1.0, 1.0);
  }
};

jarol::distributers::Registries with_balloon() {
  jarol::distributers::Registries known = jarol::built_in();
  known.graph.add(jarol::task_class<HoldDepth>());
  known.graph.add(jarol::distributers::distributer_class<BalloonGauge>());
  known.vehicles.add(jarol::vehicles::vehicle_class<Balloon>("balloon", imc::message_set(), "a balloon in water"));
  return known;
}
}  // namespace

TEST_CASE("a graph joins a vehicle, a distributer and a task of this program, and its parameters are changed by name") {
  const jarol::distributers::Registries known = with_balloon();
  jarol::Session session(known, HERE "/balloon_graph.yaml", {.set = {"tasks.hold.parameters.depth=3 m"}});
  session.run_until(60s);
  CHECK(session.true_value("depth of balloon") == doctest::Approx(3).epsilon(0.01));
  CHECK(session.value<double>("gauge") == doctest::Approx(session.true_value("depth of balloon")).epsilon(1e-3));
  const jarol::RunVerdict verdict = session.finish();
  REQUIRE(verdict.expectations.size() == 1);
  CHECK(verdict.expectations[0].outcome == jarol::Verdict::Outcome::holds);
}

TEST_CASE("what is wrong with it is reported as with what is built in") {
  const jarol::distributers::Registries known = with_balloon();
  CHECK_THROWS_WITH_AS(jarol::Session(known, HERE "/balloon_graph.yaml", {.set = {"tasks.hold.parameters.dept=3 m"}}),
                       "--set:1:1: error: task 'hold' (HoldDepth) has no parameter 'dept'; did you mean 'depth'?; it "
                       "has: depth\n  tasks.hold.parameters.dept=3 m\n  ^",
                       jarol::SpecError);
}
