// Flies a graph of the helicopter and looks at what truly happens, not at what its sensors report.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/execute/executor.h"
#include "tasks/values/javiator.h"
#include "tasks/values/robostix.h"
#include "vehicles/helicopter/body.h"

namespace jarol::tests {

/// The vehicle at one step of its grid. Angles are Euler's ZYX.
struct Glimpse {
  double time = 0;
  double x = 0, y = 0, altitude = 0;
  double roll = 0, pitch = 0, yaw = 0;
  double climb = 0;
  double touch_down = 0;  // m/s, the greatest speed down of its middle as a part met the ground so far
  double impact = 0;      // m/s, the greatest speed down at which a part has met the ground so far
};

struct Flight {
  std::vector<Glimpse> path;
  std::vector<std::pair<double, tasks::FlightDirective>> directives;
  std::vector<std::pair<double, tasks::FlightEstimate>> estimates;  // what its own filter takes for true
  std::vector<std::pair<double, tasks::MotorCommand>> motors;
  Report report;

  /// The greatest |value - of| within [from, to].
  double furthest(double Glimpse::*value, double of, double from, double to) const;
  double max(double Glimpse::*value, double from, double to) const;
  double min(double Glimpse::*value, double from, double to) const;
  /// The last instant at which |value - of| exceeds the band.
  double settled(double Glimpse::*value, double of, double band) const;
  Glimpse at(double time) const;
  /// As its judge sees them in the whole flight: how fast its middle came down as a part of it met the ground, and how
  /// fast the part did that came down fastest.
  double touch_down() const { return path.back().touch_down; }
  double impact() const { return path.back().impact; }
  tasks::FlightDirective last() const { return directives.back().second; }
};

struct FlightPlan {
  std::string graph = "specs/javiator.yaml";
  std::vector<std::string> set{};
  std::string profile{};
  /// What the operator wants at that second; without one, the graph's own script.
  std::function<tasks::PilotCommand(double)> pilot{};
  double seconds = 20;
  std::uint64_t seed = 0;
  /// From when on, and for how long, no task of its controller runs; s.
  double still_at = 0, still_for = 0;
};

Flight fly(const FlightPlan& plan);

/// An operator who holds a place, takes off at 1 s and wants an altitude of 1 m.
tasks::PilotCommand hover_command(double time);

}  // namespace jarol::tests
