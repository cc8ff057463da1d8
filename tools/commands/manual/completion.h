// What bash completes behind `jarol`: commands, options, words and files of their values.
#pragma once

#include <string>
#include <vector>

#include "tools/report/command_line.h"

namespace jarol::tools {

/// A script that bash reads.
std::string bash_completion(const std::vector<CommandText>& commands);

}  // namespace jarol::tools
