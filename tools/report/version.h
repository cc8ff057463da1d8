// What this program was made of.
#pragma once

#include <string>

namespace jarol::tools {

/// A line each: version and commit, compiler, libraries.
std::string version_text();

}  // namespace jarol::tools
