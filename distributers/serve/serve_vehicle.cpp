#include "distributers/serve/serve_vehicle.h"

#include "distributers/messages/imc_announce.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

using distributers::Link;

// What a plugin's vehicle throws is not this program's; what a sink throws stays as it is.
template <class Work>
void with_vehicle(const vehicles::VehicleClass& vehicle_class, const Work& work) {
  try {
    work();
  } catch (...) { rethrow_as_unfinished("vehicle '" + vehicle_class.name + "'"); }
}

struct ToVehicle : messages::Receiver {
  ToVehicle(vehicles::Vehicle& to, const vehicles::VehicleClass& of) : vehicle(to), vehicle_class(of) {}
  void receive(messages::MessageRef message) override {
    heard = true;
    with_vehicle(vehicle_class, [&] { vehicle.accept(message); });
  }
  vehicles::Vehicle& vehicle;
  const vehicles::VehicleClass& vehicle_class;
  bool heard = false;  // since it was made false
};

struct ToPeer : messages::Receiver {
  explicit ToPeer(Link& to) : link(to) {}
  void receive(messages::MessageRef message) override { link.send(message); }
  Link& link;
};

// Passes on messages of one kind only.
struct Only : messages::Receiver {
  Only(const messages::MessageDescriptor& one, messages::Receiver& receiver) : descriptor(one), to(receiver) {}
  void receive(messages::MessageRef message) override {
    if (message.descriptor == &descriptor) to.receive(message);
  }
  const messages::MessageDescriptor& descriptor;
  messages::Receiver& to;
};

// Null: the peer is sent what the vehicle reports as it is.
std::unique_ptr<messages::Receiver> make_telemetry(const vehicles::Vehicle& vehicle,
                                                   const vehicles::VehicleClass& vehicle_class, messages::Receiver& to,
                                                   Telemetry telemetry) {
  if (telemetry == Telemetry::true_state) return std::make_unique<Only>(*vehicle_class.true_state, to);
  return vehicle_class.make_telemetry != nullptr ? vehicle_class.make_telemetry(vehicle, to) : nullptr;
}

// Announces the vehicle to those who look for systems, as often as DUNE does.
class Announcements {
 public:
  Announcements(const vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, Link& link)
      : vehicle_(vehicle), make_(link.announces() ? vehicle_class.make_announcement : nullptr), link_(link) {}

  void reach(Duration instant) {
    if (make_ != nullptr && timer_.is_due(instant)) link_.announce(make_(vehicle_, link_.transport().address()));
  }

 private:
  const vehicles::Vehicle& vehicle_;
  decltype(vehicles::VehicleClass::make_announcement) make_;
  Link& link_;
  messages::imc::AnnounceTimer timer_;
};

}  // namespace

ServeOutcome serve_vehicle(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, Link& link,
                           const ServeOptions& options) {
  static const std::atomic<bool> never{false};
  const std::atomic<bool>& interrupted = options.interrupted != nullptr ? *options.interrupted : never;
  ServeOutcome outcome{.silences = SilenceLog(vehicle_class)};
  ToVehicle to_vehicle(vehicle, vehicle_class);
  ToPeer to_link(link);
  const auto telemetry = make_telemetry(vehicle, vehicle_class, to_link, options.telemetry);
  messages::Receiver& to_peer = telemetry ? *telemetry : to_link;
  RealClock clock(0, options.real_time);
  for (const std::string& refusal : clock.prepare_thread()) options.note(refusal);
  link.connect();
  options.on_connected(link);
  if (const std::string doubt = link.transport().doubt(); !doubt.empty())
    options.note("the " + vehicle_class.name + " " + doubt);
  clock.start();
  const Duration grid = vehicle.grid();
  Announcements announcements(vehicle, vehicle_class, link);
  const auto answer = [&](Duration at) {
    announcements.reach(at);
    with_vehicle(vehicle_class, [&] { vehicle.sense(to_peer); });
    link.flush();
    const VehicleMoment moment{at, to_vehicle.heard, vehicle};
    outcome.silences.add(moment);
    for (VehicleSink* const sink : options.sinks) sink->add(moment);
  };
  answer(Duration{});
  try {
    for (Duration& instant = outcome.simulated; instant < options.end && !interrupted.load(std::memory_order_relaxed);
         instant += grid) {
      clock.wait_until(instant + grid, interrupted);
      // commands hold from the instant after they have come
      with_vehicle(vehicle_class, [&] { vehicle.step(); });
      to_vehicle.heard = false;
      link.receive(to_vehicle);
      answer(instant + grid);
    }
  } catch (const vehicles::NoState& error) { outcome.failure = error.what(); }
  link.disconnect();
  with_vehicle(vehicle_class, [&] { outcome.mishap = vehicle.mishap(); });
  outcome.state = vehicle.state();
  outcome.actuators = actuators_of(vehicle, vehicle_class);
  outcome.link = link.report();
  return outcome;
}

}  // namespace jarol
