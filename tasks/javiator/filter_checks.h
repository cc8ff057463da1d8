// What the helicopter's sensors say of each other: which of them can't be believed.
#pragma once

#include "tasks/javiator/filter.h"

namespace jarol::tasks {

/// A sonar that drifts reports a climb that is not felt.
void compare_climb(JaviatorFilter::State& state, const JaviatorFilter::Param& p, double dt);

/// In flight it may be as noisy as on the ground.
double credible_step(const JaviatorFilter::State& state, const JaviatorFilter::Param& p);

/// Without a sonar the pressure has to do; with one, each shows whether the other can be believed, and what is felt
/// which of the two.
void weigh_pressure(JaviatorFilter::State& state, const JaviatorFilter::Param& p, double pressure);

/// Wrong angles turn gravity sideways, which the observers of the place take for a bias.
void compare_pull(JaviatorFilter::State& state, const JaviatorFilter::Param& p, double dt);

/// Angles that drift against the rates are not believed.
void watch_drift(JaviatorFilter::State& state, const JaviatorFilter::Param& p, const JaviatorSensors& s, double dt);

/// While the ground carries it. Angles that disagree with the weight that it feels are not believed: it does not fly
/// with them.
bool feels_level(JaviatorFilter::State& state, const JaviatorFilter::Param& p, const JaviatorSensors& s);

}  // namespace jarol::tasks
