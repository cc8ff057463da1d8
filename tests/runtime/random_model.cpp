#include "tests/runtime/random_model.h"

#include <algorithm>
#include <array>

#include "graph/values/seed.h"

namespace jarol::oracle {
namespace {

// splitmix64; distributions of the standard library differ between libraries.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x2545f4914f6cdd1dULL + 1) {}
  std::uint64_t draw() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(draw() % static_cast<std::uint64_t>(n)); }
  bool one_in(std::int64_t n) { return below(n) == 0; }
  template <class C>
  auto of(const C& choices) {
    return choices[static_cast<std::size_t>(below(static_cast<std::int64_t>(choices.size())))];
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[static_cast<std::size_t>(below(static_cast<std::int64_t>(i)))]);
  }

 private:
  std::uint64_t state_;
};

constexpr std::int64_t ms = 1'000'000;

std::string random_name(Dice& dice, std::size_t number) {
  const std::string letters = "abzAZ_";
  std::string name(1, dice.of(letters));
  for (std::int64_t i = dice.below(4); i > 0; --i) name += dice.of(letters);
  return name + std::to_string(number);  // the number makes it unique
}

std::int64_t random_offset(Dice& dice, std::int64_t period) {
  if (dice.one_in(2)) return 0;
  if (dice.one_in(2)) return dice.below(period / 1000) * 1000;
  return dice.below(period);
}

std::string duration_text(std::int64_t ns) {
  if (ns % ms == 0) return std::to_string(ns / ms) + "ms";
  if (ns % 1000 == 0) return std::to_string(ns / 1000) + "us";
  return std::to_string(ns) + "ns";
}

}  // namespace

Model random_model(std::uint64_t seed) {
  Dice dice(seed);
  const std::array<std::vector<std::int64_t>, 5> families{{{1 * ms, 2 * ms, 5 * ms, 10 * ms},
                                                           {3 * ms, 7 * ms, 11 * ms},
                                                           {5 * ms},
                                                           {2 * ms, 3 * ms, 4 * ms, 6 * ms},
                                                           {1000 * 1500, 1000 * 2500, 1000 * 4000}}};
  const std::vector<std::int64_t> periods = dice.of(families);
  Model model;
  const std::int64_t count = 1 + dice.below(30);
  for (std::int64_t i = 0; i < count; ++i) {
    TaskModel task;
    task.name = random_name(dice, static_cast<std::size_t>(i));
    task.type = dice.of(std::array<std::string, 4>{"Counter", "Relay", "Sum", "Accumulate"});
    task.period = dice.of(periods);
    task.offset = random_offset(dice, task.period);
    if (dice.one_in(2)) task.let = dice.one_in(3) ? task.period : 1 + dice.below(task.period);
    if (dice.one_in(3)) task.init = static_cast<double>(dice.below(100)) / 8;
    model.tasks.push_back(task);
  }
  std::vector<std::string> starts;  // communicators that come in
  for (std::int64_t i = 1 + dice.below(3); i > 0; --i) {
    CommunicatorModel c;
    c.name = random_name(dice, 100 + static_cast<std::size_t>(i));
    c.in = true;
    c.period = dice.of(periods);
    c.offset = random_offset(dice, c.period);
    c.init = static_cast<double>(dice.below(1000)) / 16;
    model.communicators.push_back(c);
    starts.push_back(c.name);
  }
  // a source that makes no cycle without a LET: communicators, earlier tasks, any task with a LET
  const auto random_source = [&](std::size_t before) {
    std::vector<std::string> possible = starts;
    for (std::size_t i = 0; i < model.tasks.size(); ++i)
      if (i < before || model.tasks[i].let) possible.push_back(model.tasks[i].name + ".out");
    return dice.of(possible);
  };
  for (std::size_t i = 0; i < model.tasks.size(); ++i) {
    const TaskModel& task = model.tasks[i];
    if (task.type == "Relay" || task.type == "Accumulate") model.source_of[task.name + ".in"] = random_source(i);
    if (task.type == "Sum")
      for (const char* input : {".a", ".b"}) model.source_of[task.name + input] = random_source(i);
  }
  for (std::int64_t i = dice.below(3); i > 0; --i) {
    CommunicatorModel c;
    c.name = random_name(dice, 200 + static_cast<std::size_t>(i));
    c.period = dice.of(periods);
    c.offset = random_offset(dice, c.period);
    model.communicators.push_back(c);
    model.source_of[c.name] = random_source(model.tasks.size());
  }
  // each that comes in has to go somewhere
  for (std::size_t i = 0; i < starts.size(); ++i) {
    bool used = false;
    for (const auto& [end, source] : model.source_of) used |= source == starts[i];
    if (used) continue;
    CommunicatorModel c;
    c.name = random_name(dice, 300 + i);
    c.period = dice.of(periods);
    c.offset = random_offset(dice, c.period);
    model.communicators.push_back(c);
    model.source_of[c.name] = starts[i];
  }
  return model;
}

std::string to_yaml(const Model& model, std::uint64_t shuffle) {
  Dice dice(shuffle);
  std::vector<std::string> tasks, communicators, connections;
  for (const TaskModel& t : model.tasks)
    tasks.push_back("  " + t.name + ": {type: " + t.type + ", period: " + duration_text(t.period) +
                    ", offset: " + duration_text(t.offset) + (t.let ? ", let: " + duration_text(*t.let) : "") +
                    ", init: {out: " + std::to_string(t.init) + "}}\n");
  for (const CommunicatorModel& c : model.communicators)
    communicators.push_back("  " + c.name +
                            ": {type: double, direction: " + (c.in ? "in, init: " + std::to_string(c.init) : "out") +
                            ", period: " + duration_text(c.period) + ", offset: " + duration_text(c.offset) + "}\n");
  for (const auto& [end, source] : model.source_of) connections.push_back("  - " + source + " -> " + end + "\n");
  dice.shuffle(tasks);
  dice.shuffle(communicators);
  dice.shuffle(connections);
  std::string text = "graph: random\ntasks:\n";
  for (const auto& line : tasks) text += line;
  text += "communicators:\n";
  for (const auto& line : communicators) text += line;
  text += "connections:\n";
  for (const auto& line : connections) text += line;
  return text;
}

std::string coarse_random_graph(std::uint64_t seed, std::int64_t step,
                                const std::function<std::string(const TaskModel&)>& keys) {
  const auto coarse = [&](std::int64_t ns) { return (ns + ms - 1) / ms * step; };
  Model model = random_model(seed);
  for (TaskModel& task : model.tasks) {
    task.period = coarse(task.period);
    task.offset = coarse(task.offset) % task.period;
    if (task.let) task.let = coarse(*task.let);
  }
  for (CommunicatorModel& c : model.communicators) {
    c.period = coarse(c.period);
    c.offset = coarse(c.offset) % c.period;
  }
  std::string text = to_yaml(model, seed);
  for (const TaskModel& task : model.tasks) {
    const std::string begin = "  " + task.name + ": {";
    text.insert(text.find(begin) + begin.size(), keys(task) + ", ");
  }
  return text;
}

std::string hurried_random_graph(std::uint64_t seed) {
  constexpr std::int64_t step = 20'000;
  return coarse_random_graph(seed, step, [&](const TaskModel& task) {
    const char* const on_fault[] = {"hold", "skip", "restart", "stop"};
    return std::string("core: ANY, on_fault: ") + on_fault[spread_seed(seed, task.name) % (seed % 4 == 0 ? 4 : 3)];
  });
}

}  // namespace jarol::oracle
