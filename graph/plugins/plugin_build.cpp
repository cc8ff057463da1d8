#include "graph/plugins/plugin_build.h"

#include <string_view>

namespace jarol {
namespace {

// What has another size for reasons that have no name here.
struct BuildLayout {
  std::int32_t theirs, ours;
  const char* of;
};

}  // namespace

std::string find_difference(const PluginBuild& plugin, const PluginBuild& program) {
  if (plugin.form != program.form)
    return "for form " + std::to_string(plugin.form) + " of the interface, this is form " +
           std::to_string(program.form);
  const std::string_view by(plugin.compiler, strnlen(plugin.compiler, sizeof plugin.compiler));
  if (by != program.compiler) return "by " + std::string(by) + ", this program by " + program.compiler;
  if (std::string option = find_other_switch(plugin.options, program.options); !option.empty()) return option;
  const BuildLayout layouts[] = {
      {plugin.options.long_double, program.options.long_double, "a long double"},
      {plugin.options.wide_char, program.options.wide_char, "a wchar_t"},
      {plugin.eigen_alignment, program.eigen_alignment,
       "the alignment of Eigen's vectors (-march, or EIGEN_MAX_ALIGN_BYTES)"},
      {plugin.task_class, program.task_class, "a task's class"},
      {plugin.type, program.type, "a value's type"},
      {plugin.sequence, program.sequence, "a sequence"},
      {plugin.string, program.string, "a string"},
      {plugin.registry, program.registry, "the registry"},
  };
  for (const BuildLayout& layout : layouts)
    if (layout.theirs != layout.ours)
      return std::string("with options that give ") + layout.of + " " + std::to_string(layout.theirs) +
             " bytes instead of " + std::to_string(layout.ours);
  return "";
}

}  // namespace jarol
