// A task that never ends.
#include "graph/plugins/plugin.h"

namespace {
struct Endless {
  static constexpr std::string_view summary = "never ends";
  static void run(const jarol::Tick&) {
    for (volatile bool goes_on = true; goes_on;) {}
  }
};
}  // namespace

JAROL_PLUGIN(Endless)
