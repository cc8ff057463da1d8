#include "tasks/javiator/approach.h"

#include "graph/math/geometry.h"

namespace jarol::tasks {

void approach(Approach& a, double goal, const ApproachLimits& p, double dt) {
  const double speed = limited(0.5 * p.bandwidth * (goal - a.place), p.speed);
  const double wanted = limited(2 * p.bandwidth * (speed - a.speed), p.acceleration);
  a.demand += limited(wanted - a.demand, p.jerk * dt);
  a.felt += (a.demand - a.felt) * dt / (p.lag + dt);
  a.place += a.speed * dt + 0.5 * a.felt * dt * dt;
  a.speed += a.felt * dt;
}

}  // namespace jarol::tasks
