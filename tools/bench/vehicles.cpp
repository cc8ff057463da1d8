#include "tools/bench/vehicles.h"

#include <filesystem>
#include <stdexcept>

#include "tools/bench/timing.h"
#include "tools/load_graph.h"
#ifdef JAROL_VEHICLES
#include "tools/bench/plain_submarine.h"
#endif

namespace jarol::bench {

#ifdef JAROL_VEHICLES

namespace {
constexpr const char* dive = "specs/exolauv.yaml";
}

bool has_dive() { return std::filesystem::exists(dive); }

Figure measure_dive(int repeats) {
  constexpr int steps = 50;  // of 10 ms, per repeat: short, so that neighbours on the machine miss some
  auto loaded = tools::load_graph(dive, {});
  Executor executor(*loaded.graph, std::move(loaded.channels), {.digest = true});
  Duration until = std::chrono::seconds(10);
  executor.run_until(until);  // to the depth
  PlainSubmarine plain(vehicles::SubmarineParameters{});
  const auto closed_loop = [&] {
    until += steps * std::chrono::milliseconds(10);
    return 1e6 * seconds_of([&] { executor.run_until(until); }) / steps;
  };
  const auto alone = [&] {
    const double seconds = seconds_of([&] {
      for (int i = 0; i < steps; ++i) plain.step(0.01, 180.0);
    });
    keep(plain.surge());
    return 1e6 * seconds / steps;
  };
  Figure figure =
      compare("dive", "10 ms of the dive, all tasks and sensors (100 us: 100 times real time) / plain Eigen model", 0,
              repeats, closed_loop, alone);
  figure.unit = "us";
  figure.goal = 100.0 / figure.floor;
  return figure;
}

#else

bool has_dive() { return false; }

Figure measure_dive(int) { throw std::logic_error("no vehicles are built"); }

#endif

}  // namespace jarol::bench
