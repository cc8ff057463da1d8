#include "tools/bench/figures.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "graph/language/quantities.h"
#include "graph/text/errors.h"
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

struct Entry {
  std::string name;
  Figure (*measure)(const std::string& name, int repeats);
  bool is_of_tree = false;
};

// All figures, in their order.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> made{
        {"chain_10", [](const std::string& name, int repeats) { return chain_figure(name, 10, false, 0.85, repeats); }},
        {"chain_100",
         [](const std::string& name, int repeats) { return chain_figure(name, 100, false, 0.85, repeats); }},
        {"chain_100_digest",
         [](const std::string& name, int repeats) { return chain_figure(name, 100, true, 1.3, repeats); }},
        {"multirate_100",
         [](const std::string& name, int repeats) {
           return compare(name, "activation of 100 tasks at 1, 2, 5, 10 ms / plain loop with two copies", 1.0, repeats,
                          run_of(chain(100, four_rates), false, four_rate_activations), chain_floor(100));
         }},
        {"let_multirate_100",
         [](const std::string& name, int repeats) {
           return compare(name, "activation of 100 LET tasks at 1, 2, 5, 10 ms / plain fan", 1.5, repeats,
                          run_of(chain(100, four_rates_let), false, four_rate_activations), fan_floor(100));
         }},
        {"fan_100",
         [](const std::string& name, int repeats) {
           return compare(name, "activation of a fan of 100 / plain fan", 1.9, repeats, run_of(fan(100), false, 101),
                          fan_floor(100));
         }},
        {"coprime_100000", [](const std::string& name, int repeats) { return coprime_figure(name, repeats); }},
        {"record", [](const std::string& name, int repeats) { return measure_recording(name, false, 40, repeats); }},
        {"record_digest",
         [](const std::string& name, int repeats) { return measure_recording(name, true, 60, repeats); }},
        {"workers_2_tiny", [](const std::string&, int repeats) { return measure_tiny(repeats); }},
        {"workers_2_10us", [](const std::string&, int repeats) { return measure_10us(repeats); }},
        {"deep_1k", [](const std::string&, int repeats) { return measure_deep(repeats); }},
        {"fault", [](const std::string&, int repeats) { return fault_figure(repeats); }},
        {"guard", [](const std::string& name, int repeats) { return measure_guard(name, repeats); }},
        {"load_1000", [](const std::string&, int repeats) { return load_figure(repeats); }},
        {"load_million", [](const std::string& name, int) { return load_million(name); }},
        {"check_1000", [](const std::string& name, int repeats) { return measure_check(name, 1000, 30, repeats); }},
        {"check_10000", [](const std::string& name, int repeats) { return measure_check(name, 10'000, 350, repeats); }},
        {"port_throughput",
         [](const std::string& name, int repeats) { return measure_port_throughput(name, repeats); }},
        {"port_round_trip",
         [](const std::string& name, int repeats) { return measure_port_round_trip(name, repeats); }},
        {"push_port_throughput",
         [](const std::string& name, int repeats) { return measure_push_port_throughput(name, repeats); }},
        {"push_port_round_trip",
         [](const std::string& name, int repeats) { return measure_push_port_round_trip(name, repeats); }},
        {"clock_1khz_p50", [](const std::string& name, int repeats) { return measure_clock(name, 0.5, repeats); }},
        {"clock_1khz_p99", [](const std::string& name, int repeats) { return measure_clock(name, 0.99, repeats); }},
        {"udp_echo", [](const std::string& name, int repeats) { return measure_udp_echo(name, repeats); }},
        {"watched_0", [](const std::string& name, int repeats) { return measure_watched(name, 0, true, repeats); }},
        {"watched_1", [](const std::string& name, int repeats) { return measure_watched(name, 1, true, repeats); }},
        {"watched_100", [](const std::string& name, int repeats) { return measure_watched(name, 100, true, repeats); }},
        {"watched_slow", [](const std::string& name, int repeats) { return measure_watched(name, 1, false, repeats); }},
        {"layout_200", [](const std::string& name, int repeats) { return measure_layout(name, repeats); }},
    };
    if (has_vehicles())
      made.insert(
          made.end(),
          {
              {"dive", [](const std::string&, int repeats) { return measure_dive(repeats); }, true},
              {"dive_rigid", [](const std::string&, int repeats) { return measure_dive_rigid(repeats); }, true},
              {"hover", [](const std::string&, int repeats) { return measure_hover(repeats); }, true},
              {"hover_rigid", [](const std::string&, int repeats) { return measure_hover_rigid(repeats); }, true},
              {"checkpoint", [](const std::string&, int repeats) { return measure_checkpoint(repeats); }, true},
          });
    return made;
  }();
  return all;
}

}  // namespace

std::vector<std::string> figure_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.push_back(entry.name);
  return names;
}

bool is_of_tree(const std::string& name) {
  return std::any_of(entries().begin(), entries().end(),
                     [&](const Entry& entry) { return entry.name == name && entry.is_of_tree; });
}

Figure measure(const std::string& name, int repeats) {
  for (const Entry& entry : entries())
    if (entry.name == name) return entry.measure(name, repeats);
  throw InputError("there is no figure '" + name + "'" + did_you_mean(name, figure_names()) +
                   "; there are: " + list_of(figure_names()));
}

}  // namespace jarol::bench
