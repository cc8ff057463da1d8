// jarol run: a graph on the virtual clock or in real time.
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/executor.h"
#include "tools/command_line.h"
#include "tools/commanded.h"
#include "tools/commands/commands.h"
#include "tools/interrupt.h"
#include "tools/linked.h"
#include "tools/load_graph.h"
#include "tools/plot_svg.h"
#include "tools/progress.h"
#include "tools/real_time.h"
#include "tools/run_on_threads.h"
#include "tools/told_changes.h"
#include "tools/told_faults.h"
#include "tools/trace_csv.h"
#include "tools/value_json.h"
#include "tools/whole_file.h"

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
  std::string trace;
  std::string plot;
};

void require_clock(const Options& options, const Loaded& loaded) {
  if (options.clock == "real") return;
  if (const Distributer* distributer = find_in_real_time(loaded))
    throw std::invalid_argument("distributer '" + distributer->name +
                                "' has a link to what goes on by itself; run it with --clock real");
}

// --for, else the end of the longest mission; on the real clock a graph without one runs until it is interrupted.
Duration end_of_run(const Options& options, const Loaded& loaded) {
  Duration end{};
  if (!options.duration.empty()) {
    const std::string wrong = parse_duration(options.duration, end);
    if (!wrong.empty()) throw std::invalid_argument("--for: '" + options.duration + "' " + wrong);
    if (end <= Duration{}) throw std::invalid_argument("--for: '" + options.duration + "' is not above zero");
    return end;
  }
  for (const auto& channels : loaded.channels) end = std::max(end, channels->end().value_or(Duration{}));
  if (end == Duration{} && options.clock == "real") return Duration::max();
  if (end == Duration{})
    throw std::invalid_argument("'" + options.file +
                                "' has no mission that ends; say how long to run, as in --for 10s");
  return end;
}

std::vector<Panel> panels_of(const Graph& graph, const Plan& plan) {
  const auto output_of = [&](std::size_t communicator) {
    const std::string& name = graph.communicators[communicator].name;
    const auto at = std::lower_bound(plan.outputs.begin(), plan.outputs.end(), name,
                                     [](const Output& o, const std::string& n) { return o.name < n; });
    return static_cast<std::uint32_t>(at - plan.outputs.begin());
  };
  std::vector<Panel> panels;
  for (const Reported& r : find_reported(graph)) {
    Panel panel{r.title, r.leaf.unit, output_of(r.communicator), r.leaf, std::nullopt};
    if (r.command) panel.commanded = std::pair(output_of(r.command->communicator), r.command->leaf);
    panels.push_back(std::move(panel));
  }
  // no operator: the first outputs, as many as fit
  constexpr std::size_t most = 8;
  for (std::uint32_t i = 0; panels.empty() && i < plan.outputs.size(); ++i)
    for (const Leaf& leaf : leaves_of(*plan.outputs[i].type))
      if (!leaf.type->is_deep())
        panels.push_back({leaf.path.empty() ? plan.outputs[i].name : plan.outputs[i].name + "." + leaf.path, leaf.unit,
                          i, leaf, std::nullopt});
  if (panels.size() > most) panels.resize(most);
  return panels;
}

void print_text(const Options& options, const Graph& graph, const Executor& executor, const RealClock* clock,
                const ToldChanges& told, const std::vector<LinkReport>& links, double seconds, bool interrupted) {
  const Report& report = executor.report();
  const double simulated = static_cast<double>(report.simulated.count()) * 1e-9;
  const char* const ended_early = interrupted ? " (interrupted)" : "";
  if (clock != nullptr) {
    std::cout << fmt::format("{}: {} s in real time{}\n", graph.name, seconds_text(report.simulated), ended_early);
  } else {
    std::cout << fmt::format("{}: {} s on the virtual clock in {:.2f} s, {:.0f} times real time{}\n", graph.name,
                             seconds_text(report.simulated), seconds, simulated / seconds, ended_early);
  }
  std::cout << reached_text(graph, [&](std::size_t communicator) { return executor.last_value(communicator); });
  std::cout << fmt::format("  activations {}, instants {}\n  digest      0x{:016x}\n", report.activations,
                           report.instants, report.digest);
  for (const Task& task : graph.tasks)
    if (task.isolation == Isolation::weak)
      std::cout << "              nothing is claimed of the digest: task '" << task.name << "' is weakly isolated\n";
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    if (const PrivateHeap* heap = executor.plan().heaps[i].get())
      std::cout << "  heap        " << graph.tasks[i].name << ": at most " << heap->most_used() << " of "
                << heap->size() << " bytes in use\n";
  std::cout << told.to_text();
  if (clock != nullptr) std::cout << to_text(graph, *clock);
  for (const LinkReport& link : links) std::cout << to_text(link);
  std::cout << to_text(graph, executor.safe_commands());
  if (report.non_finite_inputs > 0)
    std::cout << "  " << report.non_finite_inputs << " values from outside were not finite and not taken\n";
  if (const StageTeam* team = executor.team())
    std::cout << "  workers     " << options.workers << ", " << team->shared() << " of "
              << team->shared() + team->alone() << " levels of tasks shared\n";
  if (!options.trace.empty()) std::cout << "  trace       " << options.trace << "\n";
  if (!options.plot.empty()) std::cout << "  picture     " << options.plot << "\n";
  std::cerr << told_faults(report);
}

bool has_weak_isolation(const Graph& graph) {
  return std::any_of(graph.tasks.begin(), graph.tasks.end(),
                     [](const Task& task) { return task.isolation == Isolation::weak; });
}

void print_json(const Graph& graph, const Executor& executor, const RealClock* clock, const ToldChanges& told,
                const std::vector<LinkReport>& links, double seconds) {
  const Report& report = executor.report();
  auto outputs = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.communicators.size(); ++i)
    if (graph.communicators[i].direction == Direction::out)
      outputs[graph.communicators[i].name] = to_json(*graph.communicators[i].type, executor.last_value(i));
  auto heaps = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    if (const PrivateHeap* heap = executor.plan().heaps[i].get())
      heaps[graph.tasks[i].name] = {{"size", heap->size()}, {"most_used", heap->most_used()}};
  const double simulated = static_cast<double>(report.simulated.count()) * 1e-9;
  nlohmann::ordered_json json{{"schema", "jarol.run/1"},
                              {"graph", graph.name},
                              {"clock", clock != nullptr ? "real" : "virtual"},
                              {"digest", fmt::format("0x{:016x}", report.digest)},
                              {"digest_claimed", !has_weak_isolation(graph)},
                              {"simulated_ns", report.simulated.count()},
                              {"wall_ns", static_cast<std::int64_t>(seconds * 1e9)},
                              {"real_time_factor", simulated / seconds},
                              {"activations", report.activations},
                              {"instants", report.instants},
                              {"faults", faults_to_json(report)},
                              {"fault_count", report.fault_count},
                              {"non_finite_inputs", report.non_finite_inputs},
                              {"safe_commands", to_json(graph, executor.safe_commands())},
                              {"told", told.to_json()},
                              {"heaps", heaps},
                              {"outputs", outputs}};
  if (clock != nullptr) json["real_time"] = to_json(graph, *clock);
  for (const LinkReport& link : links) json["links"].push_back(to_json(link));
  std::cout << json << "\n";
}

void start_clock(RealClock& clock, const Executor& executor) {
  std::vector<std::string> refusals = clock.prepare_thread();
  for (const std::string& refusal : executor.refusals())
    if (std::find(refusals.begin(), refusals.end(), refusal) == refusals.end()) refusals.push_back(refusal);
  for (const std::string& refusal : refusals) std::cerr << "note: " << refusal << "\n";
  clock.start();
}

// Options that would have no effect.
void require_effect(const Command& command, const Options& options) {
  const std::vector<std::string> of_real_clock{"--rt-priority", "--cpus", "--spin", "--force"};
  if (options.clock != "real")
    command.refuse(of_real_clock, "belongs to the real clock; add --clock real, or leave it out");
  if (options.concurrency != "threads") return;
  if (options.clock != "real") throw std::invalid_argument("--concurrency threads needs --clock real");
  command.refuse({"--trace", "--plot", "--workers", "--spin"}, "belongs to --concurrency exotasks");
  command.refuse({"--force"}, "belongs to --concurrency exotasks; whether threads come in time is not checked before");
}

int run(const Options& options) {
  require_apart({{"FILE", options.file}}, {{"--trace", options.trace}, {"--plot", options.plot}});
  Loaded loaded = load_graph(options.file, options.overrides, options.seed);
  const Graph& graph = *loaded.graph;
  const Duration end = end_of_run(options, loaded);
  require_clock(options, loaded);
  if (options.concurrency == "threads") return run_on_threads(loaded, end, options_of(options.real_time), options.json);
  // the plan gives trace and plot their outputs before the executor exists
  const Plan plan(graph);
  std::vector<std::unique_ptr<RecordSink>> sinks;
  if (!options.trace.empty()) sinks.push_back(std::make_unique<TraceCsv>(options.trace, plan.outputs));
  if (!options.plot.empty())
    sinks.push_back(std::make_unique<PlotSvg>(options.plot, graph.name, panels_of(graph, plan)));
  std::vector<RecordSink*> to;
  for (const auto& sink : sinks) to.push_back(sink.get());
  std::unique_ptr<Recorder> recorder = to.empty() ? nullptr : std::make_unique<Recorder>(to);
  std::optional<RealClock> clock;
  std::vector<analysis::TaskThread> threads;
  if (options.clock == "real") {
    if (options.workers > 1)
      throw std::invalid_argument("--workers belongs to the virtual clock; the real one goes by 'platform'");
    require_executable(options.file, graph, options.real_time);
    RealTimeOptions real_time = options_of(options.real_time);
    threads = threads_for(options.file, graph, real_time);
    clock.emplace(graph.tasks.size(), real_time);
  }
  ToldChanges told(graph);
  loaded.channels = told.listen(std::move(loaded.channels));
  std::vector<Channels*> channels = pointers_to(loaded.channels);
  Executor executor(graph, std::move(loaded.channels),
                    {.digest = true,
                     .recorder = recorder.get(),
                     .workers = options.workers,
                     .clock = clock ? &*clock : nullptr,
                     .threads = threads});
  Linked linked(std::move(channels));
  auto start = std::chrono::steady_clock::now();
  try {
    const Interruptible interruptible([&] { executor.interrupt(); });
    const bool shown = !options.json && isatty(STDERR_FILENO) != 0 && end != Duration::max();
    // its thread is made before this one gets the priority and the CPUs that threads made later would take after
    const Progress progress(shown, end, [&] { return executor.now(); });
    if (clock) start_clock(*clock, executor);
    start = std::chrono::steady_clock::now();
    executor.run_until(end);
  } catch (const std::runtime_error& error) {
    // a vehicle that is lost, or can't be simulated any further
    std::cerr << "error: at " << seconds_text(executor.now()) << " s: " << error.what() << "\n";
    return exit_unfinished;
  }
  linked.finish();
  if (recorder) recorder->close();
  const double seconds =
      std::max(1e-9, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  const bool interrupted = !executor.report().stopped && executor.now() < end;
  const RealClock* const real = clock ? &*clock : nullptr;
  options.json ? print_json(graph, executor, real, told, linked.reports(), seconds)
               : print_text(options, graph, executor, real, told, linked.reports(), seconds, interrupted);
  if (executor.report().stopped) return exit_unfinished;
  return interrupted ? exit_interrupted : exit_good;
}

}  // namespace

void add_run(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  Command* command = line.add_subcommand(
      "run",
      "Run a graph: on the virtual clock, as fast as possible and the same to the bit every time, or\n"
      "on the real clock.\n"
      "Exit code: 0 good, 1 refused by the real clock, 3 stopped by a fault, 2 bad input, 130 interrupted");
  command->add_option("FILE", options->file, "The graph, a YAML file")->required();
  command->add_option("--for", options->duration,
                      "How long, in logical time, as in 10s; default: until the mission ends");
  command
      ->add_option("--set", options->overrides.set, "Change a value: path=value, as in tasks.depth.parameters.kp=0.5")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
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
  command->add_option("--trace", options->trace, "Write every published value to this CSV file");
  command->add_option("--plot", options->plot, "Draw what was commanded and reached into this SVG file");
  command->callback([options, command, &exit_code] {
    try {
      require_effect(*command, *options);
      exit_code = run(*options);
    } catch (const NegativeVerdict& error) {
      std::cerr << "error: " << error.what() << "\n";
      exit_code = exit_negative;
    } catch (const std::invalid_argument& error) {
      std::cerr << "error: " << error.what() << "\n";
      exit_code = exit_input;
    }
  });
}

}  // namespace jarol::tools
