#include "graph/plugins/isolated.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "graph/isolation/way.h"
#include "graph/plugins/judged_files.h"
#include "graph/plugins/plugin_build.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

namespace fs = std::filesystem;

// Where a function lies in its file, which must be this one.
isolation::Address place_of(const void* function, const std::string& file, const std::string& task) {
  Dl_info found{};
  std::error_code error;
  const bool known = dladdr(function, &found) != 0 && found.dli_fname != nullptr;
  if (!known || (!fs::equivalent(found.dli_fname, file, error) && fs::path(file) != "/proc/self/exe"))
    throw InputError("has a task '" + task + "' whose code lies in another file, where it can't be looked at");
  return static_cast<isolation::Address>(static_cast<const char*>(function) -
                                         static_cast<const char*>(found.dli_fbase));
}

isolation::Root root_of(const TaskClass& task, const std::string& file) {
  isolation::Root root{task.name, {}};
  for (const Thunk thunk : {task.run, task.unchecked.run})
    root.entries.push_back(place_of(reinterpret_cast<const void*>(thunk), file, task.name));
  for (const Body body : {task.body, task.unchecked.body})
    root.entries.push_back(place_of(reinterpret_cast<const void*>(body), file, task.name));
  root.entries.push_back(place_of(reinterpret_cast<const void*>(task.handling), file, task.name));
  return root;
}

using Wrong = std::map<std::string, std::string>;  // by type: why it is not isolated

Wrong find_wrong(const Registry& registry, const std::vector<std::string>& types, const std::string& plugin) {
  Wrong wrong;
  std::optional<isolation::SourceLines> lines;
  try {
    for (const isolation::Verdict& verdict : verify_tasks(registry, types, plugin, false)) {
      if (verdict.violations.empty()) continue;
      if (!lines) lines.emplace(plugin);
      const isolation::Violation& first = verdict.violations.front();
      const auto way = isolation::way_of(first, *lines);
      wrong[verdict.task] = first.text + (way.empty() ? "" : ", in " + isolation::text_of(way.back()));
    }
  } catch (const InputError& error) {
    for (const std::string& type : types) wrong[type] = "'" + plugin + "' " + error.what();
  }
  return wrong;
}

bool promises_isolation(const TaskSpec& task) {
  return task.type && !(task.isolation && task.isolation->value == Isolation::weak);
}

}  // namespace

std::vector<isolation::Verdict> verify_tasks(const Registry& registry, const std::vector<std::string>& types,
                                             const std::string& file, bool own) {
  std::vector<isolation::Root> roots;
  for (const std::string& type : types) roots.push_back(root_of(*registry.find_task(type), file));
  return isolation::verify(isolation::Object(file), roots, own);
}

void check_isolation(const GraphSpec& spec, const Registry& registry, const std::vector<std::string>& types,
                     const std::string& plugin, Problems& problems) {
  static constexpr PluginBuild ours = build_of_this_file();
  if (ours.options.address_sanitizer != 0 || ours.options.thread_sanitizer != 0) return;
  std::vector<std::string> promised;
  for (const std::string& type : types)
    if (std::any_of(spec.tasks.begin(), spec.tasks.end(),
                    [&](const TaskSpec& task) { return promises_isolation(task) && task.type->value == type; }))
      promised.push_back(type);
  if (promised.empty()) return;
  static JudgedFiles<Wrong> judged;
  std::string names;
  for (const std::string& type : promised) names += type + " ";
  const Wrong wrong = judged.find(plugin, names, [&] { return find_wrong(registry, promised, plugin); });
  for (const TaskSpec& task : spec.tasks)
    if (promises_isolation(task) && wrong.contains(task.type->value))
      problems.add(task.type->where, "task '" + task.name + "' (" + task.type->value +
                                         ") is not isolated: " + wrong.at(task.type->value) +
                                         "; leave that out, or declare it with 'isolation: weak' (jarol isolation " +
                                         plugin + " shows the way there)");
}

}  // namespace jarol
