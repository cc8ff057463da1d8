// Names of functions as people read them.
#pragma once

#include <string>
#include <string_view>

namespace jarol::isolation {

/// A declaration without parameters, results and what compilers add: "Clock::run" of "void Clock::run(Tick const&)
/// [clone .isra.0]".
std::string bare_name(std::string_view declaration);

/// As it stands in the source, without anonymous namespaces; or the name itself.
std::string demangled(const std::string& name);

}  // namespace jarol::isolation
