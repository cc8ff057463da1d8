// An external system that nobody can foretell, for tests.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "graph/registry.h"
#include "graph/values/seed.h"
#include "graph/values/sequence.h"
#include "graph/values/type_of.h"
#include "runtime/external_system.h"
#include "runtime/machine/real_clock.h"

namespace jarol::tests {

/// A graph with Plant, whose values of changing size go through a task.
inline constexpr const char* plant_graph = R"(graph: t
timing: {period: 3ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.sensor, period: 1ms}
  w: {channel: p.window}
  o: {channel: p.actuator, period: 1ms}
  mean: {type: double, direction: out}
tasks: {r: {type: Accumulate, period: 1ms, on_fault: hold}, m: {type: Mean}}
connections: [i -> r.in, r.out -> o, w -> m.in, m.out -> mean]
)";

/// The distributer Plant: a sensor, an actuator, and a window of changing size that comes in.
inline DistributerClass plant() {
  const Type* number = &type_of<double>();
  return {"Plant",
          "for tests",
          {{"sensor", Direction::in, number, ""},
           {"actuator", Direction::out, number, ""},
           {"window", Direction::in, &type_of<Sequence<double>>(), ""}},
          true};
}

// What a plant reports, and whether, depends on the machine's clock; some of it is not finite.
class Outside : public ExternalSystem {
 public:
  void reach(Duration) override {}
  bool take(std::size_t channel, void* value) override {
    const std::uint64_t chance = spread_seed(static_cast<std::uint64_t>(RealClock::monotonic().count()), "outside");
    if (chance % 3 == 0) return false;
    if (channel == 0) {
      *static_cast<double*>(value) =
          chance % 7 == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(chance % 1000);
    } else {
      auto& window = *static_cast<Sequence<double>*>(value);
      window.clear();
      for (std::uint64_t i = 0; i < chance % 5; ++i) window.push_back(static_cast<double>(chance % 100 + i));
    }
    return true;
  }
  void hand_over(std::size_t, const void*) override {}
};

inline std::vector<std::unique_ptr<ExternalSystem>> outside() {
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<Outside>());
  return systems;
}

}  // namespace jarol::tests
