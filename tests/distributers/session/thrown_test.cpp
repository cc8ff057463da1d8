// What a vehicle and a distributer of a program's own throw that is no exception.
#include <doctest/doctest.h>

#include "distributers/interfaces/typed.h"
#include "distributers/interfaces/vehicle_class.h"
#include "distributers/messages/imc.h"
#include "distributers/session/session.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
namespace imc = messages::imc;

std::string thrown_by;  // where; empty: nowhere

void maybe_throw(std::string_view where) {
  if (thrown_by == where) throw 42;
}

struct Depth {
  double depth = 0;
  static constexpr auto fields() { return describe(field<&Depth::depth>("m")); }
};
struct Pump {
  double pump = 0;
  static constexpr auto fields() { return describe(field<&Pump::pump>()); }
  static std::vector<vehicles::Range> ranges() { return {{-1, 1}}; }
};
struct Mass {
  double mass = 1;
  static constexpr auto fields() { return describe(field<&Mass::mass>("kg")); }
};
struct Gauges {
  Depth gauge{};
  static constexpr auto fields() { return describe(field<&Gauges::gauge>()); }
};

class Balloon : public vehicles::Vehicle {
 public:
  using Parameters = Mass;
  using Inputs = Pump;
  using Outputs = Gauges;
  using Truth = Depth;
  Balloon(const Mass&, std::uint64_t) {}
  Duration grid() const override { return 10ms; }
  void accept(messages::MessageRef) override { maybe_throw("accept"); }
  void step() override {
    maybe_throw("step");
    truth_.depth += 1;
  }
  void sense(messages::Receiver& receiver) const override {
    maybe_throw("sense");
    imc::Depth depth;
    depth.value = static_cast<float>(truth_.depth);
    receiver.receive(messages::refer_to(depth));
  }
  const Type* true_type() const override { return &type_of<Depth>(); }
  const void* true_values() const override { return &truth_; }
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return &outputs_; }
  void serialize(Archive& archive) override {
    maybe_throw("serialize");
    archive(truth_.depth);
  }

 private:
  Depth truth_;
  Gauges outputs_;
};

class Radio {
 public:
  static constexpr std::string_view summary = "for tests";
  static constexpr bool is_vehicle = true;
  struct In {
    distributers::Newest<double> depth;
    static constexpr auto fields() { return describe(distributers::channel<&In::depth>("below")); }
  };
  struct Out {
    double pump = 0;
    static constexpr auto fields() { return describe(distributers::channel<&Out::pump>("-1 to 1")); }
  };
  static const messages::MessageSet& message_set() { return imc::message_set(); }
  static constexpr auto handlers() {
    return distributers::handle(distributers::on<imc::Depth>(&Radio::hear),
                                distributers::send<&Out::pump>(&Radio::speak));
  }
  In in;
  Radio() { maybe_throw("constructor"); }
  void hear(const imc::Depth& message) {
    maybe_throw("handler");
    in.depth = message.value;
  }
  void speak(const double& pump, messages::Receiver& system) {
    maybe_throw("send");
    imc::SetThrusterActuation command;
    command.value = static_cast<float>(pump);
    system.receive(messages::refer_to(command));
  }
  void serialize(Archive&) { maybe_throw("serialize of the distributer"); }
};

const distributers::Registries& parts_that_throw() {
  static const distributers::Registries all = [] {
    distributers::Registries made = tests::all_parts_with<>();
    made.graph.add(distributers::distributer_class<Radio>());
    made.vehicles.add(vehicles::vehicle_class<Balloon>("balloon", imc::message_set(), "for tests"));
    return made;
  }();
  return all;
}

struct Throwing {
  explicit Throwing(const std::string& where) { thrown_by = where; }
  ~Throwing() { thrown_by.clear(); }
  Throwing(const Throwing&) = delete;
  Throwing& operator=(const Throwing&) = delete;
};

std::shared_ptr<const Source> sinking() {
  return std::make_shared<const Source>(Source{"tests/distributers/session/t.yaml", R"(graph: t
timing: {period: 100ms}
distributers:
  balloon: {type: Radio, link: {type: simulation, vehicle: balloon.yaml}}
communicators:
  gauge: {channel: balloon.depth}
  pump:  {channel: balloon.pump, offset: 50ms}
connections: [gauge -> pump]
expect: [max(depth of balloon) < 1000]
)"});
}

const std::string no_exception = "something was thrown that is no exception";
}  // namespace

TEST_SUITE("distributers/session/thrown") {
  TEST_CASE("whatever a vehicle or a distributer throws ends the run, whose verdict is negative") {
    for (const char* where : {"step", "sense", "handler", "send", "accept"}) {
      CAPTURE(where);
      Session session(parts_that_throw(), sinking());
      session.run_until(1s);
      {
        const Throwing throwing(where);
        CHECK_THROWS_WITH_AS(session.run_until(2s), no_exception.c_str(), SystemLost);
      }
      const Duration at = session.now();
      CHECK(at <= 1050ms);
      CHECK_THROWS_WITH_AS(session.run_until(2s),
                           ("the run is over at " + seconds_text(at) + " s: " + no_exception).c_str(), RunOver);
      CHECK_THROWS_WITH_AS(session.checkpoint(),
                           ("there is nothing to save, as the run is over: " + no_exception).c_str(), RunOver);
      const RunVerdict verdict = session.finish();
      CHECK(verdict.is_negative());
      CHECK(verdict.stopped == no_exception);
      CHECK(session.report().instants < 40);
    }
  }

  TEST_CASE("what is thrown while a run is saved or restored refuses the checkpoint") {
    struct Case {
      const char* where;
      const char* whose;
    };
    for (const Case& each : {Case{"serialize", "its vehicle's"}, {"serialize of the distributer", "its"}}) {
      const char* const where = each.where;
      const std::string whose = each.whose;
      CAPTURE(where);
      Session session(parts_that_throw(), sinking());
      session.run_until(1s);
      const Checkpoint saved = session.checkpoint();
      const std::string what = whose + " serialize(Archive&) throws: something that is no exception";
      {
        const Throwing throwing(where);
        CHECK_THROWS_WITH_AS(session.checkpoint(), ("distributer 'balloon': " + what).c_str(), CheckpointRefused);
        CHECK_THROWS_WITH_AS(
            session.restore(saved),
            ("the checkpoint is damaged: what it says of the run can't be restored, as " + what).c_str(),
            CheckpointRefused);
      }
      CHECK_THROWS_WITH_AS(session.run_until(2s), "the run is over at 1 s: what was to be restored is damaged",
                           RunOver);
      session.restore(saved);
      session.run_until(2s);
      CHECK_FALSE(session.finish().is_negative());
    }
  }

  TEST_CASE("a distributer that can't be made is an error of the graph, with its place") {
    const Throwing throwing("constructor");
    CHECK_THROWS_WITH_AS(Session(parts_that_throw(), sinking()),
                         "tests/distributers/session/t.yaml:4:32: error: distributer 'balloon': its constructor throws "
                         "what is no std::exception\n"
                         "    balloon: {type: Radio, link: {type: simulation, vehicle: balloon.yaml}}\n"
                         "                                 ^",
                         SpecError);
  }
}
