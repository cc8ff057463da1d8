#include "graph/plugins/plugins.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include "graph/floating_point.h"
#include "graph/language/inputs.h"
#include "graph/plugins/isolated.h"
#include "graph/plugins/judged_files.h"
#include "graph/plugins/machine_code.h"
#include "graph/plugins/plugin_build.h"
#include "graph/plugins/plugin_trial.h"

namespace jarol {
namespace {

namespace fs = std::filesystem;

// The note that JAROL_PLUGIN leaves in the file.
std::optional<PluginBuild> read_build(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
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

std::string open_plugin(const std::string& path, PluginLibrary& library) {
  void* const loaded = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (loaded == nullptr) {
    const char* const why = dlerror();
    return std::string("is no shared library that can be used here: ") + (why != nullptr ? why : "unknown reason");
  }
  library.add = reinterpret_cast<void (*)(Registry&)>(dlsym(loaded, "jarol_plugin_add"));
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

// Appends the types that it adds.
std::string add_plugin(const std::string& path, Registry& registry, std::vector<std::string>& types) {
  const std::string name = "'" + path + "' ";
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "there is no file '" + path + "'";
  note_input(path);
  // without a slash dlopen would search elsewhere
  const std::string place = path.find('/') == std::string::npos ? "./" + path : path;
  const Judgement judgement = judge(place);
  if (!judgement.wrong.empty()) return name + judgement.wrong;
  const DefaultFloatingPoint scope;
  PluginLibrary library;
  const std::string wrong = open_plugin(place, library);
  if (!wrong.empty()) return name + wrong;
  Registry added;
  library.add(added);
  for (const TaskClass& task : added.tasks())
    if (registry.find_task(task.name) != nullptr)
      return name + "brings a task type '" + task.name + "', which there is already";
  for (TaskClass task : added.tasks()) {
    if (judgement.trusted) task.trust_floating_point();
    types.push_back(task.name);
    registry.add(std::move(task));
  }
  return "";
}

}  // namespace

std::string load_plugin(const std::string& path, Registry& registry) {
  std::vector<std::string> types;
  return add_plugin(path, registry, types);
}

std::string plugin_path(const GraphSpec& spec, const std::string& plugin) {
  const fs::path folder = spec.where.source ? fs::path(spec.where.source->name).parent_path() : "";
  return (folder / plugin).string();
}

void load_plugins(const GraphSpec& spec, Registry& registry, Problems& problems) {
  for (const Located<std::string>& plugin : spec.plugins) {
    std::vector<std::string> types;
    const std::string path = plugin_path(spec, plugin.value);
    const std::string wrong = add_plugin(path, registry, types);
    if (wrong.empty()) {
      check_isolation(spec, registry, types, path, problems);
      continue;
    }
    problems.add(plugin.where, wrong);
    registry.mark_incomplete();
  }
}

}  // namespace jarol
