// jarol doctor: what this machine allows a program with deadlines, and how late it wakes one.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "distributers/session/guard.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "runtime/machine/arithmetic.h"
#include "runtime/machine/machine.h"
#include "runtime/machine/real_clock.h"
#include "tools/commands/commands.h"
#include "tools/report/command_line.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

using namespace std::chrono_literals;

constexpr Duration probe_period = 1ms;

struct DoctorOptions {
  std::string duration = "1s";
  bool json = false;
};

struct Lateness {
  std::string scheduler;
  Histogram of;
};

nlohmann::ordered_json permission(const std::string& refused) {
  nlohmann::ordered_json json{{"permitted", refused.empty()}};
  if (!refused.empty()) json["refused"] = refused;
  return json;
}

void print_json(const MachineFacts& m, const Arithmetic& a, const std::string& guardian,
                const std::vector<Lateness>& measured) {
  nlohmann::ordered_json whole{
      {"schema", "jarol.doctor/2"},
      {"kernel", m.kernel},
      {"preempt_rt", m.preempt_rt},
      {"cpus", m.cpus},
      {"usable_cpus", m.usable},
      {"affinity", permission(m.affinity_refused)},
      {"sched_fifo", permission(m.fifo_refused)},
      {"lock_memory", permission(m.lock_refused)},
      {"guardian", permission(guardian)},
      {"default_timer_slack_ns", m.default_slack.count()},
      {"min_timer_slack_ns", m.min_slack.count()},
      {"clock_resolution_ns", m.resolution.count()},
      {"governors", m.governors},
      {"math", {{"foreign_calls", a.foreign_calls}, {"blas", a.blas}, {"blas_varies", a.blas_varies}}},
      {"period_ns", probe_period.count()},
      {"lateness", nlohmann::ordered_json::array()}};
  whole["sched_fifo"]["highest_priority"] = m.fifo_priority;
  for (const Lateness& l : measured)
    whole["lateness"].push_back({{"scheduler", l.scheduler},
                                 {"count", l.of.count()},
                                 {"p50_ns", l.of.percentile(0.5).count()},
                                 {"p99_ns", l.of.percentile(0.99).count()},
                                 {"worst_ns", l.of.max().count()}});
  std::cout << json_line(whole);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void print_text(const MachineFacts& m, const Arithmetic& a, const std::string& guardian,
                const std::vector<Lateness>& measured) {
  const auto line = [](const std::string& what, const std::string& text) {
    std::cout << fmt::format("  {:<13} {}\n", what, text);
  };
  const auto or_refused = [](const std::string& refused, const std::string& permitted, const std::string& remedy) {
    return refused.empty() ? permitted : "refused: " + refused + "; " + remedy;
  };
  std::cout << "this machine\n";
  line("kernel", m.kernel + (m.preempt_rt ? ", PREEMPT_RT" : ", without PREEMPT_RT"));
  line("CPUs", fmt::format("{}, of which {} may be used", m.cpus, m.usable.size()));
  line("affinity",
       or_refused(m.affinity_refused, "threads can be bound to CPUs", "threads run where the kernel puts them"));
  line("SCHED_FIFO", or_refused(m.fifo_refused, fmt::format("permitted up to priority {}", m.fifo_priority),
                                "other programs may delay tasks; " + std::string(permit_fifo)));
  line("memory", or_refused(m.lock_refused, "can be locked",
                            "a page fault may delay a task; " + std::string(permit_locked_memory)));
  line("guardian", or_refused(guardian, "can be started: it hands over 'safe' after a crash",
                              "after a crash the last commands stay in force"));
  line("timer slack", fmt::format("{}, can be set to {}", duration_text(m.default_slack), duration_text(m.min_slack)));
  line("clock", fmt::format("CLOCK_MONOTONIC with a resolution of {}", duration_text(m.resolution)));
  line("governor", m.governors.empty() ? "the machine does not report" : joined(m.governors));
  line("sin, exp, ...",
       a.foreign_calls.empty() ? "this program's own, for all libraries too" : joined(a.foreign_calls));
  line("BLAS", a.blas.empty() ? "none is loaded" : a.blas + (a.blas_varies ? ", which picks by processor" : ""));
  std::cout << "lateness of bare sleeps at 1 kHz\n";
  for (const Lateness& l : measured)
    line(l.scheduler == "fifo" ? "SCHED_FIFO" : "ordinary",
         fmt::format("p50 {}  p99 {}  worst {}  of {}", duration_text(l.of.percentile(0.5)),
                     duration_text(l.of.percentile(0.99)), duration_text(l.of.max()), l.of.count()));
}

int examine(const DoctorOptions& options) {
  Duration duration{};
  std::string wrong = parse_duration(options.duration, duration);
  if (wrong.empty() && duration < probe_period) wrong = "is less than one period of 1ms";
  if (!wrong.empty()) throw InputError("--for: '" + options.duration + "' " + wrong);
  const MachineFacts facts = find_machine_facts();
  std::vector<Lateness> measured;
  if (const auto ordinary = measure_lateness(probe_period, duration, {})) measured.push_back({"other", *ordinary});
  if (facts.fifo_priority > 0)
    if (const auto fifo = measure_lateness(probe_period, duration, facts.fifo_priority))
      measured.push_back({"fifo", *fifo});
  const Arithmetic arithmetic = find_arithmetic();
  const std::string guardian = guardian_refused();
  options.json ? print_json(facts, arithmetic, guardian, measured) : print_text(facts, arithmetic, guardian, measured);
  return exit_good;
}

}  // namespace

void add_doctor(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  Command* command = line.add_subcommand(
      "doctor",
      "Shows what this machine allows a program with deadlines, and how late its bare sleeps at 1 kHz end:\n"
      "on the ordinary scheduler, and with SCHED_FIFO where that is permitted");
  command->add_option("--for", options->duration, "How long each of them is measured, as in 10s; default 1s");
  command->add_flag("--json", options->json, "One JSON object instead of text");
  command->callback([options, &exit_code] { exit_code = examine(*options); });
}

}  // namespace jarol::tools
