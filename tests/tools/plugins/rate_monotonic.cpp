#include "graph/plugins/plugin_policy.h"

namespace {
using namespace jarol::analysis;

struct RateMonotonic {
  static constexpr std::string_view name = "rate_monotonic";
  static constexpr std::string_view how = "the task with the shortest period runs, interrupting others";
  static constexpr jarol::Urgency urgency = jarol::Urgency::priority;
  static constexpr bool interrupts = true;

  static bool is_simple(const System& system) {
    if (system.cores > 1 || !system.follows.empty()) return false;
    for (const TaskModel& m : system.models)
      if (m.deadline < m.period || m.jitter.count() > 0 || m.blocking.count() > 0) return false;
    return true;
  }

  // what holds is the product of all 1 + utilisation, which is 2 at most (Bini, Buttazzo 2003)
  static Result check(const System& system, bool, Budget&) {
    const auto against_all = compare_utilisation(system.models, system.cores);
    double product = 1;
    for (const TaskModel& m : system.models)
      product *= 1 + static_cast<double>(m.wcet.count()) / static_cast<double>(m.period.count());
    Result result;
    if (against_all && *against_all > 0) {
      result.verdict = Verdict::not_schedulable;
      result.evidence = Evidence::proof;
      result.reason = "the tasks need more than all cores";
    } else if (!is_simple(system)) {
      result.reason = "the hyperbolic bound is for tasks on one core that neither follow others nor wait";
    } else if (product < 2 - 1e-9) {
      result.verdict = Verdict::schedulable;
      result.evidence = Evidence::safe;
      result.reason = "the hyperbolic bound holds (Bini, Buttazzo)";
    } else {
      result.reason = "the hyperbolic bound is sufficient only, and does not hold";
    }
    return result;
  }
};
}  // namespace

JAROL_PLUGIN(RateMonotonic)
