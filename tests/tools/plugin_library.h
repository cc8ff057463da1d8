// Where the plugins of the tests are.
#pragma once

#include <string>

namespace jarol::tests {
/// The path of a plugin, by its name.
inline std::string library(const std::string& name) { return std::string(JAROL_PLUGIN_FOLDER) + "/" + name + ".so"; }
}  // namespace jarol::tests
