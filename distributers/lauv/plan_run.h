// A plan that is flown: which maneuver and leg, since when, how it ended.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "distributers/lauv/headway.h"
#include "distributers/lauv/plan.h"
#include "distributers/lauv/reference_follower.h"
#include "graph/language/quantities.h"
#include "tasks/values/guidance.h"

namespace jarol::distributers {

/// The legs of a plan one by one, each with a number of its own. What the vehicle says of a leg that is no more counts
/// nothing.
class PlanRun {
 public:
  enum class Outcome : std::uint8_t { none, success, failure };

  explicit PlanRun(const HeadwayLimits& limits) : limits_(limits) {}

  void start(Plan plan, const tasks::Motion& motion, Duration now);
  /// Ends it before it is done.
  void stop(std::string why);
  bool runs() const { return runs_; }

  /// What the vehicle is to follow; without a course while a maneuver has no leg.
  const tasks::Leg& leg() const { return leg_; }
  /// How far it is on the leg. True: there is another leg, or the plan is over; one without headway has failed.
  bool note(const tasks::Progress& progress, const tasks::Motion& motion, Duration now);
  /// Time passes. True as above.
  bool pass(Duration now);
  /// A reference; true as above, or the same leg has other levels and speeds. Throws InputError for what
  /// can't be commanded.
  bool follow(const messages::imc::Reference& reference, std::uint16_t source, std::uint8_t entity, Duration now,
              const Origin& origin, const tasks::Motion& motion);
  /// The maneuver that runs is over, as who steers says. True as above.
  bool finish_maneuver(const tasks::Motion& motion, Duration now);

  const std::string& name() const { return plan_.name; }
  /// That runs, or ran last.
  const Maneuver& maneuver() const { return plan_.maneuvers[at_]; }
  bool has_maneuver() const { return at_ < plan_.maneuvers.size(); }
  Duration maneuver_start() const { return maneuver_start_; }
  /// s; negative: without end, or not known
  double time_left() const { return calc_left(true); }
  double maneuver_left() const { return calc_left(false); }
  /// 0 to 1, of maneuvers and legs; negative: not known
  double share_done() const;
  Outcome outcome() const { return outcome_; }
  const std::string& why() const { return why_; }
  /// Of a maneuver that follows references, or null.
  const ReferenceFollower* follower() const { return follower_ ? &*follower_ : nullptr; }

 private:
  void begin_maneuver(std::size_t which, const tasks::Motion& motion, Duration now);
  void begin_leg(const tasks::Motion& motion);
  void begin_leg(const tasks::Leg& leg);
  void next_maneuver(const tasks::Motion& motion, Duration now);
  void end(Outcome outcome, std::string why);
  const PlannedLeg* find_next_leg() const;
  double calc_left(bool of_plan) const;

  HeadwayLimits limits_;
  Plan plan_;
  bool runs_ = false;
  std::size_t at_ = 0, leg_at_ = 0, flown_ = 0;  // flown_: maneuvers
  tasks::Leg leg_;
  std::uint32_t number_ = 0;
  Duration maneuver_start_{};
  double left_ = -1;  // s, of the leg
  Headway headway_;   // on the leg
  std::optional<ReferenceFollower> follower_;
  Outcome outcome_ = Outcome::none;
  std::string why_;
};

}  // namespace jarol::distributers
