#include "tools/bench/figures.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>

#include "graph/language/quantities.h"
#include "tools/bench/checking.h"
#include "tools/bench/clock.h"
#include "tools/bench/deep.h"
#include "tools/bench/echo.h"
#include "tools/bench/floors.h"
#include "tools/bench/graphs.h"
#include "tools/bench/guarded.h"
#include "tools/bench/ports.h"
#include "tools/bench/recording.h"
#include "tools/bench/sharing.h"
#include "tools/bench/timing.h"
#include "tools/bench/vehicles.h"
#include "tools/bench/watched.h"
#include "tools/bench/yaml_floor.h"

namespace jarol::bench {
namespace {

constexpr std::uint64_t activations = 40'000;  // per repeat

std::function<double()> chain_floor(std::size_t length) {
  return [floor = std::make_shared<ChainFloor>(length), length] {
    const double seconds = seconds_of([&] { keep(floor->run(activations / length)); });
    return 1e9 * seconds / static_cast<double>(activations / length * length);
  };
}

std::function<double()> fan_floor(std::size_t readers) {
  return [floor = std::make_shared<FanFloor>(readers), readers] {
    const std::uint64_t rounds = activations / (readers + 1);
    const double seconds = seconds_of([&] { keep(floor->run(rounds)); });
    return 1e9 * seconds / static_cast<double>(rounds * (readers + 1));
  };
}

std::function<double()> run_of(const std::string& text, bool digest, double activations_per_ms) {
  const auto slice =
      std::chrono::milliseconds(static_cast<std::int64_t>(static_cast<double>(activations) / activations_per_ms));
  return [run = std::make_shared<GraphRun>(text, digest, slice)] { return run->nanoseconds(); };
}

Figure chain_figure(const std::string& name, int length, bool digest, double goal, int repeats) {
  return compare(
      name, std::string("activation of a chain") + (digest ? ", digest on" : "") + " / plain loop with two copies",
      goal, repeats, run_of(chain(length, same_rate), digest, length), chain_floor(static_cast<std::size_t>(length)));
}

// 25 tasks at each of 1, 2, 5 and 10 ms: 45 activations a millisecond
constexpr double four_rate_activations = 25 * (1 + 0.5 + 0.2 + 0.1);

Figure fault_figure(int repeats) {
  const std::string text = "graph: faults\ntasks:\n  t: {type: Thrower, period: 1ms, on_fault: hold}\n";
  auto run = std::make_shared<GraphRun>(text, false, std::chrono::seconds(5));
  // the goal is absolute: the floor is its unit, one microsecond
  Figure figure{"fault", 1e300, "ns", 1000, 0, 1.2, "containing a throw / 1 us"};
  for (int i = 0; i < repeats; ++i) figure.value = std::min(figure.value, run->nanoseconds());
  figure.ratio = figure.value / figure.floor;
  return figure;
}

// No two are due at the same instant for long.
Figure coprime_figure(const std::string& name, int repeats) {
  GraphRun run(scattered(100'000), false, std::chrono::milliseconds(10));
  // the goal is absolute: the floor is its unit, one nanosecond
  Figure figure{name, 1e300, "ns", 1, 0, 200, "activation of 100,000 tasks, hardly two at an instant / 1 ns"};
  for (int i = 0; i < 9; ++i) run.nanoseconds();  // all are released together once, at the start
  for (int i = 0; i < repeats; ++i) figure.value = std::min(figure.value, run.nanoseconds());
  figure.ratio = figure.value / figure.floor;
  return figure;
}

Figure load_figure(int repeats) {
  std::string text = chain(1000, [](int i) { return four_rates(i) + ", let: 1ms, wcet: 10us"; });
  const auto load = [&] {
    return 1e6 * 1e-3 * seconds_of([&] {
             const Graph graph = graph_of(text);
             const Plan plan(graph);
             const RunState state(plan);
             keep(static_cast<double>(state.activations.size()));
           });
  };
  Figure figure =
      compare("load_1000", "load, validate and plan 1000 tasks / yaml-cpp's own parse", 1.05, std::max(3, repeats / 4),
              load, [&] { return 1e3 * seconds_of([&] { keep(parse_only(text)); }); });
  figure.unit = "ms";
  return figure;
}

// Once: it takes seconds, and gigabytes.
Figure load_million(const std::string& name) {
  const std::string text = sums(500'000);
  // the goal is absolute: the floor is its unit, one second
  Figure figure{name, 0, "s", 1, 0, 15, "load, validate and plan a million connections / 1 s"};
  figure.value = seconds_of([&] {
    const Graph graph = graph_of(text);
    const Plan plan(graph);
    const RunState state(plan);
    keep(static_cast<double>(state.activations.size()));
  });
  figure.ratio = figure.value / figure.floor;
  return figure;
}

}  // namespace

std::vector<std::string> figure_names() {
  std::vector<std::string> names{"chain_10",
                                 "chain_100",
                                 "chain_100_digest",
                                 "multirate_100",
                                 "let_multirate_100",
                                 "fan_100",
                                 "coprime_100000",
                                 "record",
                                 "record_digest",
                                 "workers_2_tiny",
                                 "workers_2_10us",
                                 "deep_1k",
                                 "fault",
                                 "guard",
                                 "load_1000",
                                 "load_million",
                                 "check_1000",
                                 "check_10000",
                                 "port_throughput",
                                 "port_round_trip",
                                 "push_port_throughput",
                                 "push_port_round_trip",
                                 "clock_1khz_p50",
                                 "clock_1khz_p99",
                                 "udp_echo",
                                 "watched_0",
                                 "watched_1",
                                 "watched_100",
                                 "watched_slow",
                                 "layout_200"};
  if (has_vehicles()) names.insert(names.end(), {"dive", "dive_rigid", "hover", "hover_rigid", "checkpoint"});
  return names;
}

Figure measure(const std::string& name, int repeats) {
  if (name == "chain_10") return chain_figure(name, 10, false, 0.85, repeats);
  if (name == "chain_100") return chain_figure(name, 100, false, 0.85, repeats);
  if (name == "chain_100_digest") return chain_figure(name, 100, true, 1.3, repeats);
  if (name == "multirate_100")
    return compare(name, "activation of 100 tasks at 1, 2, 5, 10 ms / plain loop with two copies", 1.0, repeats,
                   run_of(chain(100, four_rates), false, four_rate_activations), chain_floor(100));
  if (name == "let_multirate_100")
    return compare(name, "activation of 100 LET tasks at 1, 2, 5, 10 ms / plain fan", 1.5, repeats,
                   run_of(chain(100, four_rates_let), false, four_rate_activations), fan_floor(100));
  if (name == "fan_100")
    return compare(name, "activation of a fan of 100 / plain fan", 1.9, repeats, run_of(fan(100), false, 101),
                   fan_floor(100));
  if (name == "coprime_100000") return coprime_figure(name, repeats);
  if (name == "record") return measure_recording(name, false, 40, repeats);
  if (name == "record_digest") return measure_recording(name, true, 60, repeats);
  if (name == "workers_2_tiny") return measure_tiny(repeats);
  if (name == "workers_2_10us") return measure_10us(repeats);
  if (name == "deep_1k") return measure_deep(repeats);
  if (name == "fault") return fault_figure(repeats);
  if (name == "guard") return measure_guard(name, repeats);
  if (name == "load_1000") return load_figure(repeats);
  if (name == "load_million") return load_million(name);
  if (name == "check_1000") return measure_check(name, 1000, 30, repeats);
  if (name == "check_10000") return measure_check(name, 10'000, 350, repeats);
  if (name == "port_throughput") return measure_port_throughput(name, repeats);
  if (name == "port_round_trip") return measure_port_round_trip(name, repeats);
  if (name == "push_port_throughput") return measure_push_port_throughput(name, repeats);
  if (name == "push_port_round_trip") return measure_push_port_round_trip(name, repeats);
  if (name == "clock_1khz_p50") return measure_clock(name, 0.5, repeats);
  if (name == "clock_1khz_p99") return measure_clock(name, 0.99, repeats);
  if (name == "udp_echo") return measure_udp_echo(name, repeats);
  if (name == "watched_0") return measure_watched(name, 0, true, repeats);
  if (name == "watched_1") return measure_watched(name, 1, true, repeats);
  if (name == "watched_100") return measure_watched(name, 100, true, repeats);
  if (name == "watched_slow") return measure_watched(name, 1, false, repeats);
  if (name == "layout_200") return measure_layout(name, repeats);
  if (name == "dive") return measure_dive(repeats);
  if (name == "dive_rigid") return measure_dive_rigid(repeats);
  if (name == "hover") return measure_hover(repeats);
  if (name == "hover_rigid") return measure_hover_rigid(repeats);
  if (name == "checkpoint") return measure_checkpoint(repeats);
  throw std::invalid_argument("there is no figure '" + name + "'" + did_you_mean(name, figure_names()) +
                              "; there are: " + list_of(figure_names()));
}

}  // namespace jarol::bench
