#include "graph/build_options.h"

namespace jarol {
namespace {

// What an option is called that code was compiled with, or lacks.
struct Switch {
  std::int32_t BuildOptions::*value;
  const char* if_larger;  // than expected
  const char* if_smaller;
};
constexpr Switch switches[] = {
    {&BuildOptions::address_sanitizer, "with the address sanitizer", "without the address sanitizer"},
    {&BuildOptions::thread_sanitizer, "with the thread sanitizer", "without the thread sanitizer"},
    {&BuildOptions::cxx11_strings, "without -D_GLIBCXX_USE_CXX11_ABI=0", "with -D_GLIBCXX_USE_CXX11_ABI=0"},
    {&BuildOptions::debug_containers, "with -D_GLIBCXX_DEBUG", "without -D_GLIBCXX_DEBUG"},
    {&BuildOptions::packed_structs, "with -fpack-struct", "without -fpack-struct"},
    {&BuildOptions::short_enums, "with -fshort-enums", "without -fshort-enums"},
    {&BuildOptions::fast_math, "with -ffast-math or a part of it, so that it computes otherwise",
     "without -ffast-math or a part of it, so that it computes otherwise"},
    {&BuildOptions::x87_math, "with -mfpmath=387, so that it computes otherwise",
     "without -mfpmath=387, so that it computes otherwise"},
};

// What has another size for reasons that have no name here.
struct Layout {
  std::int32_t BuildOptions::*bytes;
  const char* of;
};
constexpr Layout layouts[] = {
    {&BuildOptions::long_double, "a long double"},
    {&BuildOptions::wide_char, "a wchar_t"},
    {&BuildOptions::largest_vector, "the alignment of vectors (-march)"},
};

}  // namespace

std::string find_other_switch(const BuildOptions& options, const BuildOptions& expected) {
  for (const Switch& option : switches) {
    const std::int32_t theirs = options.*option.value, ours = expected.*option.value;
    if (theirs != ours) return theirs > ours ? option.if_larger : option.if_smaller;
  }
  return "";
}

std::string find_difference(BuildOptions program, const BuildOptions& library) {
  program.address_sanitizer = library.address_sanitizer;
  program.thread_sanitizer = library.thread_sanitizer;
  std::string found = find_other_switch(program, library);
  for (const Layout& layout : layouts)
    if (const std::int32_t theirs = program.*layout.bytes, ours = library.*layout.bytes;
        found.empty() && theirs != ours)
      found = std::string("with options that give ") + layout.of + " " + std::to_string(theirs) + " bytes instead of " +
              std::to_string(ours);
  return found;
}

}  // namespace jarol
