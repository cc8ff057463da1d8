#include "graph/analysis/remedies.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "graph/analysis/policies.h"
#include "graph/language/tables.h"
#include "graph/model/build.h"

namespace jarol::analysis {
namespace {

constexpr std::size_t max_remedies = 5, max_executable = 4;

std::string quoted(const std::string& key, const std::string& value) { return "'" + key + ": " + value + "'"; }

// Looks for changes that hold, by loading and checking the graph with each.
class Search {
 public:
  Search(const std::shared_ptr<const Source>& source, const Overrides& overrides, const Registry& registry,
         const GraphCheck& found, const Loads& loads, Budget& budget)
      : source_(source),
        overrides_(overrides),
        registry_(registry),
        check_(found),
        loads_(loads),
        budget_(budget),
        overfull_(overfull_core(system_of(*found.graph))) {}

  std::vector<Remedy> run() {
    std::vector<Kind> kinds{&Search::offsets,  &Search::deadlines, &Search::priorities, &Search::executable_policies,
                            &Search::unpinned, &Search::cores,     &Search::lets,       &Search::without_lets,
                            &Search::periods};
    // nothing else takes work away from a core
    if (overfull_) std::rotate(kinds.begin(), kinds.begin() + 4, kinds.begin() + 5);
    try_all(kinds);
    if (found_.empty()) try_pairs();
    if (found_.size() > max_executable) found_.resize(max_executable);
    wcets();
    for (const Policy& policy : registry_.policies())
      if (!policy.executed && policy.interrupts && found_.size() < max_remedies) add(policy_remedy(policy));
    if (found_.size() > max_remedies) found_.resize(max_remedies);
    return std::move(found_);
  }

 private:
  using Kind = void (Search::*)();

  const Graph& graph() const { return *check_.graph; }

  // Does the graph hold with these changes, chains included? Changes that make it invalid don't.
  bool holds(const std::vector<std::string>& set) {
    // loading takes its time, too
    if (!budget_.spend(1000 * graph().tasks.size())) return false;
    Overrides changed = overrides_;
    changed.set.insert(changed.set.end(), set.begin(), set.end());
    Problems problems;
    const GraphSpec spec = load_spec(source_, changed, problems, registry_.grammars());
    const Graph graph = build_graph(spec, registry_, problems);
    if (!problems.empty() || !open_deadline(graph).empty()) return false;
    if (verdict_of(system_of(graph), budget_) != Verdict::schedulable) return false;
    const bool chains_hold = std::all_of(graph.chains.begin(), graph.chains.end(), [&](const Chain& chain) {
      return broken_limits(chain, latency_of(graph, chain.path, budget_)).empty();
    });
    return chains_hold && loads_(changed);
  }

  // What it is tried with while pairs are looked for.
  std::vector<std::string> with(std::vector<std::string> set) const {
    set.insert(set.begin(), beside_.set.begin(), beside_.set.end());
    return set;
  }

  bool add(const Remedy& remedy) {
    if (remedy.set.empty() || !holds(with(remedy.set))) return false;
    found_.push_back({beside_.text.empty() ? remedy.text : beside_.text + " and " + remedy.text, with(remedy.set)});
    return true;
  }

  void try_all(const std::vector<Kind>& kinds) {
    for (const Kind kind : kinds)
      if (found_.size() < max_executable) (this->*kind)();
  }

  // One change and one more: another policy or a core more beside each of the others.
  void try_pairs() {
    std::vector<Remedy> others{cores_remedy(), priorities_remedy()};
    const std::vector<Policy>& policies = registry_.policies();
    for (auto policy = policies.rbegin(); policy != policies.rend(); ++policy)
      if (policy->executed) others.push_back(policy_remedy(*policy));
    for (const Remedy& first : others) {
      if (first.set.empty() || !found_.empty()) continue;
      beside_ = first;
      try_all(
          {&Search::priorities, &Search::executable_policies, &Search::deadlines, &Search::offsets, &Search::cores});
    }
    beside_ = {};
  }

  // Tasks that a shift may help, longest first: their work is what others wait for.
  template <class Of>
  std::vector<const Task*> longest_tasks(const Of& of) const {
    std::vector<const Task*> tasks;
    for (const Task& task : graph().tasks)
      if (of(task)) tasks.push_back(&task);
    std::stable_sort(tasks.begin(), tasks.end(), [](const Task* a, const Task* b) { return *a->wcet > *b->wcet; });
    if (tasks.size() > 6) tasks.resize(6);
    return tasks;
  }

  void offsets() {
    if (graph().platform.phasing != Phasing::given) return;
    for (const Task* task : longest_tasks([](const Task&) { return true; }))
      for (int eighth = 1; eighth < 8; ++eighth) {
        const Duration offset = task->period * eighth / 8;
        if (offset == task->offset || offset <= Duration{}) continue;
        if (add({quoted("offset", duration_text(offset)) + " of '" + task->name + "'",
                 {"tasks." + task->name + ".offset=" + duration_text(offset)}}))
          return;
      }
  }

  // Deadlines that were declared earlier than needed.
  void deadlines() {
    Problems problems;
    const GraphSpec spec = load_spec(source_, overrides_, problems, registry_.grammars());
    for (const TaskSpec& task : spec.tasks)
      if (task.deadline && add({"no 'deadline' of '" + task.name + "'", {"tasks." + task.name + ".deadline=null"}}))
        return;
  }

  Remedy priorities_remedy() const {
    Remedy remedy{"priorities by deadline, without 'priority'", {}};
    if (policy_of(graph().platform).urgency == Urgency::priority)
      for (const Task& task : graph().tasks)
        if (task.priority) remedy.set.push_back("tasks." + task.name + ".priority=null");
    return remedy;
  }
  void priorities() { add(priorities_remedy()); }

  Remedy policy_remedy(const Policy& policy) const {
    if (policy == policy_of(graph().platform)) return {};
    const std::string name(policy.name);
    return {quoted("policy", name) + (policy.executed ? "" : ", which 'run' does not execute"),
            {"platform.policy=" + name}};
  }
  void executable_policies() {
    for (const Policy& policy : registry_.policies())
      if (policy.executed) add(policy_remedy(policy));
  }

  // Tasks that stand on a core by `core:`, on one with more to do than time first of all.
  void unpinned() {
    if (graph().platform.cores < 2) return;
    Remedy all{"no 'core', so that check assigns them", {}};
    for (const Task& task : graph().tasks)
      if (task.core) all.set.push_back("tasks." + task.name + ".core=null");
    const auto may_move = [&](const Task& task) {
      return task.core && (!overfull_ || *task.core == static_cast<std::int64_t>(*overfull_));
    };
    for (const Task* task : longest_tasks(may_move))
      for (std::int64_t core = 0; core < graph().platform.cores; ++core)
        if (core != *task->core && add({quoted("core", std::to_string(core)) + " of '" + task->name + "'",
                                        {"tasks." + task->name + ".core=" + std::to_string(core)}}))
          return;
    add(all);
  }

  Remedy cores_remedy() const {
    const auto min = static_cast<std::int64_t>(std::ceil(check_.result.utilisation - 1e-9));
    const std::int64_t cores = std::max<std::int64_t>(graph().platform.cores + 1, min);
    if (cores > max_cores) return {};
    return {quoted("cores", std::to_string(cores)), {"platform.cores=" + std::to_string(cores)}};
  }
  void cores() { add(cores_remedy()); }

  bool is_in_broken_chain(const Task& task) const {
    const auto index = static_cast<std::size_t>(&task - graph().tasks.data());
    return std::any_of(check_.chains.begin(), check_.chains.end(), [&](const CheckedChain& c) {
      return !broken_limits(c.chain, c.latency).empty() &&
             std::any_of(c.chain.path.begin(), c.chain.path.end(),
                         [&](const End& end) { return end.kind == End::Kind::task && end.index == index; });
    });
  }

  // A later end of a LET leaves more time, an earlier one shortens the chains that go through it.
  void lets() {
    const bool late = check_.result.verdict != Verdict::schedulable;
    for (const Task& task : graph().tasks) {
      if (!task.let || (!late && !is_in_broken_chain(task))) continue;
      for (int eighth = 1; eighth <= 8; ++eighth) {
        const Duration let = late ? *task.let + (task.period - *task.let) * eighth / 8 : *task.let * (8 - eighth) / 8;
        if (let <= Duration{} || let == *task.let) continue;
        if (add({quoted("let", duration_text(let)) + " of '" + task.name + "'",
                 {"tasks." + task.name + ".let=" + duration_text(let)}}))
          return;
      }
    }
  }

  // Without a LET what a task publishes is there at once: of one task in a chain that is too slow, else of two, else of
  // all but those that need not.
  void without_lets() {
    constexpr std::size_t max_paired = 8;
    std::vector<const Task*> tasks;
    for (const Task& task : graph().tasks)
      if (task.let && is_in_broken_chain(task)) tasks.push_back(&task);
    for (const Task* task : tasks)
      if (add(without_lets_of({task}))) return;
    for (std::size_t i = 0; i < std::min(tasks.size(), max_paired); ++i)
      for (std::size_t j = i + 1; j < std::min(tasks.size(), max_paired); ++j)
        if (add(without_lets_of({tasks[i], tasks[j]}))) return;
    if (tasks.size() < 3 || !holds(with(without_lets_of(tasks).set))) return;
    for (std::size_t i = tasks.size(); i-- > 0;) {
      std::vector<const Task*> fewer = tasks;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (holds(with(without_lets_of(fewer).set))) tasks = std::move(fewer);
    }
    add(without_lets_of(tasks));
  }

  static Remedy without_lets_of(const std::vector<const Task*>& tasks) {
    Remedy remedy{"no 'let' of ", {}};
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      remedy.text += (i == 0 ? "'" : i + 1 < tasks.size() ? ", '" : " and '") + tasks[i]->name + "'";
      remedy.set.push_back("tasks." + tasks[i]->name + ".let=null");
    }
    return remedy;
  }

  // Of a chain that is too slow: a task of it twice as often, or all of it.
  void periods() {
    for (const Task& task : graph().tasks) {
      if (!is_in_broken_chain(task) || task.period.count() % 2 != 0) continue;
      const std::string period = duration_text(task.period / 2);
      if (add({quoted("period", period) + " of '" + task.name + "'", {"tasks." + task.name + ".period=" + period}}))
        return;
    }
    for (const CheckedChain& c : check_.chains) {
      if (broken_limits(c.chain, c.latency).empty()) continue;
      Remedy all{"half the periods of all of chain '" + c.chain.name + "'", {}};
      for (const End& end : c.chain.path) all.set.push_back(half_of(end));
      if (add(all)) return;
    }
  }

  std::string half_of(const End& end) const {
    if (end.kind == End::Kind::task)
      return "tasks." + graph().tasks[end.index].name + ".period=" + duration_text(graph().tasks[end.index].period / 2);
    const Communicator& communicator = graph().communicators[end.index];
    return "communicators." + communicator.name + ".period=" + duration_text(communicator.period / 2);
  }

  void wcets() {
    if (check_.result.verdict == Verdict::schedulable) return;
    std::size_t count = 0;
    for (const WcetCut& cut : wcet_cuts(system_of(graph()), budget_)) {
      if (found_.size() >= max_remedies || ++count > 2) return;
      const Task& task = graph().tasks[cut.task];
      const std::string wcet = duration_text(cut.wcet);
      add({"a 'wcet' of " + wcet + " for '" + task.name + "', which has " + duration_text(*task.wcet),
           {"tasks." + task.name + ".wcet=" + wcet}});
    }
  }

  const std::shared_ptr<const Source>& source_;
  const Overrides& overrides_;
  const Registry& registry_;
  const GraphCheck& check_;
  const Loads& loads_;
  Budget& budget_;
  const std::optional<std::size_t> overfull_;
  Remedy beside_;
  std::vector<Remedy> found_;
};

}  // namespace

std::vector<Remedy> find_remedies(const std::shared_ptr<const Source>& source, const Overrides& overrides,
                                  const Registry& registry, const GraphCheck& found, const Loads& loads,
                                  Budget& budget) {
  const bool stated =
      std::all_of(found.graph->tasks.begin(), found.graph->tasks.end(), [](const Task& t) { return t.wcet; });
  if (!stated || found.graph->tasks.empty()) return {};
  if (found.result.verdict == Verdict::schedulable && chains_hold(found) == true) return {};
  return Search(source, overrides, registry, found, loads, budget).run();
}

}  // namespace jarol::analysis
