#include "tools/commands/run/run_options.h"

#include "distributers/session/graph_run.h"
#include "graph/text/errors.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/at_console.h"
#include "tools/commands/run/execution.h"
#include "tools/commands/run/guard_option.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"

namespace jarol::tools {

void add_run_options(Command& command, RunArguments& options) {
  command.add_option("FILE", options.file, "The graph, a YAML file")->file({"yaml"})->required();
  command.add_option("--for", options.duration,
                     "How long, in logical time, as in 10s; default: until the mission ends");
  command.add_option("--set", options.overrides.set, "Change a value: path=value, as in tasks.depth.parameters.kp=0.5")
      ->one_value();
  command.add_option("--profile", options.overrides.profile, "Use a profile of the file");
  add_no_plugins(command, options.overrides);
  command.add_option("--seed", options.seed, "Seed of vehicles and distributers that have noise; default 0");
  command
      .add_option("--workers", options.workers,
                  "Threads that run tasks; stages are shared where that pays, and the outcome is the same for any "
                  "number; default 1")
      ->in_range(1, max_workers);
  command.add_option("--clock", options.clock, "virtual (default) or real")->one_of({"virtual", "real"});
  command
      .add_option(
          "--concurrency", options.concurrency,
          "exotasks (default), or threads: the same graph on ordinary threads, on the real clock, where nothing "
          "is claimed of the digest")
      ->one_of({"exotasks", "threads"});
  add_real_time_options(command, options.real_time);
  command.add_flag("--json", options.json, "One JSON object instead of text");
  add_run_file_options(command, options.files);
  add_checkpoint_options(command, options.checkpoints);
  add_execution_option(command, options.execution);
  add_guard_option(command, options.guard);
  add_record_options(command, options.recording);
  command
      .add_option("--what-if", options.what_if,
                  "Go on from an instant with other parameters, too, and say from where and by how much that parts "
                  "from the run: 'at=30s set=tasks.depth.parameters.kp=0.2', with any number of set; may be given "
                  "more than once")
      ->one_value();
  add_console_options(command, options.console);
}

void require_effect(const Command& command, const RunArguments& options) {
  const std::vector<std::string> of_real_clock{"--rt-priority", "--cpus", "--spin", "--force", "--no-guardian"};
  if (options.clock != "real")
    command.refuse(of_real_clock, "belongs to the real clock; add --clock real, or leave it out");
  require_effect(command, options.recording);
  const bool virtual_clock = options.clock == "virtual";
  require_effect(command, options.console, virtual_clock);
  require_checkpoint_effect(command, options.checkpoints, virtual_clock);
  require_execution_effect(command, virtual_clock);
  require_guard_effect(command, options.guard, virtual_clock);
  if (options.concurrency != "threads") return;
  if (options.clock != "real") throw InputError("--concurrency threads needs --clock real");
  command.refuse({"--trace", "--trace-fill", "--trace-words", "--plot", "--signals", "--log", "--record", "--workers",
                  "--spin", "--console"},
                 "belongs to --concurrency exotasks");
  command.refuse({"--force"}, "belongs to --concurrency exotasks; whether threads come in time is not checked before");
}

Duration end_of_run(const RunArguments& options, const Loaded& loaded) {
  if (!options.duration.empty()) return length_of("--for", options.duration);
  const Duration end = end_of_mission(pointers_to(loaded.systems));
  // a run that needs the real clock has no end either: that it does not have that clock is said first
  if (end == Duration{} &&
      (options.clock == "real" || find_in_real_time(loaded) != nullptr || !operators_at_console(loaded).empty()))
    return Duration::max();
  if (end == Duration{})
    throw InputError("'" + options.file + "' has no mission that ends; say how long to run, as in --for 10s");
  return end;
}

void require_files_apart(const RunArguments& options, const std::vector<Save>& saves) {
  std::vector<NamedFile> outputs{{"--trace", options.files.trace},
                                 {"--plot", options.files.plot},
                                 {"--log", options.recording.log},
                                 {"--record", options.recording.record}};
  for (const Save& save : saves) outputs.push_back({"--save", save.file});
  require_apart({{"FILE", options.file}, {"--resume", options.checkpoints.resume}}, outputs);
}

}  // namespace jarol::tools
