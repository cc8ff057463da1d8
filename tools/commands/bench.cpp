// jarol bench: what an activation costs, beside the best plain code in the same run.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "graph/language/problems.h"
#include "graph/text/errors.h"
#include "tools/bench/figures.h"
#include "tools/bench/vehicles.h"
#include "tools/commands/commands.h"
#include "tools/report/command_line.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

struct BenchOptions {
  std::vector<std::string> names;
  int repeats = 60;
  bool json = false;
};

// All that can be measured here, unless some are named.
std::vector<std::string> figures_of(const BenchOptions& options) {
  std::vector<std::string> known = bench::figure_names();
  const bool in_tree = bench::has_graphs();
  for (const std::string& name : options.names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError("there is no figure '" + name + "'" + did_you_mean(name, known) +
                       "; there are: " + list_of(known));
    if (bench::is_of_tree(name) && !in_tree)
      throw InputError("'" + name + "' runs graphs of Jarol's source tree, which are not here: start 'jarol bench " +
                       name + "' at its root");
  }
  if (!options.names.empty()) return options.names;
  if (in_tree) return known;
  std::vector<std::string> left_out;
  std::copy_if(known.begin(), known.end(), std::back_inserter(left_out), bench::is_of_tree);
  std::erase_if(known, bench::is_of_tree);
  if (!left_out.empty())
    std::cerr << "note: left out are " << list_of(left_out)
              << ", which run graphs of Jarol's source tree: start it at its root\n";
  return known;
}

int run_bench(const BenchOptions& options) {
  const std::vector<std::string> names = figures_of(options);
  auto figures = nlohmann::ordered_json::array();
  bool all_met = true;
  if (!options.json)
    std::cout << fmt::format("{:<22}{:>10}{:>10}{:>8}{:>8}  {}\n", "figure", "value", "floor", "ratio", "goal", "what");
  for (const std::string& name : names) {
    if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\033[Kmeasuring %s ", name.c_str());
    const bench::Figure f = bench::measure(name, options.repeats);
    if (isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
    all_met = all_met && f.ratio <= f.goal;
    if (options.json) {
      figures.push_back({{"name", f.name},
                         {"value", f.value},
                         {"unit", f.unit},
                         {"floor", f.floor},
                         {"ratio", f.ratio},
                         {"goal", f.goal}});
    } else {
      std::cout << fmt::format("{:<22}{:>7.2f} {:<2}{:>7.2f} {:<2}{:>8.2f}{:>8.2f}  {}{}\n", f.name, f.value, f.unit,
                               f.floor, f.unit, f.ratio, f.goal, f.text, f.ratio <= f.goal ? "" : "  NOT MET");
    }
  }
  if (options.json)
    std::cout << json_line({{"schema", "jarol.bench/1"}, {"figures", figures}});
  else
    std::cout << (all_met ? "all goals met\n" : "not all goals met; machines are noisy, repeat before you conclude\n");
  return all_met ? exit_good : exit_negative;
}

}  // namespace

void add_bench(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  Command* command =
      line.add_subcommand("bench",
                          "Measure what running costs, each figure beside the best plain code for the same work.\n"
                          "Least of interleaved repeats. Exit code: 0 all goals met, 1 not all");
  command->add_option("FIGURE", options->names, "Figures to measure; default all: " + list_of(bench::figure_names()))
      ->suggests(bench::figure_names());
  command->add_option("--repeats", options->repeats, "Interleaved repeats per figure; default 60")->in_range(1, 100000);
  command->add_flag("--json", options->json, "One JSON object instead of a table");
  command->callback([options, &exit_code] { exit_code = run_bench(*options); });
}

}  // namespace jarol::tools
