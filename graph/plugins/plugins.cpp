#include "graph/plugins/plugins.h"

#include <dlfcn.h>

#include <atomic>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>

#include "graph/floating_point.h"
#include "graph/isolation/elf_file.h"
#include "graph/language/inputs.h"
#include "graph/plugins/judged_files.h"
#include "graph/plugins/loaded_libraries.h"
#include "graph/plugins/machine_code.h"
#include "graph/plugins/plugin_build.h"
#include "graph/plugins/plugin_trial.h"

namespace jarol {
namespace {

namespace fs = std::filesystem;

// The note that JAROL_PLUGIN leaves in the file.
std::optional<PluginBuild> read_build(const std::string& path) {
  const std::vector<unsigned char> read = isolation::read_elf(path);
  const std::string_view bytes(reinterpret_cast<const char*>(read.data()), read.size());
  PluginBuild build;
  const std::size_t at = bytes.find(std::string_view(build.magic, sizeof build.magic));
  if (at == std::string::npos || bytes.size() - at < sizeof build) return std::nullopt;
  std::memcpy(&build, bytes.data() + at, sizeof build);
  return build;
}

std::string find_wrong(const std::string& path) {
  const std::optional<PluginBuild> build = read_build(path);
  if (!build) return "is no shared library with tasks; name them with JAROL_PLUGIN, see graph/plugins/plugin.h";
  static constexpr PluginBuild ours = build_of_this_file();
  if (const std::string difference = find_difference(*build, ours); !difference.empty())
    return "was built " + difference + "; build it again as graph/plugins/plugin.h says";
  return try_plugin(path);
}

std::atomic<bool> is_any_loaded{false};

constexpr char how_to_export[] =
    "; the program that loads it must export its symbols: link it with -rdynamic, or set ENABLE_EXPORTS in CMake";

struct Judgement {
  std::string wrong;
  bool trusted = false;  // it leaves the floating-point environment as it is
};

// It takes a process of its own and a look at all its code, and a campaign loads a plugin for many of its runs.
Judgement judge(const std::string& path) {
  static JudgedFiles<Judgement> judged;
  return judged.find(path, "", [&]() -> Judgement {
    if (std::string wrong = find_wrong(path); !wrong.empty()) return {std::move(wrong), false};
    return {"", find_floating_point_change(path).empty()};
  });
}

}  // namespace

bool are_plugins_loaded() { return is_any_loaded.load(); }

std::string open_plugin(const std::string& path, PluginLibrary& library) {
  is_any_loaded.store(true);
  void* const loaded = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr) {
    const char* const why = dlerror();
    const std::string text = why != nullptr ? why : "unknown reason";
    const bool is_ours = text.find("undefined symbol") != std::string::npos && text.find("5jarol") != std::string::npos;
    return "is no shared library that can be used here: " + text + (is_ours ? how_to_export : "");
  }
  library.add = reinterpret_cast<void (*)(PluginParts&)>(dlsym(loaded, "jarol_plugin_add"));
  const auto rounds_products = reinterpret_cast<bool (*)(const volatile double&, const volatile double&)>(
      dlsym(loaded, "jarol_plugin_rounds_products"));
  if (library.add == nullptr || rounds_products == nullptr)
    return "is a shared library without tasks; name them with JAROL_PLUGIN, see graph/plugins/plugin.h";
  const volatile double x = 1 + 0x1p-30, square = 1 + 0x1p-29;  // x * x, rounded
  if (!rounds_products(x, square))
    return "was built without -ffp-contract=off for a processor with FMA, so that it computes otherwise; build it "
           "again as graph/plugins/plugin.h says";
  return "";
}

namespace {

// What of a plugin there is already; empty: nothing.
std::string find_clash(const PluginParts& added, const PluginParts& known, const IsThere& is_there) {
  for (const TaskClass& task : added.graph.tasks())
    if (known.graph.find_task(task.name) != nullptr) return "a task type '" + task.name + "'";
  for (const DistributerClass& distributer : added.graph.distributers())
    if (known.graph.find_distributer(distributer.name) != nullptr) return "a distributer '" + distributer.name + "'";
  for (const Policy& policy : added.graph.policies())
    if (known.graph.find_policy(policy.name) != nullptr) return "a policy '" + std::string(policy.name) + "'";
  for (const Grammar& grammar : added.graph.grammars())
    if (known.graph.find_grammar(grammar.name) != nullptr) return "a grammar '" + std::string(grammar.name) + "'";
  for (const Extension& extension : added.extensions) {
    const bool added_before = std::any_of(
        known.extensions.begin(), known.extensions.end(),
        [&](const Extension& other) { return other.kind == extension.kind && other.name == extension.name; });
    if (added_before || is_there(extension)) return "a " + extension.kind + " '" + extension.name + "'";
  }
  return "";
}

// Appends the types of tasks that it adds.
std::string add_plugin(const std::string& path, PluginParts& known, const IsThere& is_there,
                       std::vector<std::string>& types) {
  const std::string name = "'" + path + "' ";
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "there is no file '" + path + "'";
  note_input(path);
  // one after the other, as each is looked at beside all that are loaded
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  LoadedLibraries& libraries = LoadedLibraries::of_process();
  if (const std::string conflict = libraries.find_conflict(path); !conflict.empty()) return name + conflict;
  const std::string place = libraries.place_of(path);
  const Judgement judgement = judge(place);
  if (!judgement.wrong.empty()) return name + judgement.wrong;
  const DefaultFloatingPoint scope;
  PluginLibrary library;
  libraries.add(path, place);
  const std::string wrong = open_plugin(place, library);
  if (!wrong.empty()) return name + wrong;
  PluginParts added;
  library.add(added);
  if (const std::string clash = find_clash(added, known, is_there); !clash.empty())
    return name + "brings " + clash + ", which there is already";
  for (TaskClass task : added.graph.tasks()) {
    if (judgement.trusted) task.trust_floating_point();
    types.push_back(task.name);
    known.graph.add(std::move(task));
  }
  for (const DistributerClass& distributer : added.graph.distributers()) known.graph.add(distributer);
  for (const Policy& policy : added.graph.policies()) known.graph.add(policy);
  for (const Grammar& grammar : added.graph.grammars()) known.graph.add(grammar);
  known.extensions.insert(known.extensions.end(), added.extensions.begin(), added.extensions.end());
  return "";
}

}  // namespace

std::string load_plugin(const std::string& path, PluginParts& known, const IsThere& is_there) {
  std::vector<std::string> types;
  return add_plugin(path, known, is_there, types);
}

std::string load_plugin(const std::string& path, Registry& registry) {
  PluginParts known{registry, {}};
  std::string wrong = load_plugin(path, known, [](const Extension&) { return false; });
  registry = std::move(known.graph);
  return wrong;
}

std::string plugin_path(const Location& graph, const std::string& plugin) {
  const fs::path folder = graph.source ? fs::path(graph.source->name).parent_path() : "";
  return (folder / plugin).string();
}

std::vector<LoadedPlugin> load_plugins(const GraphText& graph, PluginParts& known, const IsThere& is_there,
                                       Problems& problems) {
  std::vector<LoadedPlugin> loaded;
  for (const Located<std::string>& plugin : graph.plugins) {
    LoadedPlugin one{plugin_path(graph.where, plugin.value), {}};
    const std::string wrong = add_plugin(one.path, known, is_there, one.types);
    if (wrong.empty()) {
      loaded.push_back(std::move(one));
      continue;
    }
    problems.add(plugin.where, wrong);
    known.graph.mark_incomplete();
  }
  return loaded;
}

}  // namespace jarol
