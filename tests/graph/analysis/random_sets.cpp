#include "tests/graph/analysis/random_sets.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "graph/model/stages.h"
#include "tests/graph/graph_of.h"

namespace jarol::truth {
namespace {

// splitmix64
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL) {}
  int between(int min, int max) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return min + static_cast<int>((z ^ (z >> 31)) % static_cast<std::uint64_t>(max - min + 1));
  }
  bool once_in(int times) { return between(1, times) == 1; }

 private:
  std::uint64_t state_;
};

// From a release of one to the next later instant of the other, at least; is 0 among them?
std::pair<int, bool> gap(const Task& from, const Task& to) {
  const int gcd = std::gcd(from.period, to.period), apart = ((to.offset - from.offset) % gcd + gcd) % gcd;
  return {apart == 0 ? gcd : apart, apart == 0};
}

// The latest deadline of a task without an earlier one, as those of its readers are (DESIGN, deadlines).
int derived_deadline(const Set& set, std::size_t task) {
  const Task& t = set.tasks[task];
  if (t.let) return t.deadline;
  int deadline = t.period;
  for (const auto& [from, to] : set.feeds) {
    if (from != task) continue;
    const auto [later, coincide] = gap(t, set.tasks[to]);
    deadline = std::min(deadline, later);
    if (coincide) deadline = std::min(deadline, set.tasks[to].deadline);
  }
  return deadline;
}

}  // namespace

Set random_set(std::uint64_t seed, const Policy& policy, const Features& features) {
  static const std::vector<std::vector<int>> families{
      {2, 4, 8}, {3, 6}, {2, 3, 6}, {4, 6}, {5, 5, 2}, {8, 4}, {6, 3, 2}, {3, 4}, {7}, {5}, {8}, {6}, {4}};
  Random random(seed);
  Set set;
  set.policy = policy;
  set.cores = random.between(policy == policies::global_edf ? std::min(2, features.cores) : 1, features.cores);
  set.offsets_hold = policy == policies::table || !features.any_phasing || random.once_in(2);
  const auto& family = families[static_cast<std::size_t>(random.between(0, static_cast<int>(families.size()) - 1))];
  // one period, each core full or almost, a chain from core to core: where waiting for others shows
  const bool tight = set.offsets_hold && random.once_in(4);
  const int tight_period = random.between(4, 12);
  std::vector<int> room(static_cast<std::size_t>(set.cores), tight_period - (random.once_in(4) ? 1 : 0));
  const int n = tight              ? random.between(set.cores + 1, set.cores + 3)
                : set.offsets_hold ? random.between(set.cores, set.cores + 2)
                                   : random.between(2, 3);
  const bool jitters = features.jitter && random.once_in(2), blocks = features.blocking && random.once_in(2);
  const bool together = random.once_in(2), priorities = random.once_in(3), lets = random.once_in(3);
  const bool cores_given = random.once_in(2);
  // a load from light to a little too much
  const int share = random.between(4, 12) * set.cores;
  for (int i = 0; i < n; ++i) {
    Task t;
    t.period = family[static_cast<std::size_t>(random.between(0, static_cast<int>(family.size()) - 1))];
    t.wcet = std::clamp(random.between(1, std::max(1, 2 * t.period * share / (10 * n))), 1, t.period);
    t.offset = together && random.once_in(2) ? 0 : random.between(0, t.period - 1);
    t.jitter = jitters && random.once_in(2) ? random.between(0, std::min(3, t.period - t.wcet)) : 0;
    t.blocking = blocks && random.once_in(2) ? random.between(0, std::min(4, t.period - t.wcet)) : 0;
    t.let = lets && random.once_in(2);
    t.deadline = t.period;
    if (priorities && random.once_in(2)) t.priority = random.between(0, 3);
    if (cores_given || random.once_in(3)) t.core = random.between(0, set.cores - 1);
    if (tight) {
      const int core = random.between(0, set.cores - 1);
      int& left = room[static_cast<std::size_t>(core)];
      t.period = t.deadline = tight_period;
      t.wcet = random.between(1, std::max(1, left / 2));
      left -= t.wcet;
      t.core = core;
      t.offset = random.once_in(3) ? t.period / 2 : 0;
      t.jitter = std::min(t.jitter, t.period - t.wcet);
      t.blocking = std::min(t.blocking, t.period - t.wcet);
    }
    set.tasks.push_back(t);
  }
  if (tight)
    for (Task& t : set.tasks)
      if (int& left = room[static_cast<std::size_t>(t.core.value_or(0))]; left > 0 && random.once_in(2))
        t.wcet += std::exchange(left, 0), t.jitter = t.blocking = 0;
  if (policy == policies::global_edf)
    for (Task& t : set.tasks) t.core.reset();
  if (features.data_flow && random.once_in(2)) {
    std::vector<std::size_t> rank(set.tasks.size());
    std::iota(rank.begin(), rank.end(), 0);
    for (std::size_t i = rank.size() - 1; i > 0; --i)
      std::swap(rank[i], rank[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
    std::vector<int> inputs(rank.size(), 0);
    for (std::size_t i = 0; i < rank.size(); ++i)
      for (std::size_t j = i + 1; j < rank.size(); ++j) {
        Task &from = set.tasks[rank[i]], &to = set.tasks[rank[j]];
        if (!random.once_in(tight && j == i + 1 ? 1 : 2) || inputs[rank[j]] == 2) continue;
        if (!tight && random.once_in(2)) {
          to.period = std::max(from.period, to.wcet);
          to.offset = from.offset % to.period;
        }
        // where every shift is possible the deadlines that follow from offsets would mean nothing
        if (!set.offsets_hold) {
          to.period = from.period = std::max({from.period, to.period});
          to.offset = from.offset;
        }
        set.feeds.emplace_back(rank[i], rank[j]);
        ++inputs[rank[j]];
      }
    std::sort(set.feeds.begin(), set.feeds.end(),
              [](const auto& a, const auto& b) { return std::tie(a.second, a.first) < std::tie(b.second, b.first); });
    if (!set.offsets_hold)  // what is connected goes together, also by another way
      for (std::size_t again = 0; again < rank.size(); ++again)
        for (const auto& [from, to] : set.feeds) {
          Task &a = set.tasks[from], &b = set.tasks[to];
          a.period = b.period = std::max(a.period, b.period);
          a.offset = b.offset = 0;
        }
    // readers first
    for (std::size_t i = rank.size(); i-- > 0;) {
      Task& t = set.tasks[rank[i]];
      t.deadline = t.period;
      t.deadline = derived_deadline(set, rank[i]);
      if (random.once_in(tight ? 9 : 3)) t.deadline = random.between(std::min(t.wcet, t.deadline), t.deadline);
    }
  } else {
    for (Task& t : set.tasks)
      if (random.once_in(2)) t.deadline = random.between(t.wcet, t.period);
  }
  // all even, so that a shift by less than the unit is among those that are possible
  const auto is_delayed = [](const Task& t) { return t.jitter + t.blocking > 0; };
  if (!set.offsets_hold && std::any_of(set.tasks.begin(), set.tasks.end(), is_delayed))
    for (Task& t : set.tasks)
      for (int* time : {&t.wcet, &t.period, &t.deadline, &t.offset, &t.jitter, &t.blocking}) *time *= 2;
  return set;
}

Set random_chains(std::uint64_t seed) {
  Random random(seed + (std::uint64_t{1} << 40));
  Set set;
  set.cores = random.between(2, 3);
  const int period = 2 * random.between(10, 20);
  const bool delays = random.once_in(4);
  std::vector<int> room(static_cast<std::size_t>(set.cores), period);
  const int n = random.between(2 * set.cores, 3 * set.cores + 3);
  for (int i = 0; i < n; ++i) {
    Task t;
    t.core = random.between(0, set.cores - 1);
    int& left = room[static_cast<std::size_t>(*t.core)];
    t.period = t.deadline = random.once_in(6) ? period / 2 : period;
    const int times = period / t.period;
    t.wcet = random.between(1, std::max(1, left / (3 * times)));
    left -= times * t.wcet;
    if (delays && random.once_in(3)) t.jitter = random.between(0, 3);
    if (delays && random.once_in(3) && left > 3 * times) left -= times * (t.blocking = random.between(0, 2));
    t.offset = random.once_in(3) ? period / 4 : 0;
    set.tasks.push_back(t);
    // mostly of the one before it, wherever that is
    if (i > 0 && random.between(1, 3) < 3) {
      set.feeds.emplace_back(i - 1, i);
      if (random.once_in(2)) set.tasks.back().offset = set.tasks[static_cast<std::size_t>(i) - 1].offset % t.period;
    }
  }
  for (Task& t : set.tasks)
    if (int& left = room[static_cast<std::size_t>(*t.core)]; left > 0 && t.period == period && random.once_in(2))
      t.wcet += std::exchange(left, random.once_in(4) ? -1 : 0);
  for (std::size_t i = set.tasks.size(); i-- > 0;) {
    Task& t = set.tasks[i];
    t.deadline = derived_deadline(set, i);
  }
  return set;
}

Places places_in(const Graph& graph) {
  Places places{std::vector<std::size_t>(graph.tasks.size()), std::vector<std::size_t>(graph.tasks.size())};
  const std::vector<std::size_t> turns = dispatch_order(graph);
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    places.turn[turns[i]] = i;
    places.order[graph.order[i]] = i;
  }
  return places;
}

std::string counting_type(const Task&, std::size_t inputs) {
  return inputs == 0 ? "Counter" : inputs == 1 ? "Relay" : "Sum";
}

std::string yaml_of(const Set& set, const std::string& unit, const TypeOf& type) {
  std::string text = "graph: t\nplatform: {cores: " + std::to_string(set.cores) +
                     ", policy: " + std::string(set.policy.name) + (set.offsets_hold ? "" : ", phasing: any") +
                     "}\ntasks:\n";
  std::string connections;
  for (std::size_t i = 0; i < set.tasks.size(); ++i) {
    const Task& t = set.tasks[i];
    const std::string name(1, static_cast<char>('a' + i));
    int inputs = 0;
    std::vector<std::size_t> producers;
    for (const auto& [from, to] : set.feeds)
      if (to == i) producers.push_back(from);
    for (const std::size_t from : producers)
      connections += (connections.empty() ? "" : ", ") + std::string(1, static_cast<char>('a' + from)) + ".out -> " +
                     name +
                     (producers.size() == 1 ? ".in"
                      : inputs++ == 0       ? ".a"
                                            : ".b");
    text += "  " + name + ": {type: " + type(t, producers.size());
    const auto say = [&](const char* key, int value) {
      text += std::string(", ") + key + ": " + std::to_string(value) + unit;
    };
    say("period", t.period);
    if (t.offset > 0) say("offset", t.offset);
    if (t.let) say("let", t.deadline);
    if (!t.let) say("deadline", t.deadline);
    say("wcet", t.wcet);
    if (t.jitter > 0) say("jitter", t.jitter);
    if (t.blocking > 0) say("blocking", t.blocking);
    if (t.priority) text += ", priority: " + std::to_string(*t.priority);
    if (t.core) text += ", core: " + std::to_string(*t.core);
    text += "}\n";
  }
  return text + (connections.empty() ? "" : "connections: [" + connections + "]\n");
}

Graph graph_of(const Set& set) {
  static const Graph known = tests::graph_of(
      "graph: t\ntiming: {period: 1s}\ntasks: {a: {type: Counter}, b: {type: Relay}, c: {type: Sum}}\n"
      "connections: [a.out -> b.in, a.out -> c.a, b.out -> c.b]\n");
  Graph graph;
  graph.name = "t";
  graph.platform.cores = set.cores;
  graph.platform.policy = tests::generic_tasks().find_policy(set.policy.name);
  graph.platform.phasing = set.offsets_hold ? Phasing::given : Phasing::any;
  for (std::size_t i = 0; i < set.tasks.size(); ++i) {
    const Task& t = set.tasks[i];
    jarol::Task task;
    std::size_t inputs = 0;
    for (const auto& [from, to] : set.feeds) {
      if (to != i) continue;
      graph.connections.push_back(known.connections[0]);
      graph.connections.back().from = {End::Kind::task, from, 0};
      graph.connections.back().to = {End::Kind::task, to, inputs++};
    }
    task.name = std::string(1, static_cast<char>('a' + i));
    task.task_class = known.tasks[inputs].task_class;
    task.period = Duration(t.period);
    task.offset = Duration(t.offset);
    if (t.let) task.let = Duration(t.deadline);
    task.deadline = Duration(t.deadline);
    task.wcet = Duration(t.wcet);
    task.jitter = Duration(t.jitter);
    task.blocking = Duration(t.blocking);
    task.priority = t.priority;
    task.core = t.core;
    graph.tasks.push_back(task);
  }
  // the first by name of those whose producers stand there already
  std::vector<bool> placed(set.tasks.size(), false);
  while (graph.order.size() < set.tasks.size()) {
    std::size_t next = 0;
    while (placed[next] || std::any_of(set.feeds.begin(), set.feeds.end(), [&](const auto& feed) {
             return feed.second == next && !placed[feed.first] && !set.tasks[feed.first].let;
           }))
      ++next;
    placed[next] = true;
    graph.order.push_back(next);
  }
  return graph;
}

}  // namespace jarol::truth
