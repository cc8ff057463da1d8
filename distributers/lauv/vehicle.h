// The submarine as the core sees it: its motion and instruments come in, its actuation goes out.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "distributers/interfaces/distributer.h"
#include "distributers/messages/imc.h"
#include "graph/values/type_of.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {
namespace imc = messages::imc;

/// Speaks IMC: SimulatedState or EstimatedState, whichever came last, and what instruments report in;
/// SetThrusterActuation and SetServoPosition out. A field that is no number beside others that are is one that the
/// instrument does not measure; a reading that is not finite otherwise is counted and left out.
class LauvVehicle {
 public:
  static constexpr std::string_view summary = "the submarine, over IMC";
  static constexpr bool is_vehicle = true;

  struct In {
    Newest<tasks::Motion> motion;
    Newest<tasks::Instruments> instruments;
    static constexpr auto fields() {
      return describe(channel<&In::motion>("position, attitude and velocities"),
                      channel<&In::instruments>("what the instruments tell"));
    }
  };
  struct Out {
    tasks::Actuation actuation;
    static constexpr auto fields() { return describe(channel<&Out::actuation>("commands for propeller and fins")); }
  };

  static const messages::MessageSet& message_set() { return imc::message_set(); }
  static constexpr auto handlers() {
    using V = LauvVehicle;
    return handle(on<imc::SimulatedState>(&V::simulated_state), on<imc::EstimatedState>(&V::estimated_state),
                  on<imc::EulerAngles>(&V::angles), on<imc::AngularVelocity>(&V::rates),
                  on<imc::Acceleration>(&V::forces), on<imc::WaterVelocity>(&V::velocity), on<imc::Rpm>(&V::rpm),
                  on<imc::GpsFix>(&V::fix), on<imc::Depth>(&V::depth), on<imc::Pressure>(&V::pressure),
                  on<imc::Conductivity>(&V::conductivity), on<imc::Temperature>(&V::temperature),
                  on<imc::Distance>(&V::distance), on<imc::EntityState>(&V::entity), on<imc::Voltage>(&V::voltage),
                  on<imc::Current>(&V::current), send<&Out::actuation>(&V::send_actuation));
  }

  /// DUNE listens to systems that have announced themselves only.
  void announce(Duration instant, messages::Receiver& all);
  void listen_at(const std::string& address) { address_ = address; }
  std::uint64_t non_finite_inputs() const { return non_finite_inputs_; }

  In in;

 private:
  void simulated_state(const imc::SimulatedState& m);
  void estimated_state(const imc::EstimatedState& m);
  void angles(const imc::EulerAngles& m);
  void rates(const imc::AngularVelocity& m) { note(&tasks::Instruments::rates, m.x, m.y, m.z); }
  void forces(const imc::Acceleration& m) { note(&tasks::Instruments::forces, m.x, m.y, m.z); }
  void velocity(const imc::WaterVelocity& m) { note(&tasks::Instruments::velocity, m.x, m.y, m.z); }
  void rpm(const imc::Rpm& m) { note(&tasks::Instruments::rpm, m.value); }
  void fix(const imc::GpsFix& m);
  void depth(const imc::Depth& m) { note(&tasks::Instruments::depth, m.value); }
  void pressure(const imc::Pressure& m) { note(&tasks::Instruments::pressure, m.value); }
  void conductivity(const imc::Conductivity& m) { note(&tasks::Instruments::conductivity, m.value); }
  void temperature(const imc::Temperature& m) { note(&tasks::Instruments::water_temperature, m.value); }
  void distance(const imc::Distance& m);
  void entity(const imc::EntityState& m);
  void voltage(const imc::Voltage& m) { note(&tasks::Instruments::voltage, m.value); }
  void current(const imc::Current& m) { note(&tasks::Instruments::current, m.value); }
  void send_actuation(const tasks::Actuation& actuation, messages::Receiver& system);

  void place(double latitude, double longitude);
  void note(tasks::Reading tasks::Instruments::*reading, double value);
  void note(tasks::VectorReading tasks::Instruments::*reading, double x, double y, double z);
  bool all_finite(std::initializer_list<double> values);  // else that is counted

  std::uint64_t non_finite_inputs_ = 0;
  double latitude_ = 0, longitude_ = 0;  // of the first fix
  std::string address_;
  std::optional<Duration> announced_;
};

}  // namespace jarol::distributers
