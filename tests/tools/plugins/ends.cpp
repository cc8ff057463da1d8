// Tasks that go wrong at a given activation.
#include <stdexcept>

#include "graph/plugins/plugin.h"

namespace {
using namespace jarol;

struct Param {
  int at = 10;
  int loops = 0;
  static constexpr auto fields() {
    return describe(field<&Param::at>("", "activation that goes wrong"),
                    field<&Param::loops>("", "how much each activation works"));
  }
};

struct Throws {
  static constexpr std::string_view summary = "throws";
  using Param = ::Param;
  static void run(const Param& p, const Tick& tick) {
    if (tick.activation == p.at) throw std::runtime_error("as it was commanded");
  }
};

struct Hangs {
  static constexpr std::string_view summary = "never ends";
  using Param = ::Param;
  static void run(const Param& p, const Tick& tick) {
    for (volatile int i = 0; i < p.loops;) i = i + 1;
    for (volatile bool goes_on = tick.activation == p.at; goes_on;) {}
  }
};
}  // namespace

JAROL_PLUGIN(Throws, Hangs)
