// A simulated vehicle as a process of its own, in real time: messages over a link steer it, its sensors answer.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/link.h"
#include "distributers/serve/silence_log.h"
#include "distributers/session/note_sink.h"
#include "runtime/machine/real_clock.h"

namespace jarol {

/// What a peer is sent: all, or the true state only, where its class has such a message.
enum class Telemetry { all, true_state };

struct ServeOptions {
  Duration end = Duration::max();
  Telemetry telemetry = Telemetry::all;
  RealTimeOptions real_time{};
  std::vector<VehicleSink*> sinks{};               // outlive the call
  const std::atomic<bool>* interrupted = nullptr;  // ends it once it is true; null: nobody does
  NoteSink note = no_notes;
  std::function<void(const distributers::Link&)> on_connected = [](const distributers::Link&) {};
};

struct ServeOutcome {
  Duration simulated{};
  std::string failure{};  // what ended it: the vehicle has no state any more; empty: none
  std::optional<vehicles::Mishap> mishap{};
  vehicles::VehicleState state{};   // at the end
  std::vector<double> actuators{};  // likewise
  SilenceLog silences;
  LinkReport link{};
};

/// Until the end, or an interrupt. Both stay the caller's; the class outlives the outcome. Throws InputError where
/// the link can't be had, Unfinished where it is lost or the vehicle fails.
ServeOutcome serve_vehicle(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class,
                           distributers::Link& link, const ServeOptions& options = {});

}  // namespace jarol
