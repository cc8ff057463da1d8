#include "graph/plugins/plugin_build.h"

#include <string_view>

namespace jarol {
namespace {

BuildOptions options_of(const PluginBuild& build) {
  BuildOptions options;
  options.cxx11_strings = build.cxx11_strings;
  options.debug_containers = build.debug_containers;
  options.packed_structs = build.packed_structs;
  options.short_enums = build.short_enums;
  options.fast_math = build.fast_math;
  options.x87_math = build.x87_math;
  options.address_sanitizer = build.address_sanitizer;
  options.thread_sanitizer = build.thread_sanitizer;
  return options;
}

// What has another size for reasons that have no name here.
struct Layout {
  std::int32_t PluginBuild::*bytes;
  const char* of;
};
constexpr Layout layouts[] = {
    {&PluginBuild::long_double, "a long double"},
    {&PluginBuild::wide_char, "a wchar_t"},
    {&PluginBuild::eigen_alignment, "the alignment of Eigen's vectors (-march, or EIGEN_MAX_ALIGN_BYTES)"},
    {&PluginBuild::task_class, "a task's class"},
    {&PluginBuild::type, "a value's type"},
    {&PluginBuild::sequence, "a sequence"},
    {&PluginBuild::string, "a string"},
    {&PluginBuild::registry, "the registry"},
};

}  // namespace

std::string find_difference(const PluginBuild& plugin, const PluginBuild& program) {
  if (plugin.form != program.form)
    return "for form " + std::to_string(plugin.form) + " of the interface, this is form " +
           std::to_string(program.form);
  const std::string_view by(plugin.compiler, strnlen(plugin.compiler, sizeof plugin.compiler));
  if (by != program.compiler) return "by " + std::string(by) + ", this program by " + program.compiler;
  if (std::string option = find_other_switch(options_of(plugin), options_of(program)); !option.empty()) return option;
  for (const Layout& layout : layouts) {
    const std::int32_t theirs = plugin.*layout.bytes, ours = program.*layout.bytes;
    if (theirs != ours)
      return std::string("with options that give ") + layout.of + " " + std::to_string(theirs) + " bytes instead of " +
             std::to_string(ours);
  }
  return "";
}

}  // namespace jarol
