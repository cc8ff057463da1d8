#include "graph/analysis/execution_times.h"

#include <algorithm>

#include "graph/analysis/check.h"
#include "graph/text/errors.h"
#include "graph/values/seed.h"

namespace jarol::analysis {

ExecutionTimes::ExecutionTimes(const Graph& graph, std::uint64_t seed) {
  for (const Task& task : graph.tasks) {
    const Duration wcet = task.wcet.value_or(Duration{});
    tasks_.push_back({spread_seed(seed, "execution of " + task.name), {{wcet, wcet}}});
  }
}

ExecutionTimes ExecutionTimes::wcet(const Graph& graph) { return ExecutionTimes(graph); }

ExecutionTimes ExecutionTimes::random(const Graph& graph, std::uint64_t seed) {
  ExecutionTimes made(graph, seed);
  for (OfTask& task : made.tasks_) task.spans[0].min = Duration(1);
  return made;
}

bool ExecutionTimes::read_span(const Yaml& yaml, const std::string& subject, Span& span, Problems& problems) {
  constexpr std::string_view example = "; write it as in 80us or 20us..80us";
  if (yaml.kind != Yaml::Kind::scalar) {
    problems.add(yaml.where, subject + " needs a duration, not " + std::string(kind_name(yaml)) + std::string(example));
    return false;
  }
  const std::size_t dots = yaml.text.find("..");
  std::string wrong;
  const auto parse = [&](const std::string& text, Duration& to) {
    wrong = parse_duration(text, to);
    if (wrong.empty() && to < Duration{}) wrong = "is below zero";
    if (wrong.empty() && to > longest_duration) wrong = "is longer than ten years";
    return wrong.empty();
  };
  if (dots == std::string::npos) {
    if (parse(yaml.text, span.min)) span.max = span.min;
  } else if (parse(yaml.text.substr(0, dots), span.min) && parse(yaml.text.substr(dots + 2), span.max) &&
             span.max < span.min) {
    wrong = "ends below its begin";
  }
  if (wrong.empty()) return true;
  const bool says_how = wrong.find(';') != std::string::npos;
  problems.add(yaml.where, subject + ": '" + yaml.text + "' " + wrong + (says_how ? "" : std::string(example)));
  return false;
}

ExecutionTimes ExecutionTimes::read(const Graph& graph, const std::shared_ptr<const Source>& source, std::uint64_t seed,
                                    Problems& problems) {
  ExecutionTimes made(graph, seed);
  const std::size_t before = problems.size();
  const Yaml file = read_yaml(source, problems);
  if (problems.size() > before) return made;
  if (file.kind != Yaml::Kind::mapping) {
    problems.add(file.where, "execution times need a mapping of tasks, not " + std::string(kind_name(file)));
    return made;
  }
  std::vector<std::string> names;
  for (const Task& task : graph.tasks) names.push_back(task.name);
  for (const Yaml& child : file.children) {
    const auto at = std::lower_bound(names.begin(), names.end(), child.key);
    if (at == names.end() || *at != child.key) {
      problems.add(child.key_where, "there is no task '" + child.key + "'" + did_you_mean(child.key, names) +
                                        "; there are: " + list_of(names));
      continue;
    }
    const std::string subject = "execution time of task '" + child.key + "'";
    std::vector<Span>& spans = made.tasks_[static_cast<std::size_t>(at - names.begin())].spans;
    spans.clear();
    Span span;
    if (child.kind != Yaml::Kind::sequence) {
      if (read_span(child, subject, span, problems)) spans.push_back(span);
      continue;
    }
    if (child.children.empty()) problems.add(child.where, subject + " is an empty list; it needs one at least");
    for (const Yaml& each : child.children)
      if (read_span(each, subject, span, problems)) spans.push_back(span);
  }
  return made;
}

Duration ExecutionTimes::operator()(std::size_t task, std::int64_t activation) const {
  const OfTask& of = tasks_[task];
  const Span& span = of.spans[static_cast<std::size_t>(activation) % of.spans.size()];
  const auto width = static_cast<std::uint64_t>((span.max - span.min).count()) + 1;
  if (width <= 1) return span.min;
  const std::uint64_t drawn = digest::fold(of.seed ^ static_cast<std::uint64_t>(activation), digest::key(2));
  return span.min + Duration(static_cast<std::int64_t>(drawn % width));
}

Schedule schedule_of(const Graph& graph, ExecutionTimes times) {
  for (const Task& task : graph.tasks)
    if (!task.wcet) throw InputError("task '" + task.name + "' has no 'wcet', by which tasks are given to cores");
  System system = system_of(graph);
  if (!system.offsets_hold)
    throw InputError("'phasing: any' leaves open when tasks are released; state 'phasing: given'");
  std::vector<std::size_t> core;
  if (system.policy.keeps_core) {
    for (const auto& of_task : check(system).core) core.push_back(of_task.value_or(0));
  }
  std::vector<bool> skips;
  for (const Task& task : graph.tasks) skips.push_back(task.on_fault == OnFault::skip);
  return Schedule(std::move(system), std::move(core), std::move(skips), std::move(times));
}

}  // namespace jarol::analysis
