#include "tools/commands/vehicle/serve_vehicle.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "distributers/links/lockstep_server.h"
#include "distributers/links/tcp.h"
#include "distributers/messages/imc_announce.h"
#include "graph/language/quantities.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/real_time.h"
#include "tools/report/exit_code.h"
#include "tools/report/json_line.h"
#include "tools/report/silence_log.h"

namespace jarol::tools {
namespace {

struct ToVehicle : messages::Receiver {
  explicit ToVehicle(vehicles::Vehicle& to) : vehicle(to) {}
  void receive(messages::MessageRef message) override {
    heard = true;
    vehicle.accept(message);
  }
  vehicles::Vehicle& vehicle;
  bool heard = false;  // since it was made false
};

struct ToPeer : messages::Receiver {
  explicit ToPeer(distributers::Link& to) : link(to) {}
  void receive(messages::MessageRef message) override { link.send(message); }
  distributers::Link& link;
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

struct All : messages::Receiver {
  explicit All(messages::Receiver& receiver) : to(receiver) {}
  void receive(messages::MessageRef message) override { to.receive(message); }
  messages::Receiver& to;
};

std::unique_ptr<messages::Receiver> make_telemetry(const vehicles::Vehicle& vehicle,
                                                   const vehicles::VehicleClass& vehicle_class, messages::Receiver& to,
                                                   Telemetry telemetry) {
  if (telemetry == Telemetry::true_state) return std::make_unique<Only>(*vehicle_class.true_state, to);
  if (vehicle_class.make_telemetry != nullptr) return vehicle_class.make_telemetry(vehicle, to);
  return std::make_unique<All>(to);
}

// Announces the vehicle to those who look for systems, as often as DUNE does.
class Announcements {
 public:
  Announcements(const vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, distributers::Link& link)
      : vehicle_(vehicle), make_(link.announces() ? vehicle_class.make_announcement : nullptr), link_(link) {}

  void reach(Duration instant) {
    if (make_ != nullptr && timer_.is_due(instant)) link_.announce(make_(vehicle_, link_.transport().address()));
  }

 private:
  const vehicles::Vehicle& vehicle_;
  decltype(vehicles::VehicleClass::make_announcement) make_;
  distributers::Link& link_;
  messages::imc::AnnounceTimer timer_;
};

void report(const vehicles::Mishap& mishap, const std::string& name) {
  std::cerr << "error: the " << name << " has " << mishap.text << ", at " << seconds_text(mishap.instant) << " s\n";
}

}  // namespace

bool report_mishap(const vehicles::Vehicle& vehicle, const std::string& name) {
  const std::optional<vehicles::Mishap> mishap = vehicle.mishap();
  if (mishap) report(*mishap, name);
  return mishap.has_value();
}

int serve_vehicle(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, distributers::Link& link,
                  std::chrono::nanoseconds end, const ServeOptions& options, const RealTimeOptions& real_time) {
  ToVehicle to_vehicle(vehicle);
  ToPeer to_link(link);
  const auto telemetry = make_telemetry(vehicle, vehicle_class, to_link, options.telemetry);
  messages::Receiver& to_peer = *telemetry;
  SilenceLog silences(vehicle, vehicle_class);
  RealClock clock(0, real_time);
  for (const std::string& refusal : clock.prepare_thread()) std::cerr << "note: " << refusal << "\n";
  let_writing_fail();
  const Interruptible interruptible;
  const std::atomic<bool>& interrupted = Interruptible::interrupted();
  link.connect();
  std::cerr << vehicle_class.name << ": " << link.transport().text() << ", until Ctrl-C\n";
  if (const std::string doubt = link.transport().doubt(); !doubt.empty())
    std::cerr << "note: the " << vehicle_class.name << " " << doubt << "\n";
  int exit_code = exit_good;
  clock.start();
  const Duration grid = vehicle.grid();
  Duration instant{};
  Announcements announcements(vehicle, vehicle_class, link);
  const auto write = [&](Duration at) {
    if (options.motion != nullptr && at % options.period == Duration{}) options.motion->add(at, vehicle);
  };
  announcements.reach(Duration{});
  vehicle.sense(to_peer);
  link.flush();
  write(Duration{});
  try {
    for (; instant < end && !interrupted.load(std::memory_order_relaxed); instant += grid) {
      clock.wait_until(instant + grid, interrupted);
      // commands hold from the instant after they have come
      vehicle.step();
      to_vehicle.heard = false;
      link.receive(to_vehicle);
      silences.note(instant + grid, to_vehicle.heard);
      announcements.reach(instant + grid);
      vehicle.sense(to_peer);
      link.flush();
      write(instant + grid);
    }
  } catch (const vehicles::NoState& error) {
    std::cerr << "error: " << error.what() << "\n";
    exit_code = exit_unfinished;
  }
  link.disconnect();
  const std::optional<vehicles::Mishap> mishap = vehicle.mishap();
  if (options.json) {
    nlohmann::ordered_json json{{"schema", "jarol.vehicle/1"}};
    json.update(silences.to_json());
    json["link"] = to_json(link.report());
    json["mishap"] = mishap ? nlohmann::ordered_json(mishap->text) : nlohmann::ordered_json();
    std::cout << json_line(json);
  } else {
    std::cout << vehicle_class.name << ": " << seconds_text(instant) << " s in real time\n"
              << silences.to_text() << to_text(link.report());
  }
  if (mishap) report(*mishap, vehicle_class.name);
  // a signal is how it ends without --for, and nobody else knows of the mishap
  return exit_of({exit_code, mishap ? int{exit_negative} : exit_of_signal(Interruptible::signal())});
}

int serve_vehicle_in_lockstep(const vehicles::VehicleClass& vehicle_class, const distributers::Address& listen,
                              const std::function<std::unique_ptr<vehicles::Vehicle>(std::uint64_t seed)>& make,
                              const std::optional<distributers::SecretKey>& key) {
  constexpr int backlog = 16;
  const distributers::Descriptor door = distributers::listen_at(listen, backlog);
  distributers::LockstepService service{.set = *vehicle_class.message_set, .make = make, .key = key};
  service.note = [](const std::string& text) { std::cerr << "note: " << text << "\n"; };
  service.mishap = [&](const vehicles::Mishap& mishap, const std::string& runner) {
    report(mishap, vehicle_class.name + " of " + runner);
  };
  distributers::Interrupter interrupter;
  let_writing_fail();
  const Interruptible interruptible([&] { interrupter.interrupt(); });
  std::cerr << vehicle_class.name << ": in lockstep at " << listen.text() << ", until Ctrl-C\n";
  serve_lockstep(door, service, interrupter);
  return exit_of_signal(Interruptible::signal());
}

}  // namespace jarol::tools
