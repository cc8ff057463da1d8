// jarol replay: a run again, from its log.
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/executor.h"
#include "tools/command_line.h"
#include "tools/commands/commands.h"
#include "tools/interrupt.h"
#include "tools/load_graph.h"
#include "tools/log_reader.h"
#include "tools/progress.h"
#include "tools/run_files.h"
#include "tools/run_report.h"
#include "tools/told_faults.h"
#include "tools/whole_file.h"

namespace jarol::tools {
namespace {

struct Options {
  std::string log;
  std::string file;
  Overrides overrides;
  bool json = false;
  RunFileArguments files;
};

// Without FILE the graph of the run, with the overrides of the run and those given here.
Loaded load(const Options& options, const LogHeader& header) {
  if (!options.file.empty()) return load_graph(options.file, options.overrides);
  Overrides overrides = header.overrides;
  if (!options.overrides.profile.empty()) overrides.profile = options.overrides.profile;
  overrides.set.insert(overrides.set.end(), options.overrides.set.begin(), options.overrides.set.end());
  return load_graph(header.file, overrides);
}

enum class Verdict { same, diverged, unknown };

// What can be said of the run beside the replay, if that was not interrupted.
Verdict judge(const Report& report, const LogReader& log) {
  if (!log.end()) return Verdict::unknown;
  return report.digest == log.end()->digest ? Verdict::same : Verdict::diverged;
}

std::string verdict_text(Verdict verdict, const Report& report, const LogReader& log) {
  const std::string run = "the run on the " + log.header().clock + " clock";
  if (verdict == Verdict::unknown)
    return fmt::format("  log         breaks off at byte {}, before {} s were whole; how the run ended is not known\n",
                       log.breaks_off(), seconds_text(log.covered()));
  if (verdict == Verdict::same) return "  same        as " + run + "\n";
  std::string text = fmt::format("  DIVERGED    from {}, whose digest was 0x{:016x}", run, log.end()->digest);
  if (report.fault_count != log.end()->faults)
    text += fmt::format(", with {} faults instead of {}", log.end()->faults, report.fault_count);
  return text + "\n";
}

nlohmann::ordered_json json_of(const RunOutcome& outcome, Verdict verdict, const LogReader& log, const Options& options,
                               std::size_t misses) {
  auto json = to_json(outcome);
  json["schema"] = "jarol.replay/1";
  json["log"] = {{"file", options.log},
                 {"clock", log.header().clock},
                 {"values", log.values()},
                 {"misses", misses},
                 {"digest", log.end() ? nlohmann::ordered_json(fmt::format("0x{:016x}", log.end()->digest))
                                      : nlohmann::ordered_json()}};
  json["verdict"] = verdict == Verdict::same ? "same" : verdict == Verdict::diverged ? "diverged" : "unknown";
  return json;
}

int replay(const Options& options) {
  LogReader log(options.log);
  const Loaded loaded = load(options, log.header());
  const Graph& graph = *loaded.graph;
  require_apart({{"LOG", options.log}, {"FILE", options.file.empty() ? log.header().file : options.file}},
                {{"--trace", options.files.trace}, {"--plot", options.files.plot}});
  const std::vector<Miss> misses = log.begin(graph);
  RunFiles files(graph, options.files);
  ToldChanges told(graph);
  Executor executor(graph, told.listen(replayed_channels(graph, log)),
                    {.digest = true, .recorder = files.recorder(), .misses = misses});
  const auto start = std::chrono::steady_clock::now();
  {
    const Interruptible interruptible([&] { executor.interrupt(); });
    const Progress progress(!options.json && isatty(STDERR_FILENO) != 0, log.covered(), [&] { return executor.now(); });
    executor.run_until(log.covered());
  }
  files.close();
  const bool interrupted = executor.now() < log.covered();
  if (!interrupted) log.require_all_taken();
  const double seconds =
      std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  const Report& report = executor.report();
  const RunOutcome outcome{.graph = graph,
                           .executor = executor,
                           .told = told,
                           .seconds = seconds,
                           .simulated = interrupted || !log.end() ? report.simulated : Duration(log.end()->simulated)};
  const Verdict verdict = interrupted ? Verdict::unknown : judge(report, log);
  if (options.json) {
    std::cout << json_of(outcome, verdict, log, options, misses.size()) << "\n";
  } else {
    std::cout << fmt::format("{}: replay of {} s in {:.2f} s, {:.0f} times real time{}\n", graph.name,
                             seconds_text(outcome.simulated), seconds, real_time_factor(outcome),
                             interrupted ? " (interrupted)" : "")
              << to_text(outcome)
              << fmt::format("  log         {} values from outside, {} activations late or left out\n", log.values(),
                             misses.size());
    std::cout << to_text(options.files);
    if (!interrupted) std::cout << verdict_text(verdict, report, log);
    std::cerr << told_faults(report);
  }
  if (interrupted) return exit_interrupted;
  return verdict == Verdict::same ? exit_good : verdict == Verdict::diverged ? exit_negative : exit_unfinished;
}

}  // namespace

void add_replay(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  Command* command =
      line.add_subcommand("replay",
                          "Run again what jarol run --log has logged: on the virtual clock, without vehicles or links, "
                          "with what came from\n"
                          "outside and what was late then. It is the same to the bit, or says that it is not.\n"
                          "Exit code: 0 the same, 1 diverged, 3 a log that breaks off, 2 bad input, 130 interrupted");
  command->add_option("LOG", options->log, "The log of a run")->required();
  command->add_option("FILE", options->file, "The graph; default: that of the run, with its profile and its --set");
  command
      ->add_option("--set", options->overrides.set, "Change a value: path=value, as in tasks.depth.parameters.kp=0.5")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
  command->add_flag("--json", options->json, "One JSON object instead of text");
  add_run_file_options(*command, options->files);
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace jarol::tools
