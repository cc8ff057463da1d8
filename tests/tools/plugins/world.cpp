// A vehicle and its distributer, as a plugin brings them: a lamp that is switched by the JAviator's idle limit.
#include <stdexcept>
#include <string>

#include "distributers/interfaces/plugin_distributer.h"
#include "distributers/interfaces/plugin_vehicle.h"
#include "distributers/messages/javiator.h"
#include "graph/plugins/plugin.h"

namespace {
using jarol::describe, jarol::field;
using jarol::messages::javiator::IdleLimit;

class Lamp : public jarol::vehicles::Vehicle {
 public:
#ifdef CLASH_OF_VEHICLES
  static constexpr std::string_view name = "submarine";
#else
  static constexpr std::string_view name = "lamp";
#endif
  static constexpr std::string_view summary = "shines";
  static const jarol::messages::MessageSet& message_set() { return jarol::messages::javiator::message_set(); }
  struct Parameters {
    double gain = 1;
    static constexpr auto fields() { return describe(field<&Parameters::gain>("", "of its light")); }
  };
  struct Inputs {
    double level = 0;
    static constexpr auto fields() { return describe(field<&Inputs::level>()); }
#ifdef TWO_RANGES
    static std::vector<jarol::vehicles::Range> ranges() {
      return {{0, 1000}, { 0, 1 }};
    }
#else
    static std::vector<jarol::vehicles::Range> ranges() { return {{0, 1000}}; }
#endif
  };
  struct Light {
    double light = 0;
    static constexpr auto fields() { return describe(field<&Light::light>("", "of the lamp")); }
  };
  struct Outputs {
    Light lamp;
    static constexpr auto fields() { return describe(field<&Outputs::lamp>()); }
  };
  using Truth = Light;

  Lamp(const Parameters& parameters, std::uint64_t) : parameters_(parameters) {
    if (parameters.gain > 1000) throw 5;
  }
  // none where it has no light
  std::chrono::nanoseconds grid() const override { return std::chrono::milliseconds(parameters_.gain == 0 ? 0 : 10); }
  void accept(jarol::messages::MessageRef command) override {
    if (const auto* limit = command.as<IdleLimit>()) inputs_.level = limit->idle;
  }
  void step() override {
    if (inputs_.level == 0.5) throw 5;
    if (inputs_.level > 900)
      throw std::runtime_error("its filament breaks at level " + std::to_string(static_cast<int>(inputs_.level)));
    outputs_.lamp.light = parameters_.gain * inputs_.level;
  }
  void sense(jarol::messages::Receiver&) const override {}
  const jarol::Type* true_type() const override { return &jarol::type_of<Truth>(); }
  const void* true_values() const override { return &outputs_.lamp; }
  jarol::vehicles::VehicleState state() const override { return {}; }
  void place(const jarol::vehicles::VehicleState&) override {}
  void command(const void* inputs) override { inputs_ = *static_cast<const Inputs*>(inputs); }
  const void* outputs() const override { return &outputs_; }

 private:
  Parameters parameters_;
  Inputs inputs_;
  Outputs outputs_;
};

#ifdef CLASH_OF_DISTRIBUTERS
#define LampSwitch LauvOperator
#endif
struct LampSwitch {
  static constexpr std::string_view summary = "a lamp";
  static constexpr bool is_vehicle = true;
  struct In {
    jarol::distributers::Newest<double> echo;
    static constexpr auto fields() { return describe(jarol::distributers::channel<&In::echo>("what it shines at")); }
  };
  struct Out {
    double level = 0;
    static constexpr auto fields() { return describe(jarol::distributers::channel<&Out::level>("of its light")); }
  };
  static const jarol::messages::MessageSet& message_set() { return jarol::messages::javiator::message_set(); }
  static constexpr auto handlers() {
    return jarol::distributers::handle(jarol::distributers::on<IdleLimit>(&LampSwitch::hear),
                                       jarol::distributers::send<&Out::level>(&LampSwitch::send));
  }
  In in;
  void hear(const IdleLimit& message) { in.echo = static_cast<double>(message.idle); }
  void send(const double& level, jarol::messages::Receiver& lamp) {
    IdleLimit message;
    message.idle = static_cast<decltype(message.idle)>(level);
    lamp.receive(jarol::messages::refer_to(message));
  }
};
}  // namespace

JAROL_PLUGIN(LampSwitch, Lamp)
