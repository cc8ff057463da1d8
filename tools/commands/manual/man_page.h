// Man pages of the command, of the tables that --help prints.
#pragma once

#include <string>
#include <vector>

#include "tools/report/command_line.h"

namespace jarol::tools {

/// jarol(1): what it is, and its commands.
std::string man_page(const std::string& text, const std::vector<CommandText>& commands, const std::string& version);

/// jarol-COMMAND(1).
std::string man_page(const CommandText& command, const std::string& version);

}  // namespace jarol::tools
