// jarol tasks: what graphs can be made of.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/commands/other_parts.h"
#include "tools/commands/run/known_with.h"
#include "tools/commands/task_fields.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

struct TasksOptions {
  std::string name;
  std::vector<std::string> plugins;
  bool json = false;
};

nlohmann::ordered_json task_json(const TaskClass& task) {
  return {{"name", task.name},
          {"summary", task.summary},
          {"parameters", fields_json(*task.parameters)},
          {"inputs", fields_json(*task.in)},
          {"outputs", fields_json(*task.out)}};
}

nlohmann::ordered_json distributer_json(const DistributerClass& distributer) {
  auto channels = nlohmann::ordered_json::array();
  for (const ChannelClass& c : distributer.channels)
    channels.push_back({{"name", c.name},
                        {"direction", c.direction == Direction::in ? "in" : "out"},
                        {"type", c.type->name},
                        {"text", c.text}});
  const auto parameters =
      distributer.parameters != nullptr ? fields_json(*distributer.parameters) : nlohmann::ordered_json::array();
  return {
      {"name", distributer.name}, {"summary", distributer.summary}, {"parameters", parameters}, {"channels", channels}};
}

nlohmann::ordered_json json_of(const std::vector<TaskClass>& tasks, const std::vector<DistributerClass>& distributers) {
  nlohmann::ordered_json whole{{"schema", "jarol.tasks/1"},
                               {"tasks", nlohmann::ordered_json::array()},
                               {"distributers", nlohmann::ordered_json::array()}};
  for (const TaskClass& t : tasks) whole["tasks"].push_back(task_json(t));
  for (const DistributerClass& d : distributers) whole["distributers"].push_back(distributer_json(d));
  return whole;
}

void print_task(const TaskClass& task) {
  std::cout << task.name << ": " << task.summary << "\n";
  print_fields("parameters", *task.parameters, true);
  print_fields("inputs", *task.in, false);
  print_fields("outputs", *task.out, false);
}

void print_distributer(const DistributerClass& distributer) {
  std::cout << distributer.name << ": " << distributer.summary << "\n";
  if (distributer.parameters != nullptr) print_fields("parameters", *distributer.parameters, true);
  std::cout << "\nchannels\n";
  std::size_t width = 0;
  for (const ChannelClass& c : distributer.channels) width = std::max(width, c.name.size());
  for (const ChannelClass& c : distributer.channels)
    std::cout << "  " << c.name << std::string(width - c.name.size() + 2, ' ')
              << (c.direction == Direction::in ? "in   " : "out  ") << c.type->name << "  " << c.text << "\n";
}

std::vector<ListedParts> all_parts(const distributers::Registries& known) {
  std::vector<ListedParts> all{{"tasks", {}}, {"distributers", {}}};
  for (const TaskClass& t : known.graph.tasks()) all[0].parts.emplace_back(t.name, t.summary);
  for (const DistributerClass& d : known.graph.distributers()) all[1].parts.emplace_back(d.name, d.summary);
  for (ListedParts& other : other_parts(known)) all.push_back(std::move(other));
  return all;
}

void print_all(const distributers::Registries& known) {
  const std::vector<ListedParts> all = all_parts(known);
  std::size_t width = 0;
  for (const ListedParts& listed : all)
    for (const auto& [name, what] : listed.parts) width = std::max(width, name.size());
  for (const ListedParts& listed : all) {
    if (listed.parts.empty()) continue;
    std::cout << listed.title << "\n";
    for (const auto& [name, what] : listed.parts)
      std::cout << "  " << name << std::string(width - name.size() + 2, ' ') << what << "\n";
    std::cout << "\n";
  }
  std::cout << "jarol tasks NAME shows parameters, inputs, outputs, channels and keys\n";
}

std::vector<std::string> names_in(const distributers::Registries& known) {
  std::vector<std::string> names;
  for (const ListedParts& listed : all_parts(known))
    for (const auto& [name, what] : listed.parts) names.push_back(name);
  return names;
}

[[noreturn]] void refuse(const std::string& name, const distributers::Registries& known) {
  const std::vector<std::string> names = names_in(known);
  throw InputError("there is no task, distributer, vehicle, link, policy or grammar '" + name + "'" +
                   did_you_mean(name, names) + "; there are: " + list_of(names));
}

int list_tasks(const TasksOptions& options) {
  const distributers::Registries known = known_with(options.plugins);
  const TaskClass* task = known.graph.find_task(options.name);
  const DistributerClass* distributer = known.graph.find_distributer(options.name);
  if (options.json) {
    nlohmann::ordered_json whole;
    if (options.name.empty()) {
      whole = json_of(known.graph.tasks(), known.graph.distributers());
      add_other_parts(known, whole);
    } else if (task != nullptr) {
      whole = json_of({*task}, {});
    } else if (distributer != nullptr) {
      whole = json_of({}, {*distributer});
    } else if (whole = json_of({}, {}); !add_other_part(known, options.name, whole)) {
      refuse(options.name, known);
    }
    std::cout << json_line(whole);
  } else if (options.name.empty()) {
    print_all(known);
  } else if (task != nullptr) {
    print_task(*task);
  } else if (distributer != nullptr) {
    print_distributer(*distributer);
  } else if (!print_other_part(known, options.name)) {
    refuse(options.name, known);
  }
  return exit_good;
}

}  // namespace

void add_tasks(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<TasksOptions>();
  Command* command = line.add_subcommand(
      "tasks", "List task types, distributers, vehicles, links, policies and grammars, or show all about one");
  command
      ->add_option("NAME", options->name,
                   "A task type, distributer, vehicle, link, policy or grammar, as in DepthControl or udp")
      ->suggests(names_in(built_in()));
  command->add_option("--plugin", options->plugins, "Also those of this shared library")->file({"so"})->one_value();
  command->add_flag("--json", options->json, "One JSON object instead of text");
  command->callback([options, &exit_code] { exit_code = list_tasks(*options); });
}

}  // namespace jarol::tools
