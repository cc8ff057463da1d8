#include "distributers/session/real_time.h"

#include <sched.h>

#include <algorithm>

#include "distributers/session/errors.h"
#include "graph/analysis/chains.h"
#include "graph/analysis/check.h"
#include "graph/analysis/policies.h"
#include "graph/language/problems.h"
#include "runtime/machine/machine.h"

namespace jarol {
namespace {

// "'table' and 'fixed_priority'"
std::string executed_policies() {
  std::string names;
  for (const Policy& policy : analysis::built_in_policies())
    if (policy.executed) names += (names.empty() ? "'" : " and '") + std::string(policy.name) + "'";
  return names;
}

bool has_deep_input(const Graph& graph) {
  return std::any_of(graph.tasks.begin(), graph.tasks.end(),
                     [](const Task& task) { return task.task_class->in->is_deep(); });
}

}  // namespace

void require_executed(const std::string& name, const Graph& graph, const RunWords& words) {
  const Policy& policy = analysis::policy_of(graph.platform);
  if (!policy.executed)
    throw NotExecutable("'" + name + "' has the policy '" + std::string(policy.name) + "'; the real clock executes " +
                        executed_policies() + "; choose one by " + words.set + " platform.policy=table");
}

std::vector<analysis::TaskThread> threads_for(const std::string& name, const Graph& graph, RealTimeOptions& options,
                                              const RunWords& words) {
  require_executed(name, graph, words);
  const bool by_priority = analysis::policy_of(graph.platform).urgency == Urgency::priority;
  // a value of changing size goes from task to task by one thread alone
  if (!by_priority && graph.platform.cores == 1 && (has_deep_input(graph) || !analysis::is_due_meanwhile(graph)))
    return {};
  std::vector<analysis::TaskThread> threads = analysis::threads_of(graph);
  std::size_t cores = 0, levels = 0;
  for (const analysis::TaskThread& thread : threads) {
    cores = std::max(cores, thread.core + 1);
    levels = std::max(levels, thread.urgency + 1);
  }
  const int needed = static_cast<int>(levels) + 1;  // and one above, for the thread that keeps the time
  const int max = sched_get_priority_max(SCHED_FIFO);
  if (needed > max)
    throw NotExecutable("'" + name + "' takes " + std::to_string(needed) + " priorities and SCHED_FIFO has " +
                        std::to_string(max) + "; use more cores, or choose " + words.set + " platform.policy=table");
  if (options.priority && *options.priority < needed)
    throw NotExecutable(words.priority + " " + std::to_string(*options.priority) + ": the tasks of '" + name +
                        "' take " + std::to_string(levels) + " priorities below it; choose " + std::to_string(needed) +
                        " or more");
  if (!options.priority && by_priority) options.priority = needed;
  const std::vector<int> usable = options.cpus.empty() ? find_machine_facts().usable : options.cpus;
  if (usable.size() < cores)
    throw NotExecutable("'" + name + "' has tasks on " + std::to_string(cores) + " cores; " +
                        (options.cpus.empty() ? "this machine lets it use " : words.cpus + " names ") +
                        std::to_string(usable.size()) + (usable.size() == 1 ? " CPU" : " CPUs"));
  options.core_cpus.assign(usable.begin(), usable.begin() + static_cast<std::ptrdiff_t>(cores));
  return threads;
}

CheckFindings find_against(const Graph& graph) {
  const analysis::Result result = analysis::check(graph);
  CheckFindings found;
  const auto add = [&](const std::string& text) { found.against += (found.against.empty() ? "" : ", and ") + text; };
  if (result.verdict == analysis::Verdict::not_schedulable) add("is not schedulable: " + result.reason);
  if (result.verdict == analysis::Verdict::unknown) found.unknown = result.reason;
  // the real clock keeps the offsets
  std::optional<Graph> given;
  if (graph.platform.phasing != Phasing::given) given.emplace(graph).platform.phasing = Phasing::given;
  analysis::Budget budget{analysis::max_steps_of_chains};
  for (const Chain& chain : graph.chains) {
    const auto latency = analysis::latency_of(given ? *given : graph, chain.path, budget);
    const auto broken = analysis::broken_limits(chain, latency);
    if (broken.empty()) continue;
    if (latency.exact)
      add("breaks a limit of chain '" + chain.name + "': " + list_of(broken));
    else
      found.unknown += (found.unknown.empty() ? "chain '" : "; chain '") + chain.name +
                       "' may break a limit, by upper bounds: " + list_of(broken);
  }
  return found;
}

void require_executable(const std::string& name, const Graph& graph, const RunOptions& options) {
  require_executed(name, graph, options.words);
  const CheckFindings found = find_against(graph);
  if (!found.against.empty() && !options.force)
    throw NotSchedulable("'" + name + "' " + found.against + "; 'jarol check' says more, " + options.words.force +
                         " runs it all the same");
  if (!found.against.empty() && options.note_force) options.note("run by force: '" + name + "' " + found.against);
  if (!found.unknown.empty()) options.note("whether this graph can be scheduled is not known: " + found.unknown);
}

void take_priority(std::optional<int> priority) {
  if (!priority) return;
  sched_param parameter{};
  parameter.sched_priority = *priority;
  sched_setscheduler(0, SCHED_FIFO, &parameter);
}

void take_priority_above(std::optional<int> priority) {
  if (priority) take_priority(std::min(*priority + 1, sched_get_priority_max(SCHED_FIFO)));
}

}  // namespace jarol
