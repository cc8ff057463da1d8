#include "tests/runtime/oracle.h"

#include <xxhash.h>

#include <algorithm>
#include <climits>
#include <cstring>
#include <functional>
#include <numeric>
#include <set>

namespace jarol::oracle {
namespace {

__extension__ using Wide = unsigned __int128;

std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
  const Wide product = static_cast<Wide>(a) * b;
  return static_cast<std::uint64_t>(product & ~std::uint64_t{0}) ^ static_cast<std::uint64_t>(product >> 64);
}

// One hash, straight from the definition for a value of one word.
std::uint64_t hash_of(const std::string& name, std::int64_t instant, double value) {
  std::uint64_t k[6], state = 0, word = 0;
  for (std::uint64_t& key : k) {
    state += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    key = z ^ (z >> 31);
  }
  std::memcpy(&word, &value, sizeof word);
  const std::uint64_t n = XXH64(name.data(), name.size(), 0);
  return fold((n + fold(static_cast<std::uint64_t>(instant) ^ k[2], k[3]) + fold(word ^ k[4], k[5])) ^ k[0], k[1]);
}

bool acts_at(std::int64_t period, std::int64_t offset, std::int64_t t) {
  return t >= offset && (t - offset) % period == 0;
}

std::int64_t next_after(std::int64_t period, std::int64_t offset, std::int64_t t) {
  return t < offset ? offset : offset + ((t - offset) / period + 1) * period;
}

std::string owner(const std::string& start) { return start.substr(0, start.find('.')); }

std::vector<std::string> inputs_of(const TaskModel& task) {
  if (task.type == "Counter") return {};
  if (task.type == "Sum") return {task.name + ".a", task.name + ".b"};
  return {task.name + ".in"};
}

class Interpreter {
 public:
  explicit Interpreter(const Model& model) : model_(model) {
    for (const TaskModel& t : model.tasks) published_[t.name + ".out"] = t.init;
    for (const CommunicatorModel& c : model.communicators)
      if (c.in) published_[c.name] = c.init;
    std::sort(model_.communicators.begin(), model_.communicators.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
  }

  Result run(std::int64_t end) {
    for (std::int64_t t = first_instant(); t < end; t = next_instant(t)) at_instant(t);
    std::sort(result_.trace.begin(), result_.trace.end());
    return result_;
  }

 private:
  // Everything that can be due: releases, ends of LETs, communicators.
  std::int64_t next_instant(std::int64_t t) const {
    std::int64_t next = INT64_MAX;
    for (const TaskModel& task : model_.tasks) {
      next = std::min(next, next_after(task.period, task.offset, t));
      if (task.let) next = std::min(next, next_after(task.period, task.offset + *task.let, t));
    }
    for (const CommunicatorModel& c : model_.communicators) next = std::min(next, next_after(c.period, c.offset, t));
    return next;
  }
  std::int64_t first_instant() const { return next_instant(-1); }

  void publish(std::int64_t t, const std::string& name, double value) {
    published_[name] = value;
    result_.trace.emplace_back(t, name, value);
    result_.digest += hash_of(name, t, value);
  }

  void at_instant(std::int64_t t) {
    ++result_.instants;
    // (1) outputs of LET tasks ending now
    for (const TaskModel& task : model_.tasks)
      if (task.let && acts_at(task.period, task.offset + *task.let, t))
        publish(t, task.name + ".out", pending_.at(task.name));
    // (2) outs, (3) ins
    for (const CommunicatorModel& c : model_.communicators)
      if (!c.in && acts_at(c.period, c.offset, t)) publish(t, c.name, published_.at(model_.source_of.at(c.name)));
    for (const CommunicatorModel& c : model_.communicators)
      if (c.in && acts_at(c.period, c.offset, t)) publish(t, c.name, c.init);
    // (4) released tasks: again and again any that waits for no other
    std::set<std::string> waiting;
    for (const TaskModel& task : model_.tasks)
      if (acts_at(task.period, task.offset, t)) waiting.insert(task.name);
    while (!waiting.empty())
      for (const TaskModel& task : model_.tasks) {
        if (!waiting.contains(task.name)) continue;
        bool ready = true;
        for (const std::string& input : inputs_of(task)) {
          const std::string producer = owner(model_.source_of.at(input));
          ready &= !(waiting.contains(producer) && is_data_flow(producer));
        }
        if (!ready) continue;
        run_task(task, t);
        waiting.erase(task.name);
      }
  }

  bool is_data_flow(const std::string& name) const {
    for (const TaskModel& task : model_.tasks)
      if (task.name == name) return !task.let;
    return false;
  }

  void run_task(const TaskModel& task, std::int64_t t) {
    ++result_.activations;
    std::vector<double> latched;
    for (const std::string& input : inputs_of(task)) latched.push_back(published_.at(model_.source_of.at(input)));
    double out = 0;
    if (task.type == "Counter") out = static_cast<double>((t - task.offset) / task.period);
    if (task.type == "Relay") out = latched[0];
    if (task.type == "Sum") out = latched[0] + latched[1];
    if (task.type == "Accumulate") out = state_[task.name] += latched[0];
    if (task.let) {
      pending_[task.name] = out;
    } else {
      publish(t, task.name + ".out", out);
    }
  }

  Model model_;
  std::map<std::string, double> published_, pending_, state_;
  Result result_;
};

}  // namespace

Result interpret(const Model& model, std::int64_t end) { return Interpreter(model).run(end); }

std::map<std::string, std::int64_t> enumerate_deadlines(const Model& model) {
  std::int64_t hyperperiod = 1, largest_offset = 0;
  for (const TaskModel& t : model.tasks) {
    hyperperiod = std::lcm(hyperperiod, t.period);
    largest_offset = std::max(largest_offset, t.offset);
  }
  for (const CommunicatorModel& c : model.communicators) {
    hyperperiod = std::lcm(hyperperiod, c.period);
    largest_offset = std::max(largest_offset, c.offset);
  }
  std::map<std::string, std::int64_t> known;
  std::function<std::int64_t(const TaskModel&)> deadline_of = [&](const TaskModel& task) -> std::int64_t {
    if (task.let) return *task.let;
    if (const auto at = known.find(task.name); at != known.end()) return at->second;
    std::int64_t min = task.period;
    for (std::int64_t release = task.offset; release < largest_offset + 2 * hyperperiod; release += task.period)
      for (const auto& [input, source] : model.source_of) {
        if (source != task.name + ".out") continue;
        for (const TaskModel& reader : model.tasks) {
          if (reader.name != owner(input)) continue;
          // before the reader's first release nothing is read, but the pattern repeats: only later releases count
          if (release >= reader.offset)
            min = std::min(min, next_after(reader.period, reader.offset, release) - release);
          if (acts_at(reader.period, reader.offset, release)) min = std::min(min, deadline_of(reader));
        }
        for (const CommunicatorModel& reader : model.communicators)
          if (reader.name == input && release >= reader.offset)
            min = std::min(min, next_after(reader.period, reader.offset, release) - release);
      }
    return known[task.name] = min;
  };
  for (const TaskModel& task : model.tasks) known[task.name] = deadline_of(task);
  return known;
}

}  // namespace jarol::oracle
