// Drives to a point: turns towards it, slows down before it, and stops there.
#pragma once

#include <jarol/task.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "distributer/values.h"

struct DriveTo {
  static constexpr std::string_view summary = "drives to a point and stops there";
  struct Param {
    double north = 8;
    double east = 6;
    double approach = 0.8;
    double steer = 1.5;
    double near = 0.1;
    static constexpr auto fields() {
      using jarol::field;
      using P = Param;
      return jarol::describe(field<&P::north>("m", "of the start"), field<&P::east>("m", "of the start"),
                             field<&P::approach>("1/s", "speed by distance"), field<&P::steer>("1/s", "turn by angle"),
                             field<&P::near>("m", "this close is there"));
    }
  };
  struct In {
    Pose pose;
    static constexpr auto fields() { return jarol::describe(jarol::field<&In::pose>("", "where it is")); }
  };
  struct Out {
    Drive drive;
    static constexpr auto fields() { return jarol::describe(jarol::field<&Out::drive>()); }
  };
  static void run(const Param& p, const jarol::Tick&, const In& in, Out& out) {
    const double north = p.north - in.pose.x, east = p.east - in.pose.y;
    const double distance = std::hypot(north, east);
    if (distance < p.near) {
      out.drive = {};
      return;
    }
    const double angle = std::remainder(std::atan2(east, north) - in.pose.heading, 2 * M_PI);
    // no way towards what lies beside or behind
    out.drive.speed = std::clamp(p.approach * distance, 0.0, 1.0) * std::max(0.0, std::cos(angle));
    out.drive.turn = std::clamp(p.steer * angle, -2.0, 2.0);
  }
};
