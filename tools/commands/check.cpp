// jarol check: is the graph right, and can it be scheduled.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "graph/analysis/time_table.h"
#include "tools/commands/commands.h"
#include "tools/load_graph.h"

namespace jarol::tools {
namespace {

using analysis::TableResult;
using analysis::Verdict;

struct Options {
  std::vector<std::string> files;
  Overrides overrides;
  bool json = false;
};

std::string verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::schedulable: return "schedulable";
    case Verdict::not_schedulable: return "not_schedulable";
    case Verdict::unknown: return "unknown";
  }
  return "";
}

int exit_code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::schedulable: return exit_good;
    case Verdict::not_schedulable: return exit_negative;
    case Verdict::unknown: return exit_unfinished;
  }
  return exit_unfinished;
}

std::string milliseconds(Duration duration) {
  return fmt::format("{:.3f} ms", static_cast<double>(duration.count()) * 1e-6);
}

void print_json(const std::string& file, const Graph& graph, const TableResult& result) {
  auto tasks = nlohmann::ordered_json::array();
  for (const Task& t : graph.tasks) {
    nlohmann::ordered_json task{{"name", t.name},
                                {"period_ns", t.period.count()},
                                {"offset_ns", t.offset.count()},
                                {"deadline_ns", t.deadline.count()},
                                {"wcet_ns", nullptr}};
    if (t.wcet) task["wcet_ns"] = t.wcet->count();
    tasks.push_back(std::move(task));
  }
  std::cout << nlohmann::ordered_json{{"schema", "jarol.check/1"},
                                      {"file", file},
                                      {"graph", graph.name},
                                      {"verdict", verdict_word(result.verdict)},
                                      {"tasks", tasks},
                                      {"utilisation", result.utilisation}}
            << "\n";
}

void print_table(const Graph& graph, const TableResult& result) {
  std::size_t width = 4;
  for (const Task& t : graph.tasks) width = std::max(width, t.name.size());
  std::cout << fmt::format("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>6}  {:>9}\n", "task", width, "period", "offset",
                           "deadline", "wcet", "use", "response");
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& t = graph.tasks[i];
    const std::string use = t.wcet ? fmt::format("{:.2f}%", 100.0 * static_cast<double>(t.wcet->count()) /
                                                                static_cast<double>(t.period.count()))
                                   : "-";
    std::cout << fmt::format("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>6}  {:>9}\n", t.name, width,
                             duration_text(t.period), duration_text(t.offset), duration_text(t.deadline),
                             t.wcet ? duration_text(*t.wcet) : "-", use,
                             result.response.empty() ? "-" : duration_text(result.response[i]));
  }
}

void print_text(const std::string& file, const Graph& graph, const TableResult& result) {
  switch (result.verdict) {
    case Verdict::schedulable: std::cout << file << ": SCHEDULABLE on one core: " << result.reason << "\n"; break;
    case Verdict::not_schedulable:
      std::cout << file << ": NOT SCHEDULABLE";
      if (result.miss) {
        const analysis::Miss& m = *result.miss;
        std::cout << " core 0: task '" << graph.tasks[m.task].name << "' activation " << m.activation << " (released "
                  << milliseconds(m.release) << ") finishes " << milliseconds(m.finish) << ", deadline "
                  << milliseconds(m.deadline) << " (late " << milliseconds(m.finish - m.deadline) << ")";
      }
      std::cout << "\n  " << result.reason << "\n";
      break;
    case Verdict::unknown: std::cout << file << ": UNKNOWN: " << result.reason << "\n"; break;
  }
  print_table(graph, result);
  std::cout << fmt::format(
      "  utilisation {:.2f}%; a task's response is its longest time from release to end when each takes its wcet;\n"
      "  assumed: tasks run one after the other as released, never interrupted, without overhead\n",
      100.0 * result.utilisation);
}

// The worst of the verdicts: bad input, then not schedulable, then undecided.
int worst(int a, int b) {
  const auto rank = [](int code) {
    return code == exit_input ? 3 : code == exit_negative ? 2 : code == exit_unfinished ? 1 : 0;
  };
  return rank(a) >= rank(b) ? a : b;
}

int check_files(const Options& options) {
  int exit_code = exit_good;
  for (const std::string& file : options.files) {
    try {
      const Loaded loaded = load_graph(file, options.overrides);
      const TableResult result = analysis::check_table(*loaded.graph);
      options.json ? print_json(file, *loaded.graph, result) : print_text(file, *loaded.graph, result);
      exit_code = worst(exit_code, exit_code_of(result.verdict));
    } catch (const SpecError& error) {
      // one bad file does not hide the others
      std::cerr << error.what() << "\n"
                << file << ": " << error.problems().size() << (error.problems().size() == 1 ? " error\n" : " errors\n");
      exit_code = exit_input;
    }
  }
  return exit_code;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("check",
                         "Check structure, types and timing of graphs, and whether they can be scheduled.\n"
                         "Exit code: 0 schedulable, 1 not schedulable, 3 not decided, 2 bad input");
  command->add_option("FILE", options->files, "Graphs, YAML files")->required();
  command->add_option("--set", options->overrides.set, "Change a value: path=value, as in tasks.depth.wcet=2ms")
      ->allow_extra_args(false);
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
  command->add_flag("--json", options->json, "One JSON object per file and line instead of text");
  command->callback([options, &exit_code] { exit_code = check_files(*options); });
}

}  // namespace jarol::tools
