#include "tools/bench/graphs.h"

#include <algorithm>
#include <array>

#include "graph/analysis/policies.h"
#include "graph/language/load.h"
#include "graph/model/build.h"
#include "tasks/tasks.h"
#include "tools/bench/message.h"

namespace jarol::bench {
namespace {

const Registry& registry() {
  static const Registry known = [] {
    Registry made;
    // as a plugin's would be: tests/tools/machine_code_test.cpp looks at their code
    made.add(trusted_task_class<Source>());
    made.add(trusted_task_class<Stage>());
    made.add(task_class<Thrower>());
    made.add(trusted_task_class<Body>());
    made.add(task_class<Stamp>());
    const Type* number = &type_of<double>();
    made.add(
        DistributerClass{"Echo", "answers", {{"in", Direction::in, number, ""}, {"out", Direction::out, number, ""}}});
    analysis::add_policies(made);
    tasks::add_tasks(made);
    return made;
  }();
  return known;
}

std::string name_of(int i) { return "t" + std::to_string(1000 + i); }

int rate_of(int i) {
  constexpr std::array<int, 4> rates{1, 2, 5, 10};
  return rates[static_cast<std::size_t>(i) % rates.size()];
}

}  // namespace

Graph graph_of(const std::string& text) {
  Problems problems;
  Graph graph = build_graph(load_spec(std::make_shared<jarol::Source>(jarol::Source{"bench", text}), {}, problems),
                            registry(), problems);
  problems.throw_if_any();
  return graph;
}

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

std::string four_rates(int i) { return "period: " + std::to_string(rate_of(i)) + "ms"; }

std::string four_rates_let(int i) {
  const int period = rate_of(i);
  return "period: " + std::to_string(period) + "ms, let: " + std::to_string(period * 500) + "us";
}

std::string scattered(int count) {
  std::string tasks;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t period = 9'000'000 + std::uint64_t(i) * 2'654'435'761 % 80'000'000 + 1;
    tasks += "  " + name_of(i) + ": {type: Source, period: " + std::to_string(period) + "ns}\n";
  }
  return "graph: scattered\ntasks:\n" + tasks;
}

std::string sums(int count) {
  std::string tasks = "  source: {type: Counter, period: 1ms}\n", connections, before = "source";
  for (int i = 0; i < count; ++i) {
    const std::string name = name_of(i);
    tasks += "  " + name + ": {type: Sum, period: 1ms}\n";
    connections += "  - source.out -> " + name + ".a\n  - " + before + ".out -> " + name + ".b\n";
    before = name;
  }
  return "graph: sums\ntasks:\n" + tasks + "connections:\n" + connections;
}

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

std::string meshed(int depth, int width) {
  std::string tasks, connections;
  const auto name = [](int layer, int i) { return "l" + std::to_string(100 + layer) + "_" + std::to_string(i); };
  std::uint32_t random = 1;
  const auto below = [&](int end) {
    random = random * 1664525 + 1013904223;
    return static_cast<int>((random >> 8) % static_cast<std::uint32_t>(end));
  };
  for (int layer = 0; layer < depth; ++layer)
    for (int i = 0; i < width; ++i) {
      const std::string its = name(layer, i);
      tasks += "  " + its + ": {type: " + (layer == 0 ? "Counter" : "Sum") + ", period: 1ms}\n";
      if (layer == 0) continue;
      connections += "  - " + name(layer - 1, i) + ".out -> " + its + ".a\n";
      connections += "  - " + name(std::max(0, layer - 1 - below(2)), below(width)) + ".out -> " + its + ".b\n";
    }
  return "graph: meshed\ntasks:\n" + tasks + "connections:\n" + connections;
}

}  // namespace jarol::bench
