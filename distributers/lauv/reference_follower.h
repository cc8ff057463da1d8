// The maneuver FollowReference: a system sends where to go, again and again.
#pragma once

#include <cstdint>

#include "distributers/lauv/maneuvers.h"
#include "distributers/messages/imc.h"
#include "graph/language/quantities.h"
#include "tasks/values/guidance.h"

namespace jarol::distributers {

/// Throws InputError where its z can't be read.
bool needs_altitude(const messages::imc::Reference& reference);

class ReferenceFollower {
 public:
  ReferenceFollower(const Maneuver& maneuver, Duration now, const FlightLimits& limits = {});

  /// Is it steered by that system and entity?
  bool obeys(std::uint16_t source, std::uint8_t entity) const;
  /// Takes a reference; what it leaves out is as before, and the place at first that of the vehicle. At speed 0 the
  /// propeller is off. False: who sent it may not. Throws InputError for what can't be commanded, and
  /// nothing of it counts.
  bool take(const messages::imc::Reference& reference, std::uint16_t source, std::uint8_t entity, Duration now,
            const Origin& origin, const tasks::Motion& motion);
  /// The vehicle is there: it circles or keeps its station from now on. True: the leg is another one.
  bool note(const tasks::Progress& progress);
  bool is_late(Duration now) const;
  bool is_done() const { return done_; }

  const tasks::Leg& leg() const { return leg_; }
  messages::imc::FollowRefState state() const;

 private:
  std::uint16_t source_;
  std::uint8_t entity_;
  double timeout_, radius_;
  FlightLimits limits_;
  Duration heard_;
  bool heard_any_ = false, done_ = false;
  messages::imc::Reference reference_;
  tasks::Leg leg_;
  tasks::Progress progress_;
};

}  // namespace jarol::distributers
