#include "tools/serve_vehicle.h"

#include <iostream>

#include "graph/yaml/quantities.h"
#include "runtime/real_clock.h"
#include "tools/commands/commands.h"
#include "tools/interrupt.h"
#include "tools/real_time.h"

namespace jarol::tools {
namespace {

struct ToVehicle : messages::Receiver {
  explicit ToVehicle(vehicles::Vehicle& to) : vehicle(to) {}
  void receive(messages::MessageRef message) override { vehicle.accept(message); }
  vehicles::Vehicle& vehicle;
};

struct ToPeer : messages::Receiver {
  explicit ToPeer(distributers::Link& to) : link(to) {}
  void receive(messages::MessageRef message) override { link.send(message); }
  distributers::Link& link;
};

}  // namespace

int serve_vehicle(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, distributers::Link& link,
                  std::chrono::nanoseconds end) {
  ToVehicle to_vehicle(vehicle);
  ToPeer to_peer(link);
  RealClock clock(0);
  clock.prepare_thread();
  const Interruptible interruptible;
  const std::atomic<bool>& interrupted = Interruptible::interrupted();
  link.connect();
  std::cerr << vehicle_class.name << ": " << link.transport().text() << ", until Ctrl-C\n";
  int exit_code = exit_good;
  clock.start();
  const std::int64_t grid = vehicle.grid().count();
  std::int64_t instant = 0;
  vehicle.sense(to_peer);
  link.flush();
  try {
    for (; instant < end.count() && !interrupted.load(std::memory_order_relaxed); instant += grid) {
      clock.wait_until(instant + grid, interrupted);
      // commands hold from the instant after they have come
      vehicle.step();
      link.receive(to_vehicle);
      vehicle.sense(to_peer);
      link.flush();
    }
  } catch (const vehicles::NoState& error) {
    std::cerr << "error: " << error.what() << "\n";
    exit_code = exit_unfinished;
  }
  link.disconnect();
  std::cout << vehicle_class.name << ": " << seconds_text(Duration(instant)) << " s in real time\n"
            << to_text(link.report());
  return exit_code == exit_good && interrupted ? exit_interrupted : exit_code;
}

}  // namespace jarol::tools
