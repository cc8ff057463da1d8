// jarol console: a recording as people see it on a page.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "distributers/session/graph_run.h"
#include "distributers/session/recorded_truth.h"
#include "distributers/session/replay.h"
#include "runtime/plan/output.h"
#include "runtime/record/replayed_values.h"
#include "tools/commands/commands.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/interrupt.h"
#include "tools/console/console.h"
#include "tools/console/options.h"
#include "tools/report/command_line.h"

namespace jarol::tools {
namespace {

// Of each output, evenly spread: as much as a screen is wide, and a few times as much for those who look closely.
constexpr std::int64_t max_samples = 8192;

struct ConsoleOptions {
  std::string log;
  std::string file;
  ConsoleArguments console;
};

// Of each output, so that the whole recording has no more samples than that.
std::vector<std::uint64_t> strides_of(const Graph& graph, Duration covered) {
  std::map<std::string, Duration> periods;
  for (const Task& task : graph.tasks) periods[task.name] = task.period;
  for (const Communicator& communicator : graph.communicators) periods[communicator.name] = communicator.period;
  Duration shortest = covered;
  for (const auto& [name, period] : periods) shortest = std::min(shortest, period);
  std::vector<std::uint64_t> strides;
  const auto add = [&](Duration period) {
    const std::int64_t samples = covered.count() / std::max<std::int64_t>(1, period.count());
    strides.push_back(static_cast<std::uint64_t>(1 + samples / max_samples));
  };
  for (const Output& output : outputs_of(graph)) add(periods.at(output.name.substr(0, output.name.find('.'))));
  // where vehicles truly are: at no more instants than there are
  for (std::size_t i = 0; i < graph.distributers.size(); ++i) add(shortest);
  return strides;
}

// As the user sees it from here.
std::string near_name(const std::string& file) {
  const std::string here = std::filesystem::current_path().string() + "/";
  return file.starts_with(here) ? file.substr(here.size()) : file;
}

std::vector<std::shared_ptr<const Source>> sources_of(const std::vector<RecordedFile>& files) {
  std::vector<std::shared_ptr<const Source>> sources;
  for (const RecordedFile& file : files) sources.push_back(std::make_shared<Source>(Source{file.path, file.text}));
  return sources;
}

std::string text_of(const RecordedRun& log, const Comparison& comparison) {
  std::string text = "recorded    " + near_name(log.header().file) + " on the " + log.header().clock + " clock\n";
  if (!log.end()) text += "it breaks off; how the run ended is not known\n";
  if (const auto& end = log.end())
    text += fmt::format("activations {}, instants {}, faults {}\ndigest      0x{:016x}\n", end->activations,
                        end->instants, end->faults, end->digest);
  if (comparison.evidence == Evidence::diverged)
    text += "DIVERGED    what is shown is not what the run did; jarol replay shows from where\n";
  return text;
}

int show(const ConsoleOptions& options) {
  console::ServerOptions server = server_of(options.console);
  // it ends, and is there as a whole
  server.skips = false;
  // pages are served before a long one has been gone through, by what its begin and its end say
  const Recording ends(options.log);
  Loaded loaded = load_recorded_graph(ends, options.file, "jarol console", true);
  std::optional<RecordedRun> log;
  const std::optional<LogEnd> end_of_log = find_end(ends);
  std::vector<Miss> misses;
  const auto read = [&] {
    log.emplace(options.log);
    misses = log->begin(*loaded.graph);
  };
  // what can't be shown is refused before anybody looks
  if (!end_of_log || !ends.text_of_rest().empty() || !options.file.empty()) read();
  const Duration covered = end_of_log ? Duration(end_of_log->covered) : log->covered();
  console::Console console({{*loaded.graph, options.log, "recorded", covered, types_of_truth(loaded),
                             console::find_flow(*loaded.graph, loaded.known->vehicles, sources_of(ends.files())),
                             console::Given{ends.header().file, ends.header().overrides, ends.header().seed}},
                            server},
                           max_samples, strides_of(*loaded.graph, covered));
  const Interruptible interruptible;
  console.open();
  print_url(console.url(), options.console);
  if (!log) read();
  if (Interruptible::signal() != 0) return exit_of_signal(Interruptible::signal());
  loaded.systems = recorded_systems(loaded, *log);
  GraphRun run(std::move(loaded), {.sinks = {&console.feed()}, .misses = misses, .truth = true, .watched = true});
  ReplayRun replay(run.executor(), *log);
  const RunEnd end = attend(
      replay, [] {}, Interruptible::wish);
  if (end.failure) std::rethrow_exception(end.failure);
  if (end.hangs) end_at_once(exit_unfinished);
  run.sinks().close();
  console.end(text_of(*log, replay.comparison));
  // until Ctrl-C
  while (Interruptible::signal() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return exit_of_signal(Interruptible::signal());
}

}  // namespace

void add_console(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<ConsoleOptions>();
  Command* command = line.add_subcommand(
      "console",
      "Look at a recording of jarol run --record or --log on a web page, whose address is printed; as with jarol "
      "replay it\n"
      "is run again for that. Ctrl-C ends it. A run that goes on is looked at by jarol run --console.\n"
      "Exit code: 2 bad input, 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), SIGTERM");
  command->add_option("FILE", options->log, "The recording of a run")->file({"mcap"})->required();
  command->add_option("GRAPH", options->file, "The graph, where it names plugins; default: as the run has read it")
      ->file({"yaml"});
  add_server_options(*command, options->console);
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace jarol::tools
