#include "tools/command_line.h"

#include <CLI/CLI.hpp>

namespace jarol::tools {

Option* Option::required() {
  option_.required();
  return this;
}

Option* Option::one_value() {
  option_.allow_extra_args(false);
  return this;
}

Option* Option::in_range(int least, int most) {
  option_.check(CLI::Range(least, most));
  return this;
}

Option* Option::in_range(double least, double most) {
  option_.check(CLI::Range(least, most));
  return this;
}

Option* Option::one_of(const std::vector<std::string>& words) {
  option_.check(CLI::IsMember(words));
  return this;
}

Option* Option::excludes(const Option* other) {
  option_.excludes(&other->option_);
  return this;
}

template <class T>
Option* Command::add_option(const std::string& name, T& value, const std::string& text) {
  return &options_.emplace_back(*app_.add_option(name, value, text));
}
template Option* Command::add_option(const std::string&, std::string&, const std::string&);
template Option* Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option* Command::add_option(const std::string&, int&, const std::string&);
template Option* Command::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option* Command::add_option(const std::string&, double&, const std::string&);

Option* Command::add_option(const std::string& name, const std::function<void(const std::string&)>& take,
                            const std::string& text) {
  return &options_.emplace_back(*app_.add_option_function<std::string>(name, take, text));
}

Option* Command::add_flag(const std::string& name, bool& value, const std::string& text) {
  return &options_.emplace_back(*app_.add_flag(name, value, text));
}

void Command::footer(const std::string& text) { app_.footer(text); }

void Command::callback(const std::function<void()>& action) { app_.callback(action); }

CommandLine::CommandLine(const std::string& name, const std::string& text, const std::string& version)
    : app_(std::make_unique<CLI::App>(text, name)) {
  app_->require_subcommand(1);
  app_->set_version_flag("--version", version);
}

CommandLine::~CommandLine() = default;

Command* CommandLine::add_subcommand(const std::string& name, const std::string& text) {
  return &commands_.emplace_back(*app_->add_subcommand(name, text));
}

std::vector<std::string> CommandLine::names() const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool CommandLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return true;
  } catch (const CLI::ParseError& error) { return app_->exit(error) == 0; }
}

}  // namespace jarol::tools
