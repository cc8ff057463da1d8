// What a session computes with, whatever its program does.
#include <doctest/doctest.h>

#include <cfenv>

#include "distributers/session/session.h"
#include "graph/analysis/policies.h"
#include "graph/floating_point.h"
#include "tasks/tasks.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Angle {
  static constexpr std::string_view summary = "adds an angle to what it has";
  struct Param {
    double angle = 0;
    static constexpr auto fields() { return describe(field<&Param::angle>("rad")); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("rad")); }
  };
  static void run(const Param& p, const Tick&, Out& out) { out.out += p.angle; }
};

const distributers::Registries& known_with_angle() {
  static const distributers::Registries all = [] {
    distributers::Registries made;
    analysis::add_policies(made.graph);
    made.graph.add(task_class<Angle>());
    return made;
  }();
  return all;
}

struct Came {
  std::uint64_t digest = 0;
  std::vector<double> reached{};
  friend bool operator==(const Came&, const Came&) = default;
};

// Of a program whose thread rounds so all the time.
Came came_with(int rounding) {
  const DefaultFloatingPoint afterwards;
  std::fesetround(rounding);
  const std::string text = R"(
graph: t
timing: {period: 10ms}
tasks: {a: {type: Angle, wcet: 1us, parameters: {angle: 0.7 deg}}}
expect: [mean(a.out) < 9, rms(a.out) < 9, final(a.out) < 9 deg]
)";
  Session session(known_with_angle(), std::make_shared<const Source>(Source{"t.yaml", text}), {});
  session.run_until(1s);
  session.restore(session.checkpoint());
  session.run_until(3s);
  Came came{session.report().digest};
  for (const Verdict& verdict : session.finish().expectations) came.reached.push_back(verdict.reached.value());
  CHECK(std::fegetround() == rounding);
  return came;
}
}  // namespace

TEST_SUITE("distributers/session/arithmetic") {
  TEST_CASE("a session comes to the same whatever way its program rounds, and leaves that as it was") {
    const Came to_nearest = came_with(FE_TONEAREST);
    for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) CHECK(came_with(rounding) == to_nearest);
  }
}
