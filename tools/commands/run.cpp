// jarol run: a graph on the virtual clock or in real time.
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "distributers/session/graph_run.h"
#include "distributers/session/guard.h"
#include "distributers/session/rest_verdict.h"
#include "graph/text/escape.h"
#include "runtime/execute/executor_run.h"
#include "runtime/execute/log_end.h"
#include "tools/commands/commands.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"
#include "tools/report/json_line.h"
#include "tools/report/noted.h"
#include "tools/report/progress.h"
#include "tools/report/rest_report.h"
#include "tools/report/run_end.h"
#include "tools/report/told_faults.h"
#include "tools/run/apart.h"
#include "tools/run/checkpoints.h"
#include "tools/run/crash_line.h"
#include "tools/run/interrupt.h"
#include "tools/run/load_graph.h"
#include "tools/run/no_plugins.h"
#include "tools/run/prompt_line.h"
#include "tools/run/real_time.h"
#include "tools/run/record_options.h"
#include "tools/run/run_files.h"
#include "tools/run/run_on_threads.h"
#include "tools/run/run_report.h"
#include "tools/run/what_if.h"

namespace jarol::tools {
namespace {

struct Options {
  std::string file;
  Overrides overrides;
  std::string duration;
  std::uint64_t seed = 0;
  std::size_t workers = 1;
  std::string clock = "virtual";
  std::string concurrency = "exotasks";
  RealTimeArguments real_time;
  bool json = false;
  RunFileArguments files;
  CheckpointArguments checkpoints;
  RecordArguments recording;
  std::vector<std::string> what_if;
};

void require_clock(const Options& options, const Loaded& loaded) {
  if (options.clock == "real") return;
  if (const Distributer* distributer = find_in_real_time(loaded))
    throw std::invalid_argument("distributer '" + distributer->name +
                                "' has a link to what goes on by itself; run it with --clock real");
}

// --for, else the end of the longest mission; on the real clock a graph without one runs until it is interrupted.
Duration end_of_run(const Options& options, const Loaded& loaded) {
  if (!options.duration.empty()) return length_of("--for", options.duration);
  const Duration end = end_of_mission(pointers_to(loaded.channels));
  if (end == Duration{} && options.clock == "real") return Duration::max();
  if (end == Duration{})
    throw std::invalid_argument("'" + options.file +
                                "' has no mission that ends; say how long to run, as in --for 10s");
  return end;
}

std::string text_of(const std::vector<Save>& saves) {
  std::string text;
  for (const Save& save : saves) text += "  saved       at " + seconds_text(save.at) + " s to " + save.file + "\n";
  return text;
}

nlohmann::ordered_json json_of(const RunOutcome& outcome, const std::vector<Save>& saves, const WhatIfs& what_ifs) {
  auto json = to_json(outcome);
  if (outcome.begun > Duration{}) json["resumed_ns"] = outcome.begun.count();
  for (const Save& save : saves) json["saved"].push_back({{"instant_ns", save.at.count()}, {"file", save.file}});
  if (!what_ifs.outcomes().empty()) json["what_if"] = to_json(what_ifs.outcomes());
  return json;
}

void print(const Options& options, const RunOutcome& outcome, const std::vector<Save>& saves, const WhatIfs& what_ifs,
           bool written) {
  const Report& report = outcome.executor.report();
  if (options.json) {
    std::cout << json_line(json_of(outcome, saves, what_ifs));
    return;
  }
  if (outcome.clock != nullptr) {
    std::cout << fmt::format("{}: {} s in real time{}\n", printable(outcome.graph.name),
                             seconds_text(outcome.simulated), suffix_of(outcome.end));
  } else {
    const std::string from = outcome.begun > Duration{} ? ", from " + seconds_text(outcome.begun) + " s on," : "";
    std::cout << fmt::format("{}: {} s on the virtual clock{} in {:.2f} s, {:.0f} times real time{}\n",
                             printable(outcome.graph.name), seconds_text(outcome.simulated), from, outcome.seconds,
                             real_time_factor(outcome), suffix_of(outcome.end));
  }
  std::cout << to_text(outcome);
  std::cout << text_of(saves);
  if (written) std::cout << to_text(options.files);
  if (written) std::cout << to_text(options.recording);
  std::cout << to_text(column_of(outcome.executor, outcome.true_states, outcome.verdict), what_ifs.outcomes());
  std::cerr << told_faults(report);
}

void start_clock(RealClock& clock, const Executor& executor) {
  std::vector<std::string> refusals = clock.prepare_thread();
  for (const std::string& refusal : executor.refusals())
    if (std::find(refusals.begin(), refusals.end(), refusal) == refusals.end()) refusals.push_back(refusal);
  for (const std::string& refusal : refusals) std::cerr << "note: " << refusal << "\n";
  clock.start();
}

RecordingHeader header_of(const Options& options, const Graph& graph, Duration begin, Duration until,
                          Duration mission) {
  return {.graph = graph.name,
          .file = SourceSet::full_path(options.file),
          .overrides = options.overrides,
          .clock = options.clock,
          .begin = begin,
          .until = until,
          .mission = mission,
          .seed = options.seed};
}

// Options that would have no effect.
void require_effect(const Command& command, const Options& options) {
  const std::vector<std::string> of_real_clock{"--rt-priority", "--cpus", "--spin", "--force", "--no-guardian"};
  if (options.clock != "real")
    command.refuse(of_real_clock, "belongs to the real clock; add --clock real, or leave it out");
  require_effect(command, options.recording);
  if (options.concurrency != "threads") return;
  if (options.clock != "real") throw std::invalid_argument("--concurrency threads needs --clock real");
  command.refuse(
      {"--trace", "--trace-fill", "--trace-words", "--plot", "--signals", "--log", "--record", "--workers", "--spin"},
      "belongs to --concurrency exotasks");
  command.refuse({"--force"}, "belongs to --concurrency exotasks; whether threads come in time is not checked before");
}

// None of those that the command names replaces another.
void require_files_apart(const Options& options, const std::vector<Save>& saves) {
  std::vector<NamedFile> outputs{{"--trace", options.files.trace},
                                 {"--plot", options.files.plot},
                                 {"--log", options.recording.log},
                                 {"--record", options.recording.record}};
  for (const Save& save : saves) outputs.push_back({"--save", save.file});
  require_apart({{"FILE", options.file}, {"--resume", options.checkpoints.resume}}, outputs);
}

int run(Options options) {
  WhatIfs what_ifs(options.what_if);
  const std::vector<Save> saves = parse_saves(options.checkpoints.saves);
  require_files_apart(options, saves);
  std::optional<Checkpoint> resumed;
  if (!options.checkpoints.resume.empty())
    resumed = read_checkpoint(options.checkpoints.resume, options.overrides, options.seed);
  const SourceSet sources;
  Loaded loaded = load_graph(options.file, options.overrides, options.seed);
  const Graph& graph = *loaded.graph;
  const Duration begin = resumed ? resumed->instant() : Duration{}, end = end_of_run(options, loaded);
  if (end < begin)
    throw std::invalid_argument("the run ends at " + seconds_text(end) + " s, and goes on from " + seconds_text(begin) +
                                " s; say until when, as in --for 100s");
  require_clock(options, loaded);
  what_ifs.prepare(graph, options.file, options.overrides, options.seed, options.workers, end);
  if (options.concurrency == "threads") return run_on_threads(loaded, end, options.real_time, options.json);
  const ReportsAside aside(options.files);
  RunFiles files(graph, options.files);
  const std::unique_ptr<RecordingWriter> log = make_recording(
      options.recording, header_of(options, graph, begin, end, end_of_mission(pointers_to(loaded.channels))), sources,
      graph);
  std::optional<RealClock> clock;
  std::optional<Guard> guard;
  std::vector<analysis::TaskThread> threads;
  if (options.clock == "real") {
    if (options.workers > 1)
      throw std::invalid_argument("--workers belongs to the virtual clock; the real one goes by 'platform'");
    require_executable(options.file, graph, options.real_time);
    RealTimeOptions real_time = options_of(options.real_time);
    threads = threads_for(options.file, graph, real_time);
    clock.emplace(graph.tasks.size(), real_time);
    guard.emplace(loaded, options.real_time.no_guardian ? "--no-guardian" : "", real_time.priority, print_note);
  }
  const CrashLine crash_line(graph, guard ? guard->process() : nullptr, options.recording.file());
  Noted noted(graph);
  std::vector<RecordSink*> looking_on = files.sinks();
  noted.add_to(looking_on);
  what_ifs.add_to(looking_on);
  if (log && log->publications() != nullptr) looking_on.push_back(log->publications());
  RunOrigin origin = origin_of(loaded, options.overrides, options.seed);
  GraphRun graph_run(std::move(loaded), {.sinks = looking_on,
                                         .workers = options.workers,
                                         .clock = clock ? &*clock : nullptr,
                                         .threads = threads,
                                         .log = log ? log->recorder() : nullptr});
  Executor& executor = graph_run.executor();
  graph_run.set_origin(std::move(origin));
  SavedRun saved(graph_run, noted, end);
  std::vector<Save> written_saves;
  for (const Save& save : saves)
    saved.add({"--save", save.at,
               [&written_saves, &save](const Checkpoint& checkpoint) {
                 checkpoint.write(save.file);
                 written_saves.push_back(save);
               },
               "'" + save.file + "' is not written"});
  what_ifs.add_to(saved);
  if (resumed) restore(graph_run, noted, *resumed, options.checkpoints.resume);
  const auto save_in_recording = [&](const Checkpoint& checkpoint) {
    const Archive::Bytes state = checkpoint.to_bytes();
    log->add_checkpoint(checkpoint.instant(), {reinterpret_cast<const char*>(state.data()), state.size()});
  };
  if (!options.recording.checkpoints.empty())
    saved.take_each(length_of("--record-checkpoints", options.recording.checkpoints), save_in_recording);
  saved.require_saveable(begin, end);
  const std::vector<Channels*>& channels = graph_run.channels();
  const bool steers =
      clock || std::any_of(channels.begin(), channels.end(), [](const Channels* c) { return c->outlives_run(); });
  const bool shown = !options.json && isatty(STDERR_FILENO) != 0 && end != Duration::max();
  let_writing_fail();
  const std::optional<Duration> rest = clock ? longest_rest(graph) : std::nullopt;
  const Interruptible interruptible([] {}, steers ? HaltKey::ends : HaltKey::halts,
                                    rest ? SecondSignal::hastens : SecondSignal::ends);
  std::optional<Progress> progress;
  // made before the priority that threads of links take after this one
  progress.emplace(shown, end, [&] { return executor.now(); });
  const std::optional<int> priority = clock ? clock->options().priority : std::nullopt;
  if (clock) take_priority(priority);
  graph_run.connect(print_note);
  if (log) log->open();
  if (log && resumed) save_in_recording(*resumed);
  take_priority_above(priority);
  auto start = std::chrono::steady_clock::now();
  ExecutorRun attended(executor, end, rest, [&](Duration begun) { graph_run.sinks().judge_before(begun); });
  const RunEnd run_end = attend(
      clock ? attended : saved,
      [&] {
        if (clock) start_clock(*clock, executor);
        if (guard) guard->arm();
        start = std::chrono::steady_clock::now();
      },
      Interruptible::wish, [&](const Ending& why) { write_promptly(printable_lines(rest_begins_text(graph, why))); },
      Interruptible::forbid_haste);
  progress.reset();
  // a link that is in use can't be finished, and what it has to be handed is left to the guardian
  if (run_end.links_are_free()) {
    graph_run.disconnect();
    if (guard) guard->close();
  }
  halt_if_asked(run_end);
  const double seconds =
      std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  const Report& report = executor.report();
  // the report is there whatever can't be written
  std::string unwritten, unseen;  // and why not all that was published has been seen
  std::string not_run;            // of what-ifs
  const auto attempt = [](std::string& wrong, const std::function<void()>& to_do) {
    try {
      to_do();
    } catch (const std::exception& error) { wrong = error.what(); }
  };
  if (run_end.hangs) {
    // a recording is good up to its last chunk
    if (!files.sinks().empty() || !graph.expectations.empty())
      unwritten = "trace and picture are not written, as the run has not ended";
  } else {
    attempt(not_run, [&] { what_ifs.run(graph_run.sinks(), files); });
    attempt(unwritten, [&] { graph_run.sinks().close(); });
    unseen = unwritten;
    if (log) attempt(unwritten, [&] { log->close(log_end_of(report)); });
    if (log) std::cerr << text_of_dropped(options.recording, *log);
  }
  const bool written = unwritten.empty();
  for (const std::string& lost : {saved.lost(), not_run})
    if (!lost.empty()) unwritten += (unwritten.empty() ? "" : "; ") + lost;
  const RunVerdict verdict = graph_run.judge(end, run_end, unseen);
  print(options,
        {.graph = graph,
         .executor = executor,
         .noted = noted,
         .end = run_end,
         .clock = clock ? &*clock : nullptr,
         .guard = guard ? &*guard : nullptr,
         .workers = options.workers,
         .links = graph_run.link_reports(),
         .seconds = seconds,
         .begun = begin,
         .simulated = report.simulated,
         .verdict = verdict,
         .true_states = run_end.hangs ? std::vector<TrueState>{} : find_true_states(graph, channels)},
        written_saves, what_ifs, written);
  std::cerr << errors_of(run_end, executor.now()) << failures_text(verdict);
  if (!unwritten.empty()) std::cerr << "error: " << unwritten << "\n";
  const int exit_code =
      exit_of({exit_code_of(run_end), exit_code_of(verdict), unwritten.empty() ? exit_good : exit_unfinished});
  if (run_end.hangs) end_at_once(exit_code);
  return exit_code;
}

}  // namespace

void add_run(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  Command* command = line.add_subcommand(
      "run",
      "Run a graph: on the virtual clock, as fast as possible and the same to the bit every time, or\n"
      "on the real clock.\n"
      "Exit code: 0 good, 1 not what 'expect' says, a vehicle that has crashed, capsized or sunk, or has not come to "
      "rest\n"
      "as 'at_end' says, too much left out by faults, or refused by the real clock, 2 bad input, 3 stopped by a "
      "fault,\n"
      "a lost vehicle, a task that does not end or a full disk, 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), "
      "SIGTERM");
  command->add_option("FILE", options->file, "The graph, a YAML file")->file({"yaml"})->required();
  command->add_option("--for", options->duration,
                      "How long, in logical time, as in 10s; default: until the mission ends");
  command
      ->add_option("--set", options->overrides.set, "Change a value: path=value, as in tasks.depth.parameters.kp=0.5")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
  add_no_plugins(*command, options->overrides);
  command->add_option("--seed", options->seed, "Seed of vehicles and distributers that have noise; default 0");
  command
      ->add_option("--workers", options->workers,
                   "Threads that run tasks; stages are shared where that pays, and the outcome is the same for any "
                   "number; default 1")
      ->in_range(1, 64);
  command->add_option("--clock", options->clock, "virtual (default) or real")->one_of({"virtual", "real"});
  command
      ->add_option(
          "--concurrency", options->concurrency,
          "exotasks (default), or threads: the same graph on ordinary threads, on the real clock, where nothing "
          "is claimed of the digest")
      ->one_of({"exotasks", "threads"});
  add_real_time_options(*command, options->real_time);
  command->add_flag("--json", options->json, "One JSON object instead of text");
  add_run_file_options(*command, options->files);
  add_checkpoint_options(*command, options->checkpoints);
  add_record_options(*command, options->recording);
  command
      ->add_option("--what-if", options->what_if,
                   "Go on from an instant with other parameters, too, and say from where and by how much that parts "
                   "from the run: 'at=30s set=tasks.depth.parameters.kp=0.2', with any number of set; may be given "
                   "more than once")
      ->one_value();
  command->callback([options, command, &exit_code] {
    require_effect(*command, *options);
    require_checkpoint_effect(*command, options->checkpoints, options->clock == "virtual");
    exit_code = run(*options);
  });
}

}  // namespace jarol::tools
