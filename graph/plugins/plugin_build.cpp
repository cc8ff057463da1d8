#include "graph/plugins/plugin_build.h"

#include <string_view>

namespace jarol {
namespace {

// What an option is called that a plugin was compiled with, or lacks.
struct Option {
  std::int32_t PluginBuild::*value;
  const char* if_larger;  // than that of the program
  const char* if_smaller;
};
constexpr Option options[] = {
    {&PluginBuild::address_sanitizer, "with the address sanitizer", "without the address sanitizer"},
    {&PluginBuild::thread_sanitizer, "with the thread sanitizer", "without the thread sanitizer"},
    {&PluginBuild::cxx11_strings, "without -D_GLIBCXX_USE_CXX11_ABI=0", "with -D_GLIBCXX_USE_CXX11_ABI=0"},
    {&PluginBuild::debug_containers, "with -D_GLIBCXX_DEBUG", "without -D_GLIBCXX_DEBUG"},
    {&PluginBuild::packed_structs, "with -fpack-struct", "without -fpack-struct"},
    {&PluginBuild::short_enums, "with -fshort-enums", "without -fshort-enums"},
    {&PluginBuild::fast_math, "with -ffast-math or a part of it, so that it computes otherwise",
     "without -ffast-math or a part of it, so that it computes otherwise"},
    {&PluginBuild::x87_math, "with -mfpmath=387, so that it computes otherwise",
     "without -mfpmath=387, so that it computes otherwise"},
};

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
  for (const Option& option : options) {
    const std::int32_t theirs = plugin.*option.value, ours = program.*option.value;
    if (theirs != ours) return theirs > ours ? option.if_larger : option.if_smaller;
  }
  for (const Layout& layout : layouts) {
    const std::int32_t theirs = plugin.*layout.bytes, ours = program.*layout.bytes;
    if (theirs != ours)
      return std::string("with options that give ") + layout.of + " " + std::to_string(theirs) + " bytes instead of " +
             std::to_string(ours);
  }
  return "";
}

}  // namespace jarol
