// The submarine as the core sees it: its motion and instruments come in, its actuation goes out.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "distributers/interfaces/distributer.h"
#include "distributers/lauv/entities.h"
#include "distributers/lauv/leak_sensor.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/imc_announce.h"
#include "graph/math/geometry.h"
#include "graph/values/type_of.h"
#include "tasks/values/fins.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {
namespace imc = messages::imc;

/// Which entity of the vehicle an instrument is. A message of no entity is taken for any of them, and read as IMC has
/// it; one of an entity as is said here.
struct LauvInstrument {
  String entity = "*";
  double scale = 1;
  bool fitted = true;

  static constexpr auto fields() {
    using I = LauvInstrument;
    return describe(field<&I::entity>("", "its label, or the begin of several and *"),
                    field<&I::scale>("", "of the readings of an entity, to have them in IMC's unit"),
                    field<&I::fitted>("", "false: nobody waits for it"));
  }
};

/// Labels of altimeter and leak sensors are DUNE's, where each leak sensor is any, and those of the hull's temperatures
/// are of our own submarine.
struct LauvVehicleParameters {
  LauvInstrument depth{}, pressure{}, attitude{}, rates{}, forces{}, heading{}, velocity{}, rpm{}, place{},
      altitude{.entity = "Altimeter*"}, conductivity{}, water_temperature{}, leak{.entity = "Leak*"},
      leak1{.entity = "Leak*"}, leak2{.entity = "Leak*"}, leak3{.entity = "Leak*"},
      hull_temperature{.entity = "Hull Temperature 0"}, hull_temperature1{.entity = "Hull Temperature 1"},
      hull_temperature2{.entity = "Hull Temperature 2"}, hull_temperature3{.entity = "Hull Temperature 3"}, voltage{},
      current{}, ranges{}, servos{};
  bool gravity = true;
  double latitude = 41.1850 * degree;
  double longitude = -8.7062 * degree;

  static constexpr auto fields() {
    using P = LauvVehicleParameters;
    return describe(
        field<&P::depth>("", "Depth"), field<&P::pressure>("", "Pressure"),
        field<&P::attitude>("", "EulerAngles: roll, pitch, yaw"), field<&P::rates>("", "AngularVelocity"),
        field<&P::forces>("", "Acceleration"), field<&P::heading>("", "EulerAngles: the magnetic heading"),
        field<&P::velocity>("", "WaterVelocity"), field<&P::rpm>("", "Rpm"), field<&P::place>("", "GpsFix"),
        field<&P::altitude>("", "Distance, downward"), field<&P::conductivity>("", "Conductivity"),
        field<&P::water_temperature>("", "Temperature"), field<&P::leak>("", "EntityState: each in FAILURE is a leak"),
        field<&P::leak1>("", "likewise, of the second leak sensor"),
        field<&P::leak2>("", "likewise, of the third leak sensor"),
        field<&P::leak3>("", "likewise, of the fourth leak sensor"),
        field<&P::hull_temperature>("", "Temperature of an entity that is this one: no other instrument's"),
        field<&P::hull_temperature1>("", "likewise, of the second sensor"),
        field<&P::hull_temperature2>("", "likewise, of the third sensor"),
        field<&P::hull_temperature3>("", "likewise, of the fourth sensor"), field<&P::voltage>("", "Voltage"),
        field<&P::current>("", "Current"), field<&P::ranges>("", "LblRange"), field<&P::servos>("", "ServoPosition"),
        field<&P::gravity>("", "an entity's Acceleration is what a mass at rest feels: less gravity"),
        field<&P::latitude>("rad", "of the origin, WGS-84, unless the first fix is 100 km from it: then that"),
        field<&P::longitude>("rad", "of the origin"));
  }
};

/// Speaks IMC: SimulatedState or EstimatedState, whichever came last, and what instruments report in;
/// SetThrusterActuation and SetServoPosition out. A field that is no number beside others that are is one that the
/// instrument does not measure; a reading that is not finite otherwise is counted and left out. Which entity is which
/// instrument, the parameters say by the labels that the vehicle gives its entities. While a vehicle says that control
/// loops of its own are on (VehicleState), nothing is sent: two controllers at one fin are worse than either.
class LauvVehicle {
 public:
  static constexpr std::string_view summary = "the submarine, over IMC";
  static constexpr bool is_vehicle = true;
  using Param = LauvVehicleParameters;

  struct In {
    Newest<tasks::Motion> motion;
    Newest<tasks::Instruments> instruments;
    Newest<tasks::Servos> servos;
    static constexpr auto fields() {
      return describe(
          channel<&In::motion>("position, attitude and velocities"),
          channel<&In::instruments>("what the instruments report"),
          channel<&In::servos>("where the fins are and how fast the propeller is, and what they were sent"));
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
                  on<imc::Current>(&V::current), on<imc::EntityInfo>(&V::entity_info),
                  on<imc::EntityList>(&V::entity_list), on<imc::LblConfig>(&V::beacons), on<imc::LblRange>(&V::range),
                  on<imc::ServoPosition>(&V::servo), on<imc::VehicleState>(&V::vehicle_state),
                  on<imc::ControlLoops>(&V::control_loops), send<&Out::actuation>(&V::send_actuation));
  }

  explicit LauvVehicle(const Param& parameters);

  /// Asks for the labels of entities that are needed and not known.
  void reach(Duration instant, messages::Receiver& system);
  /// DUNE listens to systems that have announced themselves only.
  void announce(Duration instant, messages::Receiver& all);
  void listen_at(const std::string& address) { address_ = address; }
  void peer_changed();
  /// Or may, as it has not said yet.
  bool steers_itself() const;
  std::uint64_t non_finite_inputs() const { return non_finite_inputs_; }
  /// Without what concerns a link to elsewhere.
  void serialize(Archive& archive) {
    archive(entities_, leaks_, label_lacks_, asked_, non_finite_inputs_, beacons_, sent_, reached_, steers_itself_,
            met_, has_said_);
  }

  In in;

 private:
  void simulated_state(const imc::SimulatedState& m);
  void estimated_state(const imc::EstimatedState& m);
  void angles(const imc::EulerAngles& m, const messages::MessageRef& from);
  void rates(const imc::AngularVelocity& m, const messages::MessageRef& from);
  void forces(const imc::Acceleration& m, const messages::MessageRef& from);
  void velocity(const imc::WaterVelocity& m, const messages::MessageRef& from);
  void rpm(const imc::Rpm& m, const messages::MessageRef& from);
  void fix(const imc::GpsFix& m, const messages::MessageRef& from);
  void depth(const imc::Depth& m, const messages::MessageRef& from);
  void pressure(const imc::Pressure& m, const messages::MessageRef& from);
  void conductivity(const imc::Conductivity& m, const messages::MessageRef& from);
  void temperature(const imc::Temperature& m, const messages::MessageRef& from);
  void distance(const imc::Distance& m, const messages::MessageRef& from);
  void entity(const imc::EntityState& m, const messages::MessageRef& from);
  void voltage(const imc::Voltage& m, const messages::MessageRef& from);
  void current(const imc::Current& m, const messages::MessageRef& from);
  void entity_info(const imc::EntityInfo& m) { entities_.note(m); }
  void entity_list(const imc::EntityList& m) { entities_.note(m); }
  void beacons(const imc::LblConfig& m);
  void range(const imc::LblRange& m, const messages::MessageRef& from);
  void servo(const imc::ServoPosition& m, const messages::MessageRef& from);
  void vehicle_state(const imc::VehicleState& m);
  void control_loops(const imc::ControlLoops& m);
  void send_actuation(const tasks::Actuation& actuation, messages::Receiver& system);

  void place(double latitude, double longitude);
  std::pair<double, double> from_origin(double latitude, double longitude) const;
  // of whoever is that instrument; what is not finite is counted
  void note(tasks::Reading tasks::Instruments::*reading, const LauvInstrument& instrument,
            const messages::MessageRef& from, double value);
  void note(tasks::VectorReading tasks::Instruments::*reading, const LauvInstrument& instrument,
            const messages::MessageRef& from, double x, double y, double z);
  bool is(const LauvInstrument& instrument, const messages::MessageRef& from);
  bool all_finite(std::initializer_list<double> values);  // else that is counted

  struct Beacon {
    bool known = false;
    double latitude = 0, longitude = 0, depth = 0;
    void serialize(Archive& archive) { archive(known, latitude, longitude, depth); }
  };

  LauvVehicleParameters parameters_;
  Entities entities_;
  std::array<LeakSensor, 4> leaks_{};
  bool label_lacks_ = false;
  std::optional<Duration> asked_;
  std::uint64_t non_finite_inputs_ = 0;
  std::array<Beacon, 2> beacons_{};
  tasks::Actuation sent_{};
  Duration reached_{};                     // instant
  std::optional<Duration> steers_itself_;  // when it last said so
  std::optional<Duration> met_;            // when an entity of its own was first heard
  bool has_said_ = false;                  // which loops are on
  std::string address_;
  messages::imc::AnnounceTimer announce_timer_;
};

}  // namespace jarol::distributers
