#include "graph/plugins.h"

#include <dlfcn.h>

#include <filesystem>

#include "graph/plugin.h"
#include "graph/yaml/inputs.h"

namespace jarol {

std::string load_plugin(const std::string& path, Registry& registry) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "there is no file '" + path + "'";
  note_input(path);
  // without a slash dlopen would search elsewhere
  const std::string place = path.find('/') == std::string::npos ? "./" + path : path;
  void* const library = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* const why = dlerror();
    return "'" + path + "' is no shared library that can be used here: " + (why != nullptr ? why : "unknown reason");
  }
  const auto form = reinterpret_cast<const char* (*)()>(dlsym(library, "jarol_plugin_form"));
  const auto add = reinterpret_cast<void (*)(Registry&)>(dlsym(library, "jarol_plugin_add"));
  if (form == nullptr || add == nullptr)
    return "'" + path + "' is a shared library without tasks; name them with JAROL_PLUGIN, see graph/plugin.h";
  if (std::string_view(form()) != plugin_form)
    return "'" + path + "' was built for " + form() + ", this is " + plugin_form + "; build it again";
  Registry added;
  add(added);
  for (const TaskClass& task : added.tasks())
    if (registry.find_task(task.name) != nullptr)
      return "'" + path + "' brings a task type '" + task.name + "', which there is already";
  for (const TaskClass& task : added.tasks()) registry.add(task);
  return "";
}

std::string plugin_path(const GraphSpec& spec, const std::string& plugin) {
  const std::filesystem::path folder =
      spec.where.source ? std::filesystem::path(spec.where.source->name).parent_path() : "";
  return (folder / plugin).string();
}

void load_plugins(const GraphSpec& spec, Registry& registry, Problems& problems) {
  for (const Located<std::string>& plugin : spec.plugins) {
    const std::string wrong = load_plugin(plugin_path(spec, plugin.value), registry);
    if (!wrong.empty()) problems.add(plugin.where, wrong);
  }
}

}  // namespace jarol
