#include "tools/commands/check/check_report.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "graph/analysis/policies.h"
#include "graph/analysis/system.h"
#include "graph/text/escape.h"
#include "tools/commands/check/chain_lines.h"
#include "tools/commands/check/check_words.h"
#include "tools/commands/check/gantt.h"

namespace jarol::tools {
namespace {

// To the microsecond, unless that would leave something out.
std::string milliseconds(Duration time) {
  const std::int64_t ns = time.count();
  const double ms = static_cast<double>(ns) * 1e-6;
  if (ns % 1000 == 0) return fmt::format("{:.3f} ms", ms);
  if (std::abs(ns) < 1000) return fmt::format("{} ns", ns);
  return std::abs(ns) < 1'000'000 ? fmt::format("{:.3f} us", ms * 1e3) : fmt::format("{:.6f} ms", ms);
}

std::string platform_text(const Platform& platform) {
  const std::string cores = platform.cores == 1 ? "one core" : std::to_string(platform.cores) + " cores";
  return cores + " (" + std::string(analysis::policy_of(platform).name) + ")";
}

// Where no run shows the miss, as offsets and jitter may be worse: the task that exceeds its deadline by most.
std::string worst_response(const CheckReport& r) {
  std::optional<std::size_t> worst;
  Duration over{};
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i) {
    if (!r.result.response[i]) continue;
    const Duration late = *r.result.response[i] - r.graph->tasks[i].deadline;
    if (late <= over) continue;
    over = late;
    worst = i;
  }
  if (!worst) return "";
  const Task& t = r.graph->tasks[*worst];
  return fmt::format(" core {}: task '{}' responds within {} at {}, deadline {} (late {}{})",
                     r.result.core[*worst].value_or(0), t.name, milliseconds(*r.result.response[*worst]),
                     r.result.exact[*worst] ? "worst" : "max", milliseconds(t.deadline),
                     r.result.exact[*worst] ? "" : "by at most ", milliseconds(over));
}

// Schedulable or not, a chain may be too slow: that stands in the first line too. Upper bounds prove no more than that
// it may be.
std::string broken_limits(const CheckReport& r) {
  std::string is, may_be;
  for (const analysis::CheckedChain& c : r.chains) {
    std::string& names = c.latency.exact ? is : may_be;
    if (holds(c) != true) names += (names.empty() ? "'" : ", '") + c.chain.name + "'";
  }
  if (!is.empty()) is = ", BUT A LIMIT IS BROKEN by chain " + is;
  if (!may_be.empty()) may_be = (is.empty() ? ", BUT A LIMIT" : ", AND ONE") + (" MAY BE BROKEN by chain " + may_be);
  return is + may_be;
}

// The plainest reason of all: of all cores, or of one for the tasks that state it.
std::string overload_text(const Graph& graph) {
  const analysis::System system = analysis::system_of(graph);
  analysis::TaskModels models = system.models;
  std::string of = system.cores == 1 ? "one core" : fmt::format("{} cores", system.cores);
  if (compare_utilisation(models, system.cores) != std::strong_ordering::greater) {
    const auto core = analysis::overfull_core(system);
    if (!core) return "";
    of = fmt::format("core {}", *core);
    models.clear();
    for (std::size_t i = 0; i < system.models.size(); ++i)
      if (system.core[i] == static_cast<std::int64_t>(*core)) models.push_back(system.models[i]);
  }
  return fmt::format(" utilisation {:.2f}% of {}: there is more to do than time", 100 * analysis::utilisation(models),
                     of);
}

std::string headline(const CheckReport& r) {
  switch (r.result.verdict) {
    case analysis::Verdict::schedulable:
      return fmt::format("{}: SCHEDULABLE on {}, {}{}: {}\n", printable(r.file), platform_text(r.graph->platform),
                         word_of(r.result.evidence), broken_limits(r), r.result.reason);
    case analysis::Verdict::unknown:
      return fmt::format("{}: UNKNOWN on {}{}: {}\n", printable(r.file), platform_text(r.graph->platform),
                         broken_limits(r), r.result.reason);
    case analysis::Verdict::not_schedulable: break;
  }
  std::string text = printable(r.file) + ": NOT SCHEDULABLE";
  if (const std::string overload = overload_text(*r.graph); !overload.empty())
    text += overload + (r.result.late || !worst_response(r).empty() ? ";" : "");
  if (r.result.late) {
    const analysis::DeadlineMiss& m = *r.result.late;
    // under a global policy it is no single core's
    if (r.result.core_at_fault || analysis::policy_of(r.graph->platform).keeps_core)
      text += fmt::format(" core {}:", r.result.core_at_fault.value_or(0));
    text += fmt::format(" task '{}' activation {} (released {}) {} {}, deadline {} (late {}{})",
                        r.graph->tasks[m.task].name, m.activation, milliseconds(m.release),
                        m.ended ? "finishes" : "has not finished by", milliseconds(m.finish), milliseconds(m.deadline),
                        m.ended ? "" : "more than ", milliseconds(m.finish - m.deadline));
  }
  if (!r.result.late) text += worst_response(r);
  return text + "\n  " + word_of(r.result.evidence) + ": " + r.result.reason + " on " +
         platform_text(r.graph->platform) + "\n";
}

// The verdict is of stated times; where a measurement breaks one of them, that comes first.
std::string measured_headline(const CheckReport& r) {
  const Task* const task = longer_than_stated(r);
  if (task == nullptr) return "";
  const Duration max = r.measured->tasks[static_cast<std::size_t>(task - r.graph->tasks.data())].max;
  return fmt::format("{}: A WCET DOES NOT HOLD HERE: task '{}' took {}, its 'wcet' is {}; with the times as stated:\n",
                     printable(r.file), task->name, duration_text(max), duration_text(*task->wcet));
}

// Whom the late activation may wait for while nothing runs on its core.
std::string awaited_by(const CheckReport& r, const analysis::System& system) {
  const std::size_t late = r.result.late->task;
  std::string names;
  for (const auto& [producer, reader] : system.follows)
    if (reader == late && r.result.core[producer] != r.result.core[late])
      names += (names.empty() ? " for '" : ", '") + r.graph->tasks[producer].name + "'";
  return names;
}

// Who ran how long while the late activation waited and ran, as far as that is known.
std::string shares_text(const CheckReport& r) {
  if (!r.result.late) return "";
  const analysis::DeadlineMiss& late = *r.result.late;
  const analysis::System system = analysis::system_of(*r.graph);
  const Duration from = known_from(r.result);
  std::vector<Duration> ran(r.graph->tasks.size());
  Duration blocked{}, idle = late.finish - from;
  for (const analysis::Slice& s : r.result.slices) {
    if (s.end <= from) continue;
    const Duration begin = std::max(s.begin, from);
    // in a table each piece begins with what holds it up
    const Duration blocking = system.policy.urgency == Urgency::turn ? system.models[s.task].blocking : Duration{};
    const Duration held = std::clamp(s.begin + blocking - begin, Duration{}, s.end - begin);
    ran[s.task] += s.end - begin - held;
    blocked += held;
    idle -= s.end - begin;
  }
  std::string parts;
  const auto add = [&](const std::string& what, Duration time) {
    if (time > Duration{}) parts += (parts.empty() ? "" : " + ") + what + " " + duration_text(time);
  };
  for (std::size_t i = 0; i < ran.size(); ++i) add(r.graph->tasks[i].name, ran[i]);
  add("blocking", blocked);
  if (system.policy.keeps_core && !parts.empty()) add("waiting" + awaited_by(r, system), idle);
  std::string text =
      fmt::format("  from release to {} {}", late.ended ? "end" : "there", duration_text(late.finish - late.release));
  if (from > late.release) text += fmt::format(", of which the last {}", duration_text(late.finish - from));
  // where the test that finds it late draws no time line
  return text + (parts.empty() ? "\n" : ": " + parts + "\n");
}

// Who needs how much in the interval that is too short.
std::string demand_text(const CheckReport& r) {
  if (!r.result.demand) return shares_text(r);
  const analysis::Demand& d = *r.result.demand;
  const bool longer = d.demand == Duration::max();
  std::string text = fmt::format("  in an interval of {} work of {}{} is due", duration_text(d.length),
                                 longer ? "more than " : "", duration_text(d.demand));
  if (d.blocking > Duration{}) text += fmt::format(", and {} can hold it up", duration_text(d.blocking));
  // with what the platform adds to each activation
  const analysis::System system = analysis::system_of(*r.graph);
  std::string parts;
  for (std::size_t i = 0; i < d.releases.size(); ++i)
    if (d.releases[i] > 0)
      parts += fmt::format("{}{} {}x{}", parts.empty() ? "" : " + ", r.graph->tasks[i].name, d.releases[i],
                           duration_text(system.models[i].wcet));
  return text + ": " + parts + "\n";
}

// With what the platform adds to each activation.
double use_of(const analysis::System& system, std::size_t task) {
  const analysis::TaskModel& model = system.models[task];
  return static_cast<double>(model.wcet.count()) / static_cast<double>(model.period.count());
}

std::string task_table(const CheckReport& r) {
  const analysis::System system = analysis::system_of(*r.graph);
  std::size_t width = 4;
  for (const Task& t : r.graph->tasks) width = std::max(width, t.name.size());
  const bool cores = r.graph->platform.cores > 1;
  std::string text =
      fmt::format("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>6}  {:>9}  {:>9}{}\n", "task", width, "period", "offset",
                  "deadline", "wcet", "use", "response", "slack", cores ? "  core" : "");
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i) {
    const Task& t = r.graph->tasks[i];
    const std::string use = t.wcet ? fmt::format("{:.2f}%", 100 * use_of(system, i)) : "-";
    const auto& response = r.result.response[i];
    const bool exact = r.result.exact[i];
    text +=
        fmt::format("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>6}  {:>9}  {:>9}", t.name, width, duration_text(t.period),
                    duration_text(t.offset), duration_text(t.deadline), t.wcet ? duration_text(*t.wcet) : "-", use,
                    response ? (exact ? "" : "<=") + duration_text(*response) : "-",
                    response ? (exact ? "" : ">=") + duration_text(t.deadline - *response) : "-");
    if (cores) text += r.result.core[i] ? fmt::format("  {:>4}", *r.result.core[i]) : "     -";
    text += "\n";
  }
  return text;
}

// What the column 'response' has.
std::string response_line(const CheckReport& r) {
  bool bounds = false;
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i)
    bounds = bounds || (r.result.response[i] && !r.result.exact[i]);
  return fmt::format("  utilisation {:.2f}%; a task's response is its longest time from arrival to end{};\n",
                     100 * r.result.utilisation,
                     bounds ? "; after '<=' it is no longer than that, and may be shorter" : "");
}

std::string core_lines(const CheckReport& r) {
  std::string text;
  // where no task belongs to a core they only have a sum
  if (std::none_of(r.result.core.begin(), r.result.core.end(), [](const auto& core) { return core.has_value(); })) {
    const auto all = static_cast<double>(r.graph->platform.cores);
    return all > 1
               ? fmt::format("  all {} cores: utilisation {:.2f}% of {}%\n", all, 100 * r.result.utilisation, 100 * all)
               : "";
  }
  const analysis::System system = analysis::system_of(*r.graph);
  for (std::size_t c = 0; r.graph->platform.cores > 1 && c < static_cast<std::size_t>(r.graph->platform.cores); ++c) {
    double use = 0;
    for (std::size_t i = 0; i < r.graph->tasks.size(); ++i)
      if (r.result.core[i] == c && r.graph->tasks[i].wcet) use += use_of(system, i);
    text += fmt::format("  core {}: utilisation {:.2f}%, idle {:.2f}%\n", c, 100 * use, 100 * (1 - use));
  }
  return text;
}

// To six digits, none of them rounded up: what is printed has to hold.
double rounded_down(double factor) {
  const double unit = std::pow(10.0, std::floor(std::log10(factor)) - 5);
  return std::floor(factor / unit + 1e-6) * unit;
}

std::string sensitivity_lines(const CheckReport& r) {
  std::string text;
  if (r.sensitivity && r.sensitivity->alpha) {
    text += fmt::format("  all WCETs together may be {:.6g} times as long", rounded_down(*r.sensitivity->alpha));
    if (r.sensitivity->binding) {
      const std::size_t i = *r.sensitivity->binding;
      text += fmt::format("; alone, '{}' has least room: up to {}", r.graph->tasks[i].name,
                          duration_text(*r.sensitivity->max_wcet[i]));
    }
    text += "\n";
  }
  for (std::size_t i = 0; i < r.remedies.size(); ++i)
    text += fmt::format("  {} {}\n", i == 0 ? "it would hold with" : "                or", r.remedies[i].text);
  return text;
}

}  // namespace

std::string to_text(const CheckReport& r) {
  std::string text = measured_headline(r) + headline(r) + demand_text(r) + gantt_text(*r.graph, r.result) +
                     task_table(r) + core_lines(r) + response_line(r);
  text += "  assumed: " + assumption(*r.graph) + "\n" + sensitivity_lines(r) + chain_lines(r) + late_outs(*r.graph);
  if (r.result.verdict == analysis::Verdict::unknown &&
      std::any_of(r.graph->tasks.begin(), r.graph->tasks.end(), [](const Task& t) { return !t.wcet; }))
    text +=
        "  'check --measure' measures how long they take here, 'check --write' writes that into the file with a "
        "margin\n";
  return text;
}

}  // namespace jarol::tools
