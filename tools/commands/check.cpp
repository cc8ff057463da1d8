// jarol check: is the graph right, and can it be scheduled.
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "distributers/session/checked_graph.h"
#include "graph/analysis/random_graphs.h"
#include "graph/language/key.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "runtime/files/atomic_file.h"
#include "tools/commands/check/check_report.h"
#include "tools/commands/check/gantt.h"
#include "tools/commands/check/measure_file.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"
#include "tools/report/failure.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

struct CheckCommandOptions {
  std::vector<std::string> files;
  Overrides overrides;
  std::string generate;
  std::string folder;
  int count = 1;
  analysis::Generation generation;
  std::string svg;
  std::string duration;
  MeasureOptions measuring;
  bool sensitivity = false;
  bool all_chains = false;
  bool json = false;
};

int exit_code_of_checked(const CheckReport& report) {
  const std::optional<bool> chains = chains_hold(report);
  if (report.result.verdict == analysis::Verdict::not_schedulable || chains == false ||
      longer_than_stated(report) != nullptr)
    return exit_negative;
  return report.result.verdict == analysis::Verdict::schedulable && chains ? exit_good : exit_unfinished;
}

// The worst of the verdicts: bad input, then not schedulable, then undecided.
int worst(int a, int b) {
  const auto rank = [](int code) {
    return code == exit_input ? 3 : code == exit_negative ? 2 : code == exit_unfinished ? 1 : 0;
  };
  return rank(a) >= rank(b) ? a : b;
}

// Options that would have no effect.
void require_effect(const Command& command, const CheckCommandOptions& options) {
  if (!options.generate.empty()) {
    command.refuse({"FILE", "--set", "--profile", "--sensitivity", "--chains", "--measure", "--write", "--lower",
                    "--for", "--margin", "--svg", "--json"},
                   "is for checking, and --generate writes graphs without checking them; leave out one of the two");
    return;
  }
  command.refuse({"--cores", "--policy"},
                 "belongs to --generate; of a FILE it is changed by --set, as in --set platform.cores=2 or --set "
                 "platform.policy=edf");
  command.refuse({"-o", "--count", "--seed", "--tasks", "--utilisation"},
                 "belongs to --generate; add that, as in --generate waters, or leave it out");
  if (!options.measuring.write)
    command.refuse({"--lower", "--margin"},
                   "belongs to --write, which writes what was measured; add that, or leave it out");
  if (!options.measuring.write && !options.measuring.measure)
    command.refuse({"--for"},
                   "says how long to measure, and a verdict holds for ever; add --measure or --write, or leave it out");
  if (options.measuring.write && std::find(options.files.begin(), options.files.end(), "-") != options.files.end())
    throw InputError("--write: '-' is stdin, which can't be written; name the graph's file");
  if (options.files.size() > 1) command.refuse({"--svg"}, "names one picture for several files; check them one by one");
}

// What is to be printed of a file.
struct Checked {
  std::vector<std::string> notes;
  std::string text;
  std::string picture;  // that goes to stdout
  int exit_code = exit_good;
  std::exception_ptr failure;  // in place of a report
};

// What was asked for and is not there.
void note_what_is_missing(const CheckReport& report, const CheckCommandOptions& options,
                          std::vector<std::string>& notes) {
  if (!options.svg.empty() && gantt_svg(*report.graph, report.result).empty())
    notes.push_back("no picture in '" + options.svg + "', as it needs a 'wcet' of every task");
  if (options.sensitivity && !report.sensitivity)
    notes.emplace_back("--sensitivity reports nothing, as it needs a 'wcet' of every task");
  const std::size_t paths = report.chains.size() - report.graph->chains.size();
  if (options.all_chains && paths == 0 && report.all_walked)
    notes.emplace_back("--chains reports nothing, as no path leads from an 'in' to an 'out'");
  if (report.more_paths) notes.push_back("--chains reports " + std::to_string(paths) + " paths, there are more");
  if (!report.all_walked)
    notes.push_back("--chains reports " + std::to_string(paths) + (paths == 1 ? " path" : " paths") +
                    ", there may be more: to follow every way would take too long");
}

void check_file(const std::string& file, const CheckCommandOptions& options, Checked& checked) {
  std::optional<Measurement> measured;
  if (options.measuring.measure || options.measuring.write)
    measured = measure_file(file, options.overrides, options.measuring);
  // what is written is judged as it was written
  const Overrides overrides = options.measuring.write ? without_changes(options.overrides) : options.overrides;
  const CheckedGraph graph = check_graph(read_source(file), built_in(),
                                         {.overrides = overrides,
                                          .sensitivity = options.sensitivity,
                                          .all_chains = options.all_chains,
                                          .note = note_once});
  CheckReport report(file, graph.found);
  report.remedies = graph.remedies;
  // what was written holds by now
  if (!options.measuring.write) report.measured = std::move(measured);
  note_what_is_missing(report, options, checked.notes);
  if (const std::string drawn = gantt_svg(*report.graph, report.result); !options.svg.empty() && !drawn.empty()) {
    if (options.svg == "-") {
      checked.picture = drawn;
    } else {
      AtomicFile picture(options.svg);
      picture.write(drawn);
      picture.commit();
    }
  }
  checked.text = options.json ? json_line(to_json(report)) : to_text(report);
  checked.exit_code = exit_code_of_checked(report);
}

// One bad file does not hide the others.
Checked check_or_fail(const std::string& file, const CheckCommandOptions& options) {
  Checked checked;
  try {
    check_file(file, options, checked);
  } catch (...) { checked.failure = std::current_exception(); }
  return checked;
}

int print(const std::string& file, const Checked& checked, const CheckCommandOptions& options) {
  for (const std::string& note : checked.notes) print_note(note);
  if (checked.failure) return report(failure_of(checked.failure, file), options.json, file);
  (checked.picture.empty() ? std::cout : std::cerr) << checked.text << std::flush;
  std::cout << checked.picture;
  return checked.exit_code;
}

// On all processors at once, and reported in the order of the files.
int check_at_once(const CheckCommandOptions& options) {
  int exit_code = exit_good;
  // as deep as that of the main thread
  const tbb::global_control stack(tbb::global_control::thread_stack_size, std::size_t{8} << 20);
  using File = std::pair<std::string, Checked>;
  std::size_t next = 0;
  const auto begin = [&](tbb::flow_control& flow) {
    if (next == options.files.size()) {
      flow.stop();
      return File();
    }
    return File(options.files[next++], {});
  };
  const auto check = [&](File file) {
    file.second = check_or_fail(file.first, options);
    return file;
  };
  const auto end = [&](const File& file) { exit_code = worst(exit_code, print(file.first, file.second, options)); };
  tbb::parallel_pipeline(2 * std::max(1U, std::thread::hardware_concurrency()),
                         tbb::make_filter<void, File>(tbb::filter_mode::serial_in_order, begin) &
                             tbb::make_filter<File, File>(tbb::filter_mode::parallel, check) &
                             tbb::make_filter<File, void>(tbb::filter_mode::serial_in_order, end));
  return exit_code;
}

int check_files(const CheckCommandOptions& options) {
  for (const std::string& file : options.files) require_apart({{"FILE", file}}, {{"--svg", options.svg}});
  if (options.svg != "-") require_extension({"--svg", options.svg}, ".svg", "an SVG picture");
  // what is measured would be disturbed by others
  if (options.files.size() > 1 && !options.measuring.measure && !options.measuring.write) return check_at_once(options);
  int exit_code = exit_good;
  for (const std::string& file : options.files)
    exit_code = worst(exit_code, print(file, check_or_fail(file, options), options));
  return exit_code;
}

int write_graphs(const CheckCommandOptions& options) {
  if (options.folder.empty()) throw InputError("--generate needs -o DIR, a folder for the graphs");
  std::filesystem::create_directories(options.folder);
  analysis::Generation generation = options.generation;
  generation.kind = options.generate;
  const auto path_of = [&](std::uint64_t seed) {
    return options.folder + "/" + generation.kind + "_" + std::to_string(seed) + ".yaml";
  };
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(options.count); ++i)
    if (const std::string path = path_of(generation.seed + i); std::filesystem::exists(path))
      throw InputError("'" + path +
                       "' is there, and --generate overwrites nothing; choose another folder or --seed, or "
                       "remove it");
  for (int i = 0; i < options.count; ++i, ++generation.seed) {
    AtomicFile file(path_of(generation.seed), Replaces::nothing);
    file.write(analysis::generate_graph(generation));
    file.commit();
  }
  std::cerr << options.count << (options.count == 1 ? " graph in " : " graphs in ") << options.folder << "\n";
  return exit_good;
}

}  // namespace

void add_check(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<CheckCommandOptions>();
  Command* command =
      line.add_subcommand("check",
                          "Check structure, types and timing of graphs, and whether they can be scheduled.\n"
                          "Exit code: 0 schedulable, 1 not schedulable, a limit of a chain is broken, or with "
                          "--measure a 'wcet',\n3 not decided, 2 bad input");
  command
      ->add_option("FILE", options->files,
                   "Graphs, YAML files; several are checked on all processors at once, and reported in their order")
      ->file({"yaml"});
  command->add_option("--set", options->overrides.set, "Change a value: path=value, as in tasks.depth.wcet=2ms")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
  add_no_plugins(*command, options->overrides);
  command->add_flag("--sensitivity", options->sensitivity,
                    "How much longer each WCET may be, and what would help, also where finding it takes long");
  command->add_flag("--chains", options->all_chains, "Latency of every path from an 'in' to an 'out'");
  command->add_flag(
      "--measure", options->measuring.measure,
      "First run the tasks and report how much processor time they take on this machine, beside their 'wcet': "
      "what preempts them is not counted");
  command->add_flag("--write", options->measuring.write,
                    "Measure, and write the longest times with a margin into the file as 'wcet', where none is stated "
                    "or a shorter one; what is then said goes for that file, without --set and --profile");
  command->add_flag(
      "--lower", options->measuring.lower,
      "With --write: also where a longer 'wcet' is stated, down to what leaves room for a disturbance of 100us");
  command->add_option("--for", options->duration, "How much logical time to measure; default: the mission, else 10s");
  command
      ->add_option("--margin", options->measuring.margin,
                   "With --write: percent on top of what was measured; default 20")
      ->in_range(0.0, 10'000.0);
  command
      ->add_option("--svg", options->svg,
                   "Draw who runs when into this SVG file: around the first late activation, else over a hyperperiod; "
                   "-: to stdout")
      ->file({"svg"});
  command
      ->add_option("--generate", options->generate,
                   "Instead of checking, write random graphs: waters (automotive periods) or uunifast")
      ->one_of({"waters", "uunifast"});
  command->add_option("-o", options->folder, "Folder of the graphs that --generate writes")->folder();
  command->add_option("--count", options->count, "How many graphs, of consecutive seeds; default 1")
      ->in_range(1, 1'000'000);
  command->add_option("--seed", options->generation.seed, "Seed of the first graph; default 0");
  command->add_option("--tasks", options->generation.tasks, "Tasks of a graph; default 20")->in_range(1, 100'000);
  command->add_option("--utilisation", options->generation.utilisation, "Of all tasks together; default 0.6")
      ->in_range(0.0, 1e6);
  command->add_option("--cores", options->generation.cores, "Cores of a graph; default 1")->in_range(1, 1024);
  command->add_option("--policy", options->generation.policy, "Policy of a graph; default fixed_priority")
      ->one_of(names_of(built_in().graph.policies()));
  command->add_flag("--json", options->json, "One JSON object per file and line instead of text");
  command->callback([options, command, &exit_code] {
    require_effect(*command, *options);
    if (!options->duration.empty()) options->measuring.duration = length_of("--for", options->duration);
    if (options->generate.empty() && options->files.empty()) throw InputError("check needs a FILE, a graph");
    exit_code = options->generate.empty() ? check_files(*options) : write_graphs(*options);
  });
}

}  // namespace jarol::tools
