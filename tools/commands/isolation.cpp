// jarol isolation: do tasks reach nothing but their own, as their machine code shows it?
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "graph/isolation/way.h"
#include "graph/plugins/isolated.h"
#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

using isolation::Frame, isolation::Violation;

struct IsolationOptions {
  std::vector<std::string> files;
  bool json = false;
};

// What was found in a file.
struct Judged {
  std::string name;  // as it is printed
  std::string path;
  std::vector<isolation::Verdict> verdicts;
};

Judged judge(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) throw InputError("there is no file '" + file + "'");
  try {
    const isolation::Object object(file);
    return {file, file, isolation::verify(object, isolation::find_tasks(object))};
  } catch (const InputError& error) { throw InputError("'" + file + "' " + error.what()); }
}

Judged judge_built_in() {
  const Registry& registry = built_in().graph;
  const std::string program = "/proc/self/exe";
  try {
    return {"built in", program, verify_tasks(registry, names_of(registry.tasks()), program, true)};
  } catch (const InputError& error) { throw InputError(std::string("this program ") + error.what()); }
}

std::size_t count_isolated(const Judged& judged) {
  return static_cast<std::size_t>(
      std::count_if(judged.verdicts.begin(), judged.verdicts.end(),
                    [](const isolation::Verdict& verdict) { return verdict.violations.empty(); }));
}

nlohmann::ordered_json json_of(const Judged& judged) {
  const isolation::SourceLines lines(judged.path);
  auto tasks = nlohmann::ordered_json::array();
  for (const isolation::Verdict& verdict : judged.verdicts) {
    auto violations = nlohmann::ordered_json::array();
    for (const Violation& violation : verdict.violations) {
      auto path = nlohmann::ordered_json::array();
      for (const Frame& frame : way_of(violation, lines))
        path.push_back({{"function", frame.function}, {"file", frame.file}, {"line", frame.line}});
      violations.push_back(
          {{"kind", violation.kind}, {"symbol", violation.symbol}, {"text", violation.text}, {"path", path}});
    }
    tasks.push_back({{"name", verdict.task},
                     {"isolated", verdict.violations.empty()},
                     {"violations", violations},
                     {"notes", verdict.notes}});
  }
  return {{"file", judged.name}, {"tasks", tasks}};
}

void print(const Judged& judged) {
  const isolation::SourceLines lines(judged.path);
  const std::size_t good = count_isolated(judged), all = judged.verdicts.size();
  std::cout << judged.name << ": " << (good == all ? "ISOLATED" : "NOT ISOLATED") << ", " << good << " of " << all
            << (all == 1 ? " task is\n" : " tasks are\n");
  for (const isolation::Verdict& verdict : judged.verdicts) {
    if (verdict.violations.empty() && verdict.notes.empty()) continue;
    std::cout << "  task " << verdict.task << "\n";
    for (const Violation& violation : verdict.violations) {
      std::cout << "    " << violation.text << "\n";
      for (const Frame& frame : way_of(violation, lines)) std::cout << "      " << text_of(frame) << "\n";
    }
    for (const std::string& note : verdict.notes) std::cout << "    note: " << note << "\n";
  }
}

int run_isolation(const IsolationOptions& options) {
  std::vector<Judged> all;
  for (const std::string& file : options.files) all.push_back(judge(file));
  if (options.files.empty()) all.push_back(judge_built_in());
  const bool isolated = std::all_of(
      all.begin(), all.end(), [](const Judged& judged) { return count_isolated(judged) == judged.verdicts.size(); });
  if (options.json) {
    nlohmann::ordered_json whole{{"schema", "jarol.isolation/1"},
                                 {"isolated", isolated},
                                 {"unseen", isolation::unseen()},
                                 {"files", nlohmann::ordered_json::array()}};
    for (const Judged& judged : all) whole["files"].push_back(json_of(judged));
    std::cout << json_line(whole);
  } else {
    for (const Judged& judged : all) print(judged);
    std::cout << "not seen:\n";
    for (const std::string& line : isolation::unseen()) std::cout << "  " << line << "\n";
  }
  return isolated ? exit_good : exit_negative;
}

}  // namespace

void add_isolation(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<IsolationOptions>();
  Command* command = line.add_subcommand(
      "isolation",
      "Do tasks reach nothing but their own? Follows their machine code; without a file, of those built in");
  command->add_option("FILE", options->files, "Shared libraries with tasks; -g when they are built names source lines")
      ->file({"so"});
  command->add_flag("--json", options->json, "One JSON object instead of text");
  command->footer(
      "A task may use its parameters, inputs, state, heap and logical time. What it can reach beside them offends: "
      "writable\n"
      "globals, thread-local storage, clocks, files and the like, the global allocator, system calls. Exit code 1 if "
      "any\n"
      "does, 2 if a file can't be read.\n");
  command->callback([options, &exit_code] { exit_code = run_isolation(*options); });
}

}  // namespace jarol::tools
