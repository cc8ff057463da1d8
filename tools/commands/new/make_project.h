// A project of one's own: a folder with what `find_package(jarol)` builds.
#pragma once

#include <string>
#include <vector>

namespace jarol::tools {

/// Files of the project, relative to `folder`, which is made, or was there and empty. `kind` is a room of this one:
/// "base" or "rover". All of it, or nothing. Throws InputError with what is wrong with the folder;
/// std::system_error, "can't make 'folder': reason", if it can't be written.
std::vector<std::string> make_project(const std::string& folder, const std::string& kind);

}  // namespace jarol::tools
