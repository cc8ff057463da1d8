// Tasks that steer a vehicle, until they end the whole process: each in a way of its own.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "graph/plugins/plugin.h"
#include "tasks/values/javiator.h"
#include "tasks/values/lauv.h"

namespace {
using namespace jarol;

enum class Way : std::uint8_t {
  none,
  exit,
  quick_exit,
  underscore_exit,
  abort,
  segmentation,
  overflow,
  terminate,
  divide,
  bytes,
  thread_exit
};

constexpr auto enumerators(Way) {
  return std::array<Enumerator<Way>, 11>{{{"none", Way::none},
                                          {"exit", Way::exit},
                                          {"quick_exit", Way::quick_exit},
                                          {"underscore_exit", Way::underscore_exit},
                                          {"abort", Way::abort},
                                          {"segmentation", Way::segmentation},
                                          {"overflow", Way::overflow},
                                          {"terminate", Way::terminate},
                                          {"divide", Way::divide},
                                          {"bytes", Way::bytes},
                                          {"thread_exit", Way::thread_exit}}};
}

volatile int zero = 0;
int* volatile nowhere = nullptr;

// the compilers don't see that it never ends
int dive_deeper(volatile int* above);
int (*volatile go_on)(volatile int*) = dive_deeper;

int dive_deeper(volatile int* above) {
  volatile int room[64] = {*above + 1};
  return go_on(room) + room[0];
}

[[noreturn]] void refuse() { throw std::runtime_error("nobody may see this"); }
void (*volatile refuses)() = refuse;
void throw_without_leave() noexcept { refuses(); }

// as it is without a sanitizer, which would say it in its own way
__attribute__((no_sanitize("undefined"))) __attribute__((no_sanitize("address"))) void end_by(Way way) {
  switch (way) {
    case Way::none: return;
    case Way::exit: std::exit(0);
    case Way::quick_exit: std::quick_exit(0);
    case Way::underscore_exit: ::_exit(0);
    case Way::abort: std::abort();
    case Way::segmentation: *nowhere = 1; return;
    case Way::overflow: {
      volatile int top = 0;
      zero = dive_deeper(&top);
      return;
    }
    case Way::terminate: throw_without_leave(); return;
    case Way::divide: zero = 7 / zero; return;
    case Way::thread_exit: std::thread([] { std::exit(0); }).join(); return;
    case Way::bytes: throw std::runtime_error("\xff\xc3\x28 \x1b[31m \x01\xed\xa0\x80\"\\");
  }
}

struct CrashParameters {
  Way way = Way::none;
  std::int64_t at = 0;

  static constexpr auto fields() {
    return describe(field<&CrashParameters::way>("", "how it ends"),
                    field<&CrashParameters::at>("", "in which activation; below 0: when the vehicle leans"));
  }
};

void end_if_due(const CrashParameters& p, const Tick& tick, double roll) {
  if (p.at < 0 ? roll > 0.1 : tick.activation >= p.at) end_by(p.way);
}

struct CrashingPilot {
  static constexpr std::string_view summary = "turns the motors, and crashes the program";
  using Param = CrashParameters;
  struct In {
    tasks::JaviatorSensors sensors{};
    static constexpr auto fields() { return describe(field<&In::sensors>()); }
  };
  struct Out {
    tasks::MotorCommand motors{};
    static constexpr auto fields() { return describe(field<&Out::motors>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, Out& out) {
    out.motors = {.signals = {8000, 8000, 8000, 8000}, .unlocked = true};
    end_if_due(p, tick, in.sensors.roll);
  }
};

struct CrashingHelmsman {
  static constexpr std::string_view summary = "turns the propeller, and crashes the program";
  using Param = CrashParameters;
  struct In {
    tasks::Motion motion{};
    static constexpr auto fields() { return describe(field<&In::motion>()); }
  };
  struct Out {
    tasks::Actuation actuation{};
    static constexpr auto fields() { return describe(field<&Out::actuation>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, Out& out) {
    out.actuation = {.thruster = 0.75, .fins = {0.1, 0.2, 0.3, 0.4}};
    end_if_due(p, tick, in.motion.phi);
  }
};
}  // namespace

JAROL_PLUGIN(CrashingPilot, CrashingHelmsman)
