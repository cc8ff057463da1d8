#include "tools/commands/vehicle/serve_in_lockstep.h"

#include <iostream>

#include "distributers/links/lockstep_server.h"
#include "distributers/links/tcp.h"
#include "graph/language/quantities.h"
#include "tools/commands/run/interrupt.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {

void report(const vehicles::Mishap& mishap, const std::string& name) {
  std::cerr << "error: the " << name << " has " << mishap.text << ", at " << seconds_text(mishap.instant) << " s\n";
}

int serve_vehicle_in_lockstep(const vehicles::VehicleClass& vehicle_class, const distributers::Address& listen,
                              const std::function<std::unique_ptr<vehicles::Vehicle>(std::uint64_t seed)>& make,
                              const std::optional<distributers::SecretKey>& key) {
  constexpr int backlog = 16;
  const distributers::Descriptor door = distributers::listen_at(listen, backlog);
  distributers::LockstepService service{
      .set = *vehicle_class.message_set, .name = vehicle_class.name, .make = make, .key = key};
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
