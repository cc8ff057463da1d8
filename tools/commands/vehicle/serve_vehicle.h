// A simulated vehicle as a process of its own, in real time: messages over a link steer it, its sensors answer.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/address.h"
#include "distributers/links/link.h"
#include "distributers/links/secret_key.h"
#include "runtime/machine/real_clock.h"
#include "tools/commands/vehicle/motion_file.h"

namespace jarol::tools {

/// What a peer is sent: all, or the true state only, where its class has such a message.
enum class Telemetry { all, true_state };

struct ServeOptions {
  Telemetry telemetry = Telemetry::all;
  bool json = false;             // at the end, instead of text
  MotionFile* motion = nullptr;  // gets a row each `period`, a multiple of the vehicle's grid; null: nothing is written
  std::chrono::nanoseconds period{};
};

/// A line on stderr if something has become of the vehicle that no mission wants; false: nothing has.
bool report_mishap(const vehicles::Vehicle& vehicle, const std::string& name);

/// Runs until `end` or Ctrl-C and reports what it did and what was carried; the exit code. The motion's file is left to
/// be committed.
int serve_vehicle(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, distributers::Link& link,
                  std::chrono::nanoseconds end, const ServeOptions& options = {},
                  const RealTimeOptions& real_time = {});

/// On the logical clocks of those who connect, one after the other, each with a vehicle of its own from the start;
/// until Ctrl-C. Throws InputError if it can't listen there.
int serve_vehicle_in_lockstep(const vehicles::VehicleClass& vehicle_class, const distributers::Address& listen,
                              const std::function<std::unique_ptr<vehicles::Vehicle>(std::uint64_t seed)>& make,
                              const std::optional<distributers::SecretKey>& key = {});

}  // namespace jarol::tools
