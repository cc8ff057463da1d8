#include "tools/commands/run/threads_report.h"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace jarol::tools {

std::string to_text(const Graph& graph, const JarolCore& core) {
  const ThreadsReport& threads = core.threads_report();
  const auto us = [](Duration of) { return static_cast<double>(of.count()) * 1e-3; };
  const auto line = [&](const char* what, const Histogram& of, const char* after) {
    return fmt::format("  {:<10}  {:.1f} us {}median, {:.1f} us 99 %, {:.1f} us worst\n", what, us(of.percentile(0.5)),
                       after, us(of.percentile(0.99)), us(of.max()));
  };
  std::string text = fmt::format("  rounds      {} of {}\n", threads.rounds, duration_text(core.period())) +
                     line("outputs", threads.round, "after the tick ") + line("lateness", threads.lateness, "");
  std::size_t width = 4;
  for (const Task& task : graph.tasks) width = std::max(width, task.name.size());
  text += fmt::format("  {:<{}}  {:>11}  {:>10}  {:>10}\n", "task", width, "activations", "99 % us", "worst us");
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Histogram& execution = threads.execution[i];
    text += fmt::format("  {:<{}}  {:>11}  {:>10.1f}  {:>10.1f}\n", graph.tasks[i].name, width, execution.count(),
                        us(execution.percentile(0.99)), us(execution.max()));
  }
  if (threads.core_busy > 0) text += fmt::format("  core        {} ticks found it at work\n", threads.core_busy);
  if (threads.unawaited_ticks > 0)
    text += fmt::format("  sensors     {} ticks found their thread at work\n", threads.unawaited_ticks);
  return text;
}

nlohmann::ordered_json to_json(const Graph& graph, const JarolCore& core) {
  const ThreadsReport& threads = core.threads_report();
  auto tasks = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Histogram& execution = threads.execution[i];
    tasks[graph.tasks[i].name] = {{"activations", execution.count()},
                                  {"execution_99_ns", execution.percentile(0.99).count()},
                                  {"execution_max_ns", execution.max().count()}};
  }
  return {{"period_ns", core.period().count()},
          {"rounds", threads.rounds},
          {"core_busy", threads.core_busy},
          {"unawaited_ticks", threads.unawaited_ticks},
          {"outputs_50_ns", threads.round.percentile(0.5).count()},
          {"outputs_99_ns", threads.round.percentile(0.99).count()},
          {"outputs_max_ns", threads.round.max().count()},
          {"lateness_50_ns", threads.lateness.percentile(0.5).count()},
          {"lateness_99_ns", threads.lateness.percentile(0.99).count()},
          {"lateness_max_ns", threads.lateness.max().count()},
          {"tasks", tasks}};
}

}  // namespace jarol::tools
