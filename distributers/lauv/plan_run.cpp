#include "distributers/lauv/plan_run.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace {

using tasks::Course;

bool same_path(const tasks::Leg& a, const tasks::Leg& b) {
  return a.course == b.course && a.north == b.north && a.east == b.east && a.radius == b.radius;
}

double bearing(double x, double y, const tasks::Leg& to) { return std::atan2(to.east - y, to.north - x); }

}  // namespace

void PlanRun::start(Plan plan, const tasks::Motion& motion, Duration now) {
  plan_ = std::move(plan);
  runs_ = true;
  flown_ = 0;
  outcome_ = Outcome::none;
  why_.clear();
  begin_maneuver(plan_.start, motion, now);
}

void PlanRun::stop(std::string why) {
  if (runs_) end(Outcome::failure, std::move(why));
}

void PlanRun::end(Outcome outcome, std::string why) {
  runs_ = false;
  leg_ = {};
  left_ = -1;
  outcome_ = outcome;
  why_ = std::move(why);
}

void PlanRun::begin_maneuver(std::size_t which, const tasks::Motion& motion, Duration now) {
  at_ = which;
  leg_at_ = 0;
  maneuver_start_ = now;
  follower_.reset();
  if (maneuver().type == messages::imc::FollowReference::message_id) follower_.emplace(maneuver(), now, plan_.limits);
  if (!maneuver().legs.empty()) return begin_leg(motion);
  begin_leg(follower_ ? follower_->leg() : tasks::Leg{});
}

void PlanRun::begin_leg(const tasks::Leg& leg) {
  leg_ = leg;
  leg_.number = ++number_;
  left_ = -1;  // until the vehicle reports of this one
  headway_ = {};
}

void PlanRun::begin_leg(const tasks::Motion& motion) {
  const tasks::Leg before = leg_;
  const PlannedLeg& planned = maneuver().legs[leg_at_];
  begin_leg(planned.leg);
  if (planned.here) {
    leg_.north = motion.x;
    leg_.east = motion.y;
  }
  const PlannedLeg* const next = find_next_leg();
  if (leg_.course != Course::line || next == nullptr || next->leg.course != Course::line || next->here) return;
  const bool joins = before.course == Course::line;
  const double course = joins ? bearing(before.north, before.east, leg_) : bearing(motion.x, motion.y, leg_);
  leg_.turn = wrapped(bearing(leg_.north, leg_.east, next->leg) - course);
}

const PlannedLeg* PlanRun::find_next_leg() const {
  if (leg_at_ + 1 < maneuver().legs.size()) return &maneuver().legs[leg_at_ + 1];
  const auto next = plan_.next[at_];
  return next && !plan_.maneuvers[*next].legs.empty() ? &plan_.maneuvers[*next].legs.front() : nullptr;
}

bool PlanRun::finish_maneuver(const tasks::Motion& motion, Duration now) {
  if (!runs_) return false;
  next_maneuver(motion, now);
  return true;
}

void PlanRun::next_maneuver(const tasks::Motion& motion, Duration now) {
  ++flown_;
  if (const auto next = plan_.next[at_])
    begin_maneuver(*next, motion, now);
  else
    end(Outcome::success, "");
}

bool PlanRun::note(const tasks::Progress& progress, const tasks::Motion& motion, Duration now) {
  if (!runs_ || progress.on_leg != leg_.number) return false;
  left_ = progress.left;
  if (follower_) {
    if (!follower_->note(progress)) return false;
    begin_leg(follower_->leg());
    return true;
  }
  if (!progress.done) {
    const std::string lost = headway_.note(limits_, leg_, progress, motion, now);
    if (lost.empty()) return false;
    end(Outcome::failure, fmt::format("maneuver '{}': {}", maneuver().name, lost));
    return true;
  }
  if (++leg_at_ < maneuver().legs.size())
    begin_leg(motion);
  else
    next_maneuver(motion, now);
  return true;
}

bool PlanRun::pass(Duration now) {
  if (!runs_) return false;
  if (follower_) {
    if (!follower_->is_late(now)) return false;
    end(Outcome::failure, fmt::format("maneuver '{}': no reference for {:.6g} s", maneuver().name, maneuver().timeout));
    return true;
  }
  if (maneuver().timeout <= 0 || seconds(now - maneuver_start_) <= maneuver().timeout) return false;
  end(Outcome::failure, fmt::format("maneuver '{}' took longer than {:.6g} s", maneuver().name, maneuver().timeout));
  return true;
}

bool PlanRun::follow(const messages::imc::Reference& reference, std::uint16_t source, std::uint8_t entity, Duration now,
                     const Origin& origin, const tasks::Motion& motion) {
  if (!runs_ || !follower_ || !follower_->take(reference, source, entity, now, origin, motion)) return false;
  if (follower_->is_done()) return finish_maneuver(motion, now);
  if (!same_path(leg_, follower_->leg())) {
    begin_leg(follower_->leg());
    return true;
  }
  leg_ = follower_->leg();
  leg_.number = number_;
  return true;
}

double PlanRun::calc_left(bool of_plan) const {
  if (left_ < 0) return -1;
  double left = left_;
  double x = leg_.north, y = leg_.east;
  const auto add = [&](const PlannedLeg& planned) {
    const tasks::Leg& leg = planned.leg;
    if (leg.course == Course::line) {
      if (!(leg.surge > 0)) return false;
      left += std::hypot(leg.north - x, leg.east - y) / leg.surge;
      x = leg.north;
      y = leg.east;
      return true;
    }
    left += leg.duration;
    return leg.duration > 0 || leg.until_level;
  };
  std::size_t leg_at = leg_at_ + 1, steps = 0;
  for (std::size_t at = at_; steps <= plan_.maneuvers.size(); ++steps, leg_at = 0) {
    const std::vector<PlannedLeg>& legs = plan_.maneuvers[at].legs;
    if (legs.empty()) return of_plan ? -1 : left;
    for (; leg_at < legs.size(); ++leg_at)
      if (!add(legs[leg_at])) return -1;
    if (!of_plan || !plan_.next[at]) return left;
    at = *plan_.next[at];
  }
  return -1;  // it goes round and round
}

double PlanRun::share_done() const {
  if (!runs_) return outcome_ == Outcome::success ? 1 : 0;
  const auto legs = static_cast<double>(std::max<std::size_t>(maneuver().legs.size(), 1));
  return std::min(
      (static_cast<double>(flown_) + static_cast<double>(leg_at_) / legs) / static_cast<double>(plan_.maneuvers.size()),
      1.0);
}

}  // namespace jarol::distributers
