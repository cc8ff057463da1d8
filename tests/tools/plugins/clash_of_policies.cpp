// A plugin whose policy has the name of one that there is.
#include "graph/plugins/plugin_policy.h"

namespace {
struct Edf {
  static constexpr std::string_view name = "edf", how = "not the one that you know";
  static constexpr jarol::Urgency urgency = jarol::Urgency::deadline;
  static constexpr bool interrupts = true, keeps_core = false;
  static jarol::analysis::Result check(const jarol::analysis::System&, bool, jarol::analysis::Budget&) { return {}; }
};
}  // namespace

JAROL_PLUGIN(Edf)
