// Loads a plugin in a process of its own first: what it does there harms nobody.
#pragma once

#include <string>

namespace jarol {

/// Why loading the library and asking for its tasks goes wrong: it throws, crashes, ends the process, never returns, or
/// leaves another floating-point environment behind. Empty: it works.
std::string try_plugin(const std::string& path);

}  // namespace jarol
