// The words of a command line, as CLI11 alone would not look at them: what is wrong with them, said in full.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace jarol::tools {

/// A word that is written as an option.
struct OptionWord {
  std::string name;
  const CLI::Option* option = nullptr;  // none of the command
  std::optional<std::string> joined;    // its value, in the same word
};

/// Those among the words behind a command's name.
std::vector<OptionWord> options_among(const CLI::App& command, const std::vector<std::string>& words);

/// Why a flag among them can't be taken as it is; empty: all can.
std::string flag_with_value(const CLI::App& command, const std::vector<std::string>& words);

/// Why an option among them is none of the command's; empty: all are.
std::string unknown_option(const CLI::App& command, const std::vector<std::string>& words);

/// Of a command that was given more arguments than it takes, of which this is one.
std::string argument_too_many(const CLI::App& command, const std::string& argument,
                              const std::vector<std::string>& words);

}  // namespace jarol::tools
