// Fills a tank to a level and keeps it there.
#pragma once

#include <jarol/task.h>

#include <algorithm>
#include <string_view>

struct HoldLevel {
  static constexpr std::string_view summary = "fills a tank to a level, and keeps it there";
  struct Param {
    double goal = 3;
    double gain = 0.1;
    double max = 0.05;
    static constexpr auto fields() {
      using jarol::field;
      return jarol::describe(field<&Param::goal>("m", "the level"),
                             field<&Param::gain>("", "inflow per metre below the goal"),
                             field<&Param::max>("m", "inflow of an activation, at most"));
    }
  };
  struct In {
    double level = 0;
    static constexpr auto fields() { return jarol::describe(jarol::field<&In::level>("m", "as it is now")); }
  };
  struct Out {
    double inflow = 0;
    static constexpr auto fields() { return jarol::describe(jarol::field<&Out::inflow>("m", "below zero: outflow")); }
  };
  static void run(const Param& p, const jarol::Tick&, const In& in, Out& out) {
    out.inflow = std::clamp(p.gain * (p.goal - in.level), -p.max, p.max);
  }
};
