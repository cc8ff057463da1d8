// The other end of the lockstep link: what a vehicle's process does with those who run graphs with it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/frames.h"

namespace jarol::distributers {

struct LockstepService {
  const messages::MessageSet& set;
  std::string name;  // of the vehicle's class
  /// A vehicle at its start, with that seed.
  std::function<std::unique_ptr<vehicles::Vehicle>(std::uint64_t seed)> make;
  std::optional<SecretKey> key{};
  /// With the whole of a frame, and with a silence where another waits.
  std::chrono::milliseconds patience = FrameStream::usual_patience;
  /// What people should know that is no error.
  std::function<void(const std::string&)> note = [](const std::string&) {};
  /// At the end with a runner: what has become of its vehicle that no mission wants.
  std::function<void(const vehicles::Mishap&, const std::string& runner)> mishap = [](const vehicles::Mishap&,
                                                                                      const std::string&) {};
};

/// Serves who comes to the `door`, one after the other, until it is interrupted: the vehicle is with the first who
/// speaks, and who comes meanwhile is turned away, unless that one has been silent for too long. What the vehicle
/// throws but NoState ends that: its runner reads why, and Unfinished is thrown.
void serve_lockstep(const Descriptor& door, const LockstepService& service, const Interrupter& interrupter);

/// Serves one who has come, alone, until it is interrupted. Throws FrameEnd when that one has gone, or another
/// FrameError.
void serve_runner(FrameStream stream, const LockstepService& service, const Interrupter& interrupter);

}  // namespace jarol::distributers
