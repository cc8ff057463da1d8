#include "tools/bench/figures.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "graph/build.h"
#include "graph/spec/load.h"
#include "runtime/copy.h"
#include "runtime/executor.h"
#include "tasks/tasks.h"
#include "tools/bench/floors.h"
#include "tools/bench/yaml_floor.h"

namespace jarol::bench {
namespace {

const Registry& registry() {
  static const Registry known = [] {
    Registry made;
    made.add(task_class<Source>());
    made.add(task_class<Stage>());
    made.add(task_class<Thrower>());
    made.add(task_class<Body>());
    tasks::add_tasks(made);
    return made;
  }();
  return known;
}

Graph graph_of(const std::string& text) {
  Problems problems;
  Graph graph = build_graph(load_spec(std::make_shared<jarol::Source>(jarol::Source{"bench", text}), {}, problems),
                            registry(), problems);
  problems.throw_if_any();
  return graph;
}

std::string name_of(int i) { return "t" + std::to_string(1000 + i); }

using Keys = std::function<std::string(int)>;

// A chain: a source and stages, `keys` gives each task its timing.
std::string chain(int length, const Keys& keys) {
  std::string tasks, connections;
  for (int i = 0; i < length; ++i) {
    tasks += "  " + name_of(i) + ": {type: " + (i == 0 ? "Source" : "Stage") + ", " + keys(i) + "}\n";
    if (i > 0) connections += "  - " + name_of(i - 1) + ".out -> " + name_of(i) + ".in\n";
  }
  return "graph: chain\ntasks:\n" + tasks + "connections:\n" + connections;
}

std::string fan(int readers) {
  std::string tasks = "  source: {type: Source, period: 1ms}\n", connections;
  for (int i = 0; i < readers; ++i) {
    tasks += "  " + name_of(i) + ": {type: Stage, period: 1ms}\n";
    connections += "  - source.out -> " + name_of(i) + ".in\n";
  }
  return "graph: fan\ntasks:\n" + tasks + "connections:\n" + connections;
}

std::string same_rate(int) { return "period: 1ms"; }

int rate_of(int i) {
  constexpr std::array<int, 4> rates{1, 2, 5, 10};
  return rates[static_cast<std::size_t>(i) % rates.size()];
}

std::string four_rates(int i) { return "period: " + std::to_string(rate_of(i)) + "ms"; }

std::string four_rates_let(int i) {
  const int period = rate_of(i);
  return "period: " + std::to_string(period) + "ms, let: " + std::to_string(period * 500) + "us";
}

// A source and `layers` of `width` tasks, each fed by the one above.
std::string layers(int depth, int width, std::uint32_t rounds) {
  std::string tasks = "  source: {type: Source, period: 1ms}\n", connections;
  for (int layer = 0; layer < depth; ++layer)
    for (int i = 0; i < width; ++i) {
      const auto name = [&](int l) { return "l" + std::to_string(l) + "_" + std::to_string(1000 + i); };
      tasks +=
          "  " + name(layer) + ": {type: Body, period: 1ms, parameters: {rounds: " + std::to_string(rounds) + "}}\n";
      connections +=
          "  - " + (layer == 0 ? std::string("source") : name(layer - 1)) + ".out -> " + name(layer) + ".in\n";
    }
  return "graph: layers\ntasks:\n" + tasks + "connections:\n" + connections;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

volatile double kept = 0;  // so that no floor is optimised away

// Runs a graph in slices of about `activations` and tells the nanoseconds of one.
class GraphRun {
 public:
  GraphRun(const std::string& text, bool digest, Duration slice, std::size_t workers = 1)
      : graph_(graph_of(text)),
        executor_(graph_, {}, {.digest = digest, .recorder = nullptr, .workers = workers}),
        slice_(slice) {}

  double nanoseconds() {
    const std::uint64_t before = executor_.report().activations;
    until_ += slice_;
    const double seconds = seconds_of([&] { executor_.run_until(until_); });
    return 1e9 * seconds / static_cast<double>(executor_.report().activations - before);
  }

 private:
  Graph graph_;
  Executor executor_;
  Duration slice_;
  Duration until_{};
};

// Interleaves the two and takes the least of each: what neighbours on the machine add is left out.
Figure compare(std::string name, std::string text, double goal, int repeats, const std::function<double()>& value,
               const std::function<double()>& floor) {
  Figure figure{std::move(name), 1e300, "ns", 1e300, 0, goal, std::move(text)};
  value();
  floor();
  for (int i = 0; i < repeats; ++i) {
    figure.floor = std::min(figure.floor, floor());
    figure.value = std::min(figure.value, value());
  }
  figure.ratio = figure.value / figure.floor;
  return figure;
}

constexpr std::uint64_t activations = 40'000;  // per repeat

std::function<double()> chain_floor(std::size_t length) {
  return [floor = std::make_shared<ChainFloor>(length), length] {
    const double seconds = seconds_of([&] { kept = floor->run(activations / length); });
    return 1e9 * seconds / static_cast<double>(activations / length * length);
  };
}

std::function<double()> fan_floor(std::size_t readers) {
  return [floor = std::make_shared<FanFloor>(readers), readers] {
    const std::uint64_t rounds = activations / (readers + 1);
    const double seconds = seconds_of([&] { kept = floor->run(rounds); });
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
  // 3 us a fault is the goal; the floor is the goal's unit, one microsecond
  Figure figure{"fault", 1e300, "ns", 1000, 0, 3.0, "containing a throw / 1 us"};
  for (int i = 0; i < repeats; ++i) figure.value = std::min(figure.value, run->nanoseconds());
  figure.ratio = figure.value / figure.floor;
  return figure;
}

// Medians: what a second processor gives varies with the neighbours on the machine.
Figure compare_medians(std::string name, std::string text, double goal, int repeats,
                       const std::function<double()>& value, const std::function<double()>& floor) {
  std::vector<double> values, floors;
  value();
  floor();
  for (int i = 0; i < repeats; ++i) {
    floors.push_back(floor());
    values.push_back(value());
  }
  const auto median = [](std::vector<double>& of) {
    std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2), of.end());
    return of[of.size() / 2];
  };
  const double v = median(values), f = median(floors);
  return {std::move(name), v, "ns", f, v / f, goal, std::move(text)};
}

// How many rounds of the small body take about so long.
std::uint32_t rounds_of(double seconds) {
  Filter state;
  Message in, out;
  double least = 1e300;
  for (int i = 0; i < 20; ++i)
    least = std::min(least, seconds_of([&] {
                       for (int r = 0; r < 10'000; ++r) pass_on(in, state, out);
                     }));
  return std::max(1U, static_cast<std::uint32_t>(seconds / (least / 10'000)));
}

// The worst of many widths and bodies: a second worker never hurts.
Figure tiny_figure(int repeats) {
  Figure worst;
  for (const int width : {2, 8, 50})
    for (const double body : {8e-9, 0.3e-6, 1e-6, 3e-6}) {
      const std::string text = layers(4, width, rounds_of(body));
      const std::int64_t rounds = std::max<std::int64_t>(3, static_cast<std::int64_t>(2e-3 / (body * 4 * width)));
      const auto run = [&](std::size_t workers) {
        auto graph = std::make_shared<GraphRun>(text, false, std::chrono::milliseconds(rounds), workers);
        for (int i = 0; i < 10; ++i) graph->nanoseconds();  // what is measured before it decides
        return [graph] { return graph->nanoseconds(); };
      };
      Figure figure = compare_medians("workers_2_tiny",
                                      "two workers / one, the worst of widths 2, 8, 50 and bodies of 8 ns to 3 us: " +
                                          std::to_string(width) + " wide, " + number_text(body * 1e9) + " ns",
                                      1.1, std::max(15, repeats), run(2), run(1));
      if (figure.ratio > worst.ratio) worst = std::move(figure);
    }
  return worst;
}

// Two threads that have half of the bodies each and nothing to do with each other: the ideal.
std::function<double()> two_free_threads(int bodies, std::uint32_t rounds) {
  return [=] {
    const auto half = [=] {
      std::vector<Place> places(static_cast<std::size_t>(bodies) / 2);
      return seconds_of([&] {
        for (int repeat = 0; repeat < 10; ++repeat)
          for (Place& place : places)
            for (std::uint32_t r = 0; r < rounds; ++r) pass_on(place.in, place.state, place.out);
      });
    };
    double other = 0;
    std::thread thread([&] { other = half(); });
    const double own = half();
    thread.join();
    return 1e9 * std::max(own, other) / (10.0 * bodies);
  };
}

Figure sharing_figure(int repeats) {
  const std::uint32_t rounds = rounds_of(10e-6);
  auto two = std::make_shared<GraphRun>(layers(4, 8, rounds), false, std::chrono::milliseconds(10), std::size_t{2});
  // 0.85 of the ideal: at most 1 / 0.85 of its time
  return compare_medians(
      "workers_2_10us", "4 layers of 8 bodies of 10 us, two workers / two free threads", 1 / 0.85,
      std::max(15, repeats), [two] { return two->nanoseconds(); }, two_free_threads(32, rounds));
}

Figure deep_figure(int repeats) {
  constexpr std::size_t readers = 8, numbers = 128;
  struct Memory {
    std::vector<std::byte> region = std::vector<std::byte>(64 << 10);
    PrivateHeap heap{region.data(), region.size()};
    Sequence<double> source;
    std::array<Sequence<double>, readers> slots;
    std::vector<DeepCopy> deep;
    std::vector<Copy> copies;
    alignas(64) std::array<std::array<double, numbers>, readers + 1> plain{};
  };
  auto memory = std::make_shared<Memory>();
  memory->source.resize(numbers);
  memory->deep.reserve(readers);
  for (Sequence<double>& slot : memory->slots) {
    slot.adopt(memory->heap.values());
    memory->deep.push_back(
        {&type_of<Sequence<double>>(), reinterpret_cast<const std::byte*>(&memory->source), nullptr});
    memory->copies.push_back({&memory->deep.back(), reinterpret_cast<std::byte*>(&slot), 0});
  }
  constexpr int rounds = 5'000;
  const auto per_copy = [](const std::function<void()>& work) { return 1e9 * seconds_of(work) / (rounds * readers); };
  Figure figure = compare(
      "deep_1k", "1 KiB sequence across a connection / memcpy", 1.5, repeats,
      [=] {
        return per_copy([&] {
          for (int r = 0; r < rounds; ++r) {
            memory->source[0] = r;
            for (const Copy& c : memory->copies) transfer(c);
          }
        });
      },
      [=] {
        return per_copy([&] {
          for (int r = 0; r < rounds; ++r) {
            memory->plain[readers][0] = r;
            for (std::size_t i = 0; i < readers; ++i) {
              std::memcpy(memory->plain[i].data(), memory->plain[readers].data(), sizeof memory->plain[i]);
              asm volatile("" ::: "memory");
            }
          }
        });
      });
  // the slots' memory is the heap's, which goes first
  kept = memory->slots[readers - 1][0];
  return figure;
}

Figure load_figure(int repeats) {
  std::string text = chain(1000, [](int i) { return four_rates(i) + ", let: 1ms, wcet: 10us"; });
  const auto load = [&] {
    return 1e6 * 1e-3 * seconds_of([&] {
             const Graph graph = graph_of(text);
             const Plan plan(graph);
             kept = static_cast<double>(plan.groups.size());
           });
  };
  Figure figure =
      compare("load_1000", "load, validate and plan 1000 tasks / yaml-cpp's own parse", 1.3, std::max(3, repeats / 4),
              load, [&] { return 1e3 * seconds_of([&] { kept = parse_only(text); }); });
  figure.unit = "ms";
  return figure;
}

}  // namespace

std::vector<std::string> figure_names() {
  return {"chain_10",       "chain_100",      "chain_100_digest", "multirate_100", "let_multirate_100", "fan_100",
          "workers_2_tiny", "workers_2_10us", "deep_1k",          "fault",         "load_1000"};
}

Figure measure(const std::string& name, int repeats) {
  if (name == "chain_10") return chain_figure(name, 10, false, 1.0, repeats);
  if (name == "chain_100") return chain_figure(name, 100, false, 1.0, repeats);
  if (name == "chain_100_digest") return chain_figure(name, 100, true, 1.5, repeats);
  if (name == "multirate_100")
    return compare(name, "activation of 100 tasks at 1, 2, 5, 10 ms / plain loop with two copies", 1.0, repeats,
                   run_of(chain(100, four_rates), false, four_rate_activations), chain_floor(100));
  if (name == "let_multirate_100")
    return compare(name, "activation of 100 LET tasks at 1, 2, 5, 10 ms / plain fan", 1.6, repeats,
                   run_of(chain(100, four_rates_let), false, four_rate_activations), fan_floor(100));
  if (name == "fan_100")
    return compare(name, "activation of a fan of 100 / plain fan", 2.8, repeats, run_of(fan(100), false, 101),
                   fan_floor(100));
  if (name == "workers_2_tiny") return tiny_figure(repeats);
  if (name == "workers_2_10us") return sharing_figure(repeats);
  if (name == "deep_1k") return deep_figure(repeats);
  if (name == "fault") return fault_figure(repeats);
  if (name == "load_1000") return load_figure(repeats);
  throw std::invalid_argument("there is no figure '" + name + "'" + did_you_mean(name, figure_names()) +
                              "; there are: " + list_of(figure_names()));
}

}  // namespace jarol::bench
