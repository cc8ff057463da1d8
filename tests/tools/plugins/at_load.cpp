// A plugin that does something when it is loaded, or when its program ends; AT_LOAD says what.
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "graph/plugins/plugin.h"

namespace {
struct Nothing {
  static constexpr std::string_view summary = "does nothing";
  static void run([[maybe_unused]] const jarol::Tick& tick) {
#if AT_LOAD == 7
    throw std::runtime_error("no");
#endif
  }
};

const struct AtLoad {
  AtLoad() {
#if AT_LOAD == 1
    throw std::runtime_error("no licence");
#elif AT_LOAD == 2
    for (volatile bool goes_on = true; goes_on;) {}
#elif AT_LOAD == 3
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
#elif AT_LOAD == 4
    std::_Exit(0);
#elif AT_LOAD == 5
    jarol::set_floating_point_control({0x9fc0, 0x33f});
#elif AT_LOAD == 6
    static_cast<void>(::fork());
#endif
  }
  ~AtLoad() {
#if AT_LOAD == 7
    ::_exit(0);
#elif AT_LOAD == 8
    for (volatile bool goes_on = true; goes_on;) {}
#elif AT_LOAD == 9
    std::abort();
#endif
  }
} at_load;
}  // namespace

JAROL_PLUGIN(Nothing)
